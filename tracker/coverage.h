// How well given cameras can know a head's pose, before anybody walks: the Fisher information that
// their dots carry of it, the level of tracking that this allows, and the Cramer-Rao bound of the
// eye and of the rotation (Kay 1993, Fundamentals of Statistical Signal Processing, section 3.7).
// What hides an LED is told by a function: the tracker knows no helmets.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "tracker/camera_model.h"

namespace vindu {

/// Standard deviation of a dot, each coordinate, in raw pixels; empty where the LED is not seen
/// from there. `led` is an index of HeadConfig::leds_in_head. The field of view is not its
/// business.
using DotNoise = std::function<std::optional<double>(std::size_t led, const Vec3& viewer_in_head)>;

constexpr double kDotNoise_px = 0.5;
/// Noise, then rounding to whole units: sigma^2 = sigma0^2 + 1/12.
double rounded_noise_px(double sigma0_px);

/// What dots say about one pose. That of several cameras is the sum.
struct Sight {
  Mat6 information =
      Mat6::Zero();  ///< of the eye's place (m), then the rotation about it (rad); room
  int dots = 0;
  Vec3 towards = Vec3::Zero();  ///< sum of the directions in which they look at the eye; room

  Sight& operator+=(const Sight& other);
};

/// A camera and the edges of its picture. Immutable; reentrant as far as the noise is.
class Onlooker {
 public:
  explicit Onlooker(const CameraConfig& camera);

  /// Dots in the picture, the nearest first: four of a Wiimote, else as many as the blob options
  /// let through.
  Sight look(const HeadConfig& head, const Rigid3& room_from_head, const DotNoise& noise) const;

 private:
  CameraModel model_;
  Vec2 size_px_;
  std::size_t most_dots_;
};

/// How well a rotation is remembered, each axis, where the dots alone do not tell it.
constexpr double kRememberedRotation_rad = radians(10);

/// Of an unbiased estimate from one picture of each camera, unfiltered.
struct PoseBound {
  TrackingLevel level = TrackingLevel::lost;
  /// Standard deviations; infinite at levels bearing and lost.
  double eye_m = std::numeric_limits<double>::infinity();      ///< over all three axes
  double depth_m = std::numeric_limits<double>::infinity();    ///< away from the cameras
  double lateral_m = std::numeric_limits<double>::infinity();  ///< across, over both axes
  double rotation_rad = std::numeric_limits<double>::infinity();
};

/// The tracker's own level (level_of), but that fewer than four dots are no more than hybrid: three
/// leave several poses open, and memory must choose. At hybrid and position the rest of the
/// rotation is remembered.
PoseBound bound_of(const Sight& sight);

/// By the dots alone, with nothing remembered and no limits: level six_dof, or lost where they
/// leave something open.
PoseBound unaided_bound_of(const Sight& sight);

/// Each pose seen by all cameras.
std::vector<PoseBound> survey(std::span<const CameraConfig> cameras, const HeadConfig& head,
                              const DotNoise& noise, std::span<const Rigid3> poses);

/// Head whose eye is there and that faces the wall, turned by a yaw (to the left) about the
/// vertical.
Rigid3 head_at(const Vec3& eye_in_room, double yaw_rad, const HeadConfig& head);

}  // namespace vindu
