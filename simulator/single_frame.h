// Single frames: one picture of each emulated Wiimote of a head somewhere before them, what the
// joint method and the thesis' make of these bytes alone, and the Cramer-Rao bound beside both.
// True poses and labels are used to judge, never to find.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "core/site.h"

namespace vindu {

/// Four LEDs that lie in no plane and in no symmetric order.
HeadConfig four_led_head();

/// Wiimotes in a row behind the head, 2.3 m high, which all look at the middle of its places.
struct CameraRow {
  double distance_m = 3;  ///< from the row to that middle, level
  double baseline_m = 2;  ///< from the first to the last
  int cameras = 2;
};
/// Their lag is that of the emulated radio.
std::vector<CameraConfig> cameras_of(const CameraRow& row);

/// The middle of the head's places, in room.
const Vec3 kHeadPlace_in_room = {0, 1.65, 2};
/// Anywhere in 0.6 x 0.3 x 0.6 m around there; facing the wall but for a yaw of up to 25 degrees,
/// pitch 15, roll 10.
Rigid3 head_somewhere(Random& random);

struct FrameStudyOptions {
  CameraRow row;
  HeadConfig head;
  int poses = 1000;        ///< in which every camera sees every LED; others are passed over
  double noise_px = 0.5;   ///< sigma of each coordinate, before rounding
  std::uint64_t seed = 1;  ///< of poses and noise
  /// Partial sight: dots that are left to the last camera, which ones being chance.
  std::optional<int> dots_of_last = {};
};

/// Errors are root mean squares over the poses that were found and found right.
struct FrameErrors {
  double found = 0;      ///< share of the poses
  double wrong = 0;      ///< share of the poses: found over 60 mm or 20 degrees from where it is
  double eye_m = 0;      ///< all three axes
  double lateral_m = 0;  ///< across the cameras' view, both axes
  double depth_m = 0;    ///< along it
  double rotation_rad = 0;
  /// The thesis' method alone: shares of the poses that it found with six degrees of freedom, in
  /// its hybrid way, by position.
  std::array<double, 3> levels{};
};

struct FrameStudy {
  int poses = 0;
  int passed_over = 0;  ///< the helmet hides an LED, or it is outside a picture
  FrameErrors joint;
  FrameErrors bound;  ///< over the poses that the joint method finds right
  /// With its own l-m-r helmet in the same poses, by the outermost cameras. In full sight its 6 DoF
  /// tracking; in partial sight, with this helmet and two cameras only, the best of its ways.
  std::optional<FrameErrors> thesis;
  /// Ratio of the eye's errors, joint over thesis, over the poses that both find right.
  std::optional<double> joint_over_thesis;
};

FrameStudy study_frames(const FrameStudyOptions& options);

}  // namespace vindu
