// What the application sees of the tracker: observations in, the head's pose out, and an account of
// what was lost and why.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/pose.h"
#include "core/site.h"
#include "tracker/observation.h"
#include "tracker/thesis_method.h"

namespace vindu {

struct TrackerOptions {
  std::string method = "thesis";
};

struct TrackerCounts {
  std::uint64_t reports = 0;
  std::uint64_t frames_tracked = 0;
  std::array<std::uint64_t, kNoPoseReasons> frames_lost_by_reason{};  ///< indexed by NoPose

  std::uint64_t frames_lost() const;
};

/// A pose is held this long after it was captured; then it is lost.
constexpr Duration kPoseHeldFor = std::chrono::seconds(2);

/// Bound to one thread at a time.
class Tracker {
 public:
  /// Throws Error for an unknown method, or one that these cameras and LEDs cannot serve.
  Tracker(std::span<const CameraConfig> cameras, const HeadConfig& head,
          const Rigid3& room_from_wall, const TrackerOptions& options = {});

  void absorb(const Observation& observation);

  /// One frame. Level six_dof when the head was found; else the last pose as held, later lost, its
  /// capture time unchanged. Empty until a head was found for the first time.
  std::optional<PoseSample> track(Time now);

  /// The eye of a pose, by the head's tracking offset; metres.
  Vec3 eye_in_wall(const PoseSample& pose) const;

  const TrackerCounts& counts() const { return counts_; }
  /// The LEDs that the last frame triangulated, with their errors; may be empty.
  std::span<const TriangulatedPoint> points() const { return points_; }

 private:
  ThesisMethod method_;
  Vec3 eye_in_head_;
  Rigid3 wall_from_room_;
  std::optional<PoseSample> last_;
  std::vector<TriangulatedPoint> points_;
  TrackerCounts counts_;
};

}  // namespace vindu
