// Two cameras and what they would report of a head if they were perfect: no noise, no rounding.
#pragma once

#include <cmath>
#include <vector>

#include "core/site.h"
#include "tracker/camera_model.h"
#include "tracker/observation.h"

namespace vindu {

/// 3 m from the middle of the head's places, that many degrees aside of straight behind it, left
/// and right, 2.3 m high; with some distortion.
inline std::vector<CameraConfig> cameras_aside(double aside_deg) {
  const double x_m = 3 * std::sin(radians(aside_deg)), z_m = 3 * std::cos(radians(aside_deg));
  std::vector<CameraConfig> cameras(2);
  cameras[0].room_from_camera = look_at({-x_m, 2.3, 2 + z_m}, {0, 1.65, 2});
  cameras[1].room_from_camera = look_at({x_m, 2.3, 2 + z_m}, {0, 1.65, 2});
  for (auto& camera : cameras) camera.intrinsics.distortion = {0.03, -0.02, 0.001, 0.001, 0};
  return cameras;
}

inline Quat turned(double yaw_deg, double pitch_deg, double roll_deg) {
  return Quat(Eigen::AngleAxisd(radians(yaw_deg), Vec3::UnitY()) *
              Eigen::AngleAxisd(radians(pitch_deg), Vec3::UnitX()) *
              Eigen::AngleAxisd(radians(roll_deg), Vec3::UnitZ()));
}

/// The dots of the named LEDs, in that order.
inline Observation perfect_view(const std::vector<CameraConfig>& cameras, int camera,
                                const HeadConfig& head, const Rigid3& room_from_head, Time arrival,
                                const std::vector<std::size_t>& leds = {2, 0, 1}) {
  const CameraModel model(cameras[static_cast<std::size_t>(camera)]);
  Observation seen{camera, arrival, {}};
  for (const std::size_t led : leds) {
    const Vec3 x_in_room = room_from_head * head.leds_in_head[led];
    const Vec2 raw_px = *model.project(model.camera_from_room() * x_in_room);
    seen.dots.push_back({raw_px.x(), raw_px.y(), 3});
  }
  return seen;
}

}  // namespace vindu
