// What the tests of the joint method share: two cameras that report of walking heads.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/tracker/joint/scene.h"
#include "tracker/joint/joint_method.h"

namespace vindu::test {

class JointMethodTest : public ::testing::Test {
 protected:
  JointMethodTest() {
    for (int i = 0; i < 2; ++i) {
      CameraConfig camera;
      camera.name = i ? "right" : "left";
      camera.room_from_camera = look_at({i ? 1.0 : -1.0, 2.3, 5}, {0, 1.65, 2});
      configs_.push_back(camera);
    }
    heads_[0].leds_in_head = kThreeLeds;
  }

  static Rigid3 walking(double t_s) {
    return {rotation_of({0, 0.3 * std::sin(1.9 * t_s), 0}),
            {0.25 * std::sin(1.3 * t_s), 1.65, 2 + 0.1 * std::sin(0.9 * t_s)}};
  }

  Observation seen_by(int camera, const std::vector<Rigid3>& heads, Time arrival) {
    const CameraModel model(configs_[static_cast<std::size_t>(camera)]);
    Observation seen{camera, arrival, {}};
    for (std::size_t h = 0; h < heads.size(); ++h)
      for (const Vec3& led : heads_[h].leds_in_head) {
        const Vec2 raw_px = dot_of(model, heads[h], led);
        seen.dots.push_back({std::round(raw_px.x() + random_.normal(0.3)),
                             std::round(raw_px.y() + random_.normal(0.3)), 3});
      }
    return seen;
  }

  /// Both cameras report `heads_at(t)` every 10 ms, from a time to a time.
  template <class Heads>
  void feed(JointMethod& method, double from_s, double to_s, Heads heads_at) {
    for (int k = static_cast<int>(std::lround(from_s * 100)); k < std::lround(to_s * 100); ++k) {
      const Time time{std::chrono::milliseconds(10 * k)};
      for (int camera = 0; camera < std::ssize(configs_); ++camera)
        method.absorb(seen_by(camera, heads_at(0.01 * k), time));
      method.update(time);
    }
  }

  double error_m(JointMethod& method, std::size_t head, Time time, const Rigid3& truth) {
    const auto pose = method.pose(head, time);
    return pose ? (pose->room_from_head.translation - truth.translation).norm() : 1e9;
  }

  /// Somebody turns a camera: about its x axis (its picture moves up and down) or its y axis.
  void bump(int axis, double px, std::size_t camera = 1) {
    Vec3 turn = Vec3::Zero();
    turn[axis] = px / 1335;
    Quat& rotation = configs_[camera].room_from_camera.rotation;
    rotation = rotation * rotation_of(turn);
  }
  void add_middle_camera() {
    configs_.push_back(configs_[0]);
    configs_.back().room_from_camera = look_at({0, 2.5, 5}, {0, 1.65, 2});
  }

  std::vector<CameraConfig> configs_;
  std::vector<HeadConfig> heads_ = std::vector<HeadConfig>(1);
  Random random_{1};
};

}  // namespace vindu::test
