// What the application sees of the tracker: observations in, the heads' poses out, which of them
// the wall follows, and an account of what was lost and why.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/pose.h"
#include "core/site.h"
#include "tracker/joint/joint_method.h"
#include "tracker/observation.h"
#include "tracker/thesis_method.h"

namespace vindu {

struct TrackerCounts {
  std::uint64_t reports = 0;
  std::uint64_t frames = 0;
  /// Of the head that is followed, indexed by TrackingLevel; one never found counts as lost.
  std::array<std::uint64_t, 6> frames_by_level{};
  /// The thesis' method alone, indexed by NoPose.
  std::array<std::uint64_t, kNoPoseReasons> frames_lost_by_reason{};

  std::uint64_t frames_tracked() const;
  std::uint64_t frames_lost() const { return frames - frames_tracked(); }
};

/// A button of a camera was pressed or let go.
struct ButtonChange {
  int camera = 0;            ///< index in the site's list of cameras
  std::uint16_t button = 0;  ///< one bit, as in wiimote/report.h
  bool pressed = false;
  Time arrival{};  ///< of the report that said so
};

/// A pose is held this long after it was captured; then it is lost.
constexpr Duration kPoseHeldFor = std::chrono::seconds(2);

/// Bound to one thread at a time.
class Tracker {
 public:
  /// Throws Error for what cannot work: an unknown method or head, or cameras and LEDs that the
  /// method cannot use. The thesis' method tracks the first head alone.
  Tracker(std::span<const CameraConfig> cameras, std::span<const HeadConfig> heads,
          const Rigid3& room_from_wall, const TrackingConfig& config = {});

  void absorb(const Observation& observation);

  /// One frame, of which the light leaves the wall at `photon`: where the followed head will be
  /// then. Held and lost poses are where the head was last. Empty until a head was found for the
  /// first time.
  std::optional<PoseSample> track(Time now, Time photon);

  /// All heads that were ever found, as of the last frame.
  const std::vector<PoseSample>& poses() const { return poses_; }

  /// Those that came before the last frame and after the one before it, in order.
  const std::vector<ButtonChange>& button_changes() const { return button_changes_; }

  /// Follows the next head that is tracked, from now on. A press of Home on any Wiimote does so.
  void hand_over();

  /// The eye of a pose, by its head's tracking offset; metres.
  Vec3 eye_in_wall(const PoseSample& pose) const;

  const TrackerCounts& counts() const { return counts_; }
  /// In the order of the cameras; empty for the thesis' method, which knows nothing of that.
  std::vector<CameraHealth> camera_health() const;
  /// Which cameras have reported, dots or none, within the second before a time; in their order.
  std::vector<bool> heard(Time now) const;
  /// By how much the cameras contradict each other (JointMethod); 0 for the thesis' method.
  double disagreement_px() const;
  double heads_look_larger() const;  ///< the same; 0
  bool nothing_fits() const;         ///< the same; false
  /// The LEDs that the thesis' method found last, with their errors; may be empty.
  std::span<const TriangulatedPoint> points() const { return points_; }

 private:
  void note_buttons(const Observation& observation);
  void track_all(Time now, Time photon);
  void track_by_thesis(Time now);
  void apply_mode(PoseSample& pose) const;
  double distance_to_wall_m(const PoseSample& pose) const;
  std::optional<PoseSample> followed();

  TrackingConfig config_;
  std::vector<HeadConfig> heads_;
  Rigid3 wall_from_room_;
  std::vector<std::uint16_t> buttons_;                         // by camera, of the last report
  std::vector<std::optional<Time>> reported_;                  // the last one's arrival, by camera
  std::vector<ButtonChange> coming_changes_, button_changes_;  // of the next frame, of the last
  std::variant<ThesisMethod, JointMethod> method_;
  std::vector<PoseSample> poses_;
  std::optional<int> following_;
  bool by_hand_ = false;
  std::vector<TriangulatedPoint> points_;
  TrackerCounts counts_;
};

}  // namespace vindu
