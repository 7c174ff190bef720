// The thesis' three ways of tracking as written (3.2.2, 4.3.1, A.7), from the freshest dots of two
// cameras, sorted from left to right. 6 DoF: three LEDs are triangulated; left, middle and right
// point make the frame. Hybrid: two dots of each camera, one LED in common (thesis_hybrid.h).
// Position: one LED in common; the rotation is not measured. No filter, no prediction, no time but
// arrival. It is the baseline.
//
// Its limits are kept: sorting by image x and by room x wants cameras behind a head that faces the
// wall: a camera in front sees the mirror order, and the thesis' helmet (sides as far ahead of the
// rear LED as aside) swaps order in a camera more than 45 degrees off straight behind it. Samples
// of two cameras up to 10 ms apart count as simultaneous. What the thesis leaves open is chosen in
// its favour, by measurement: docs/decisions/0002.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/pose.h"
#include "core/site.h"
#include "tracker/camera_model.h"
#include "tracker/observation.h"
#include "tracker/thesis_hybrid.h"

namespace vindu {

/// Why a frame has no pose.
enum class NoPose { too_few_dots, unequal_counts, too_many_dots, rays_do_not_meet, degenerate };
constexpr std::size_t kNoPoseReasons = 5;

constexpr std::string_view name_of(NoPose reason) {
  constexpr std::string_view names[] = {"too few dots", "unequal counts", "too many dots",
                                        "rays do not meet", "degenerate"};
  return names[static_cast<int>(reason)];
}

/// Thesis' tracking offset (e_f, e_r, e_u) in head. Equation 3.1 has the columns f, r and u = f x
/// r, which points down; head has +x = r, +y = r x f, -z = f: (e_r, -e_u, -e_f).
inline Vec3 head_offset_from_thesis(const Vec3& thesis_offset) {
  return {thesis_offset.y(), -thesis_offset.z(), -thesis_offset.x()};
}

/// The l-m-r frame: origin m, columns (r, r x f, -f) with r from l to r, and f from m to the
/// nearest point P of that line. Determinant +1. Empty when the points coincide or lie on one line
/// (to 1 um).
std::optional<Rigid3> lmr_frame(const Vec3& left, const Vec3& middle, const Vec3& right);

/// The thesis' user chooses one of its ways by hand; a hybrid frame in which both cameras see all
/// three LEDs is triangulated. automatic: the best that the dots of each frame allow.
enum class ThesisMode { automatic, six_dof, hybrid, position };

struct ThesisOptions {
  ThesisMode mode = ThesisMode::automatic;
  /// Of rightly paired dots at 3 m (0.3 px of noise, a walking head) half have gaps under 2 mm and
  /// 99 % under 6; swapped ones have 10 to 50 mm, but for the few that swap where they coincide.
  double largest_gap_m = 0.008;
  double largest_misfit_m = 0.020;  ///< of a hybrid candidate
  /// From one frame to the next, in hybrid and position tracking; farther is not believed.
  double largest_step_m = 0.1;
};

struct ThesisResult {
  std::optional<PoseSample> pose;  ///< six_dof, hybrid or position; capture time: arrival of the
                                   ///< newest report used
  NoPose reason{};                 ///< when there is no pose: what 6 DoF, or position alone, lacks
  std::vector<TriangulatedPoint> points;  ///< left to right along room x, as far as they were found
};

/// Reentrant. Bound to one thread at a time.
class ThesisMethod {
 public:
  /// Throws Error unless there are two or more cameras (the first two are used) and three LEDs that
  /// make a frame; position alone is content with any LEDs.
  ThesisMethod(std::span<const CameraConfig> cameras, const HeadConfig& head,
               const ThesisOptions& options = {});

  /// Keeps the freshest report of each camera; others' reports are ignored.
  void absorb(const Observation& observation);

  /// One poll (the thesis: 60 Hz). A camera that has been silent for over 100 ms counts as one that
  /// sees nothing.
  ThesisResult track(Time now);

 private:
  struct Found {
    TrackingLevel level = TrackingLevel::six_dof;
    std::optional<Rigid3> room_from_head = {};
    NoPose reason{};
    std::vector<TriangulatedPoint> points = {};
  };
  using Rays = std::vector<Ray>;

  Rays sorted_rays(std::size_t camera, Time now) const;
  Found find(const Rays& first, const Rays& second, Time now) const;
  Found six_dof(const Rays& first, const Rays& second) const;
  Found hybrid(const Rays& first, const Rays& second, Time now) const;
  Found position(const Rays& first, const Rays& second, Time now) const;
  bool knows_where_it_was(Time now) const;
  std::optional<LmrPoints> expected_lmr(Time now) const;

  ThesisOptions options_;
  std::array<CameraModel, 2> cameras_;
  std::array<std::optional<Observation>, 2> freshest_;
  std::vector<Vec3> leds_in_head_;  // from left to right
  Rigid3 lmr_from_head_;
  /// Of the last frame with a pose. The rotation before the first is that which position tracking
  /// predefines: the room's.
  Rigid3 last_room_from_head_;
  std::optional<Time> last_found_;
};

}  // namespace vindu
