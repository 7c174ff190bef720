// A camera as the tracker calculates with it: OpenCV's pinhole with distortion, and the one place
// that knows how a device's raw dots lie in the camera's image.
//
// The convention. Image coordinates are OpenCV's: x to the right, y down. A Wiimote held upright
// (buttons up) reports x growing to the right of its own view and y growing upwards, so
// x_image = x_raw and y_image = 767 - y_raw. That is how Dolphin's emulation, matched to real
// pointers, produces dots (WiimoteEmu/Camera.cpp: its frame is x left, y back, z up), and why
// pointer code flips x and not y. A video camera's dots are image coordinates already.
// A wrong flip makes a mirrored room, which no rotation hides.
#pragma once

#include <optional>

#include "core/site.h"
#include "tracker/triangulation.h"

namespace vindu {

constexpr int kWiimoteWidth_px = 1024;
constexpr int kWiimoteHeight_px = 768;

/// Width and height of what a camera's dots lie in.
Vec2 picture_size_px(const CameraConfig& camera);

/// How many dots one of its reports holds at most.
std::size_t most_dots(const CameraConfig& camera);

/// Image coordinates (OpenCV) of a raw dot, and the other way round: the map is its own inverse.
Vec2 image_from_raw(CameraSource source, const Vec2& raw_px);

/// Where a point's dot is, and how it moves with the point.
struct Projection {
  Vec2 raw_px = Vec2::Zero();
  Eigen::Matrix<double, 2, 3> d_raw_d_x_in_camera;  ///< pixels a metre
};

/// Reentrant; immutable once made.
class CameraModel {
 public:
  explicit CameraModel(const CameraConfig& config);

  /// Raw position of a point's dot, not rounded, also outside the picture. Empty for a point that
  /// is not in front of the camera, or so far aside that the distortion polynomial folds back.
  std::optional<Vec2> project(const Vec3& x_in_camera) const;

  /// The same with its derivative.
  std::optional<Projection> project_with_jacobian(const Vec3& x_in_camera) const;

  /// The ray of all points that project to this raw position.
  Ray ray_through(const Vec2& raw_px) const;

  const Rigid3& room_from_camera() const { return room_from_camera_; }
  const Rigid3& camera_from_room() const { return camera_from_room_; }

 private:
  bool in_view(const Vec3& x_in_camera) const;
  Vec2 bent(double x, double y) const;
  Vec2 undistorted(const Vec2& image_px) const;

  CameraSource source_;
  Intrinsics intrinsics_;
  Rigid3 room_from_camera_;
  Rigid3 camera_from_room_;
  bool distorts_;
  double largest_radius2_;  // of x/z, y/z: up to here the radial polynomial grows
};

}  // namespace vindu
