// What the tests of the joint method share: cameras behind a head, and the dots that they see of
// it.
#pragma once

#include <vector>

#include "core/random.h"
#include "tracker/joint/acquisition.h"
#include "tracker/joint/rotation.h"

namespace vindu::test {

inline const std::vector<Vec3> kThreeLeds = {{-0.09, 0, -0.09}, {0, 0, 0}, {0.09, 0, -0.09}};
inline const std::vector<Vec3> kFourLeds = {
    {-0.10, 0, -0.09}, {0, 0.06, 0}, {0.10, -0.02, -0.09}, {0.03, -0.06, -0.02}};

/// `count` Wiimotes 3 m behind a head at (0, 1.65, 2), side by side, 2 m from first to last.
inline std::vector<CameraModel> cameras_behind(int count) {
  std::vector<CameraModel> cameras;
  for (int i = 0; i < count; ++i) {
    CameraConfig config;
    const double x = count == 1 ? 0 : -1 + 2.0 * i / (count - 1);
    config.room_from_camera = look_at({x, 2.3, 5}, {0, 1.65, 2});
    cameras.emplace_back(config);
  }
  return cameras;
}

/// A head about where the cameras look, turned by up to the given angles.
inline Rigid3 random_head(Random& random, double yaw_rad = radians(25),
                          double tilt_rad = radians(15)) {
  const Quat turn =
      Eigen::AngleAxisd(random.uniform(-yaw_rad, yaw_rad), Vec3::UnitY()) *
      Eigen::AngleAxisd(random.uniform(-tilt_rad, tilt_rad), Vec3::UnitX()) *
      Eigen::AngleAxisd(random.uniform(-0.7 * tilt_rad, 0.7 * tilt_rad), Vec3::UnitZ());
  return {turn, {random.uniform(-0.3, 0.3), random.uniform(1.5, 1.8), random.uniform(1.7, 2.3)}};
}

inline Vec2 dot_of(const CameraModel& camera, const Rigid3& head, const Vec3& led) {
  return *camera.project(camera.camera_from_room() * (head * led));
}

/// All dots of all cameras, with Gaussian noise, in the order of the LEDs.
inline std::vector<CameraView> views_of(const std::vector<CameraModel>& cameras, const Rigid3& head,
                                        const std::vector<Vec3>& leds, double noise_px,
                                        Random& random) {
  std::vector<CameraView> views;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    CameraView view{.camera = static_cast<int>(i), .dots_px = {}};
    for (const Vec3& led : leds)
      view.dots_px.emplace_back(dot_of(cameras[i], head, led) +
                                Vec2(random.normal(noise_px), random.normal(noise_px)));
    views.push_back(std::move(view));
  }
  return views;
}

/// Every dot given its LED.
inline std::vector<LedSighting> sightings_of(const std::vector<CameraView>& views,
                                             const std::vector<Vec3>& leds, double sigma_px) {
  std::vector<LedSighting> sightings;
  for (const CameraView& view : views)
    for (std::size_t led = 0; led < leds.size(); ++led)
      sightings.push_back({view.camera, leds[led], view.dots_px[led], sigma_px});
  return sightings;
}

inline double angle_deg(const Rigid3& a, const Rigid3& b) {
  return degrees(a.rotation.angularDistance(b.rotation));
}

}  // namespace vindu::test
