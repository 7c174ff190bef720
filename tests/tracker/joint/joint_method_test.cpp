// The whole joint method on reports: late ones, lost heads, several heads, reflections.
#include "tracker/joint/joint_method.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/tracker/joint/joint_method_fixture.h"

namespace vindu {
namespace {

using namespace test;
using std::chrono::milliseconds;

TEST_F(JointMethodTest, finds_and_follows_a_walking_head) {
  JointMethod method(configs_, heads_);
  EXPECT_FALSE(method.pose(0, Time{}));
  feed(method, 0, 4, [](double t) { return std::vector{walking(t)}; });
  const Time now{milliseconds(3990)}, photon = now + milliseconds(30);
  const auto pose = method.pose(0, photon);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->level, TrackingLevel::six_dof);
  EXPECT_EQ(pose->time, photon);
  EXPECT_LE(pose->capture_time, now);
  EXPECT_LT(error_m(method, 0, photon, walking(4.02)), 0.006);
}

TEST_F(JointMethodTest, gives_the_same_for_late_reports_as_for_timely_ones) {
  const auto run = [&](bool late) {
    random_ = Random(5);
    std::vector<Observation> all;
    for (int k = 0; k < 300; ++k)
      for (int camera = 0; camera < 2; ++camera)
        all.push_back(seen_by(camera, {walking(0.01 * k)}, Time{milliseconds(10 * k)}));
    // Late: of the last ten reports those of the right camera come after those of the left.
    if (late) std::ranges::stable_sort(all.end() - 20, all.end(), {}, &Observation::camera);
    JointMethod method(configs_, heads_);
    for (const Observation& seen : all) {
      method.absorb(seen);
      method.update(all.back().arrival);
    }
    return *method.pose(0, all.back().arrival);
  };
  const PoseSample timely = run(false), late = run(true);
  EXPECT_LT((timely.room_from_head.translation - late.room_from_head.translation).norm(), 1e-4);
}

/// Half of a ring of LEDs faces away; a helmet that has no others is not meant for that.
TEST_F(JointMethodTest, takes_no_helmet_for_one_of_fewer_leds_where_half_of_its_own_are_hidden) {
  const std::vector<Vec3> seen = kFourLeds;
  std::vector<Vec3> ring = seen, other = seen;
  for (const Vec3& led : seen) ring.emplace_back(-led.x(), 0.8 * led.y(), -0.25 - led.z());
  other[3] += Vec3(0.003, -0.003, 0);
  heads_.resize(2);
  heads_[0].leds_in_head = ring;
  heads_[1].leds_in_head = other;
  JointMethod method(configs_, heads_);
  heads_.resize(1);
  heads_[0].leds_in_head = seen;
  feed(method, 0, 4, [](double t) { return std::vector{walking(t)}; });
  EXPECT_LT(error_m(method, 0, Time{milliseconds(3990)}, walking(3.99)), 0.01);
  EXPECT_FALSE(method.pose(1, Time{milliseconds(3990)}));
}

TEST_F(JointMethodTest, holds_a_head_that_is_gone_and_finds_it_again_elsewhere) {
  JointMethod method(configs_, heads_);
  feed(method, 0, 1, [](double) { return std::vector{walking(0)}; });
  feed(method, 1, 1.5, [](double) { return std::vector<Rigid3>{}; });
  const auto held = method.pose(0, Time{milliseconds(1490)});
  ASSERT_TRUE(held);
  EXPECT_EQ(held->level, TrackingLevel::held);
  EXPECT_LT((held->room_from_head.translation - walking(0).translation).norm(), 0.02);
  feed(method, 1.5, 4, [](double) { return std::vector<Rigid3>{}; });
  EXPECT_EQ(method.pose(0, Time{milliseconds(3990)})->level, TrackingLevel::lost);
  const Rigid3 elsewhere{rotation_of({0, 0.2, 0}), {-0.3, 1.6, 2.2}};
  feed(method, 4, 4.2, [&](double) { return std::vector{elsewhere}; });
  EXPECT_LT(error_m(method, 0, Time{milliseconds(4190)}, elsewhere), 0.01);
}

TEST_F(JointMethodTest, holds_a_head_of_which_few_dots_are_left_beside_as_many_of_nobody) {
  const auto level_with = [&](std::size_t dots_of_head) {
    JointMethod method(configs_, heads_);
    feed(method, 0, 1, [](double) { return std::vector{walking(0)}; });
    for (int k = 100; k < 130; ++k)
      for (int camera = 0; camera < 2; ++camera) {
        const Observation all = seen_by(camera, {walking(0)}, Time{milliseconds(10 * k)});
        Observation seen{camera, all.arrival, {}};
        for (std::size_t i = 0; i < dots_of_head; ++i) seen.dots.push_back(all.dots[i]);
        seen.dots.push_back({4.0 * k, 100, 3});  // somebody else passes by
        method.absorb(seen);
        method.update(all.arrival);
      }
    return method.pose(0, Time{milliseconds(1290)})->level;
  };
  EXPECT_EQ(level_with(3), TrackingLevel::six_dof);
  EXPECT_EQ(level_with(1), TrackingLevel::held);
}

TEST_F(JointMethodTest, tracks_two_people_with_unlike_helmets) {
  heads_.resize(2);
  heads_[1].name = "guest";
  heads_[1].leds_in_head = kFourLeds;
  const auto both = [](double t) {
    Rigid3 other = walking(1.3 * t + 1);
    other.translation += Vec3(-0.55, -0.05, 0.3);
    Rigid3 first = walking(t);
    first.translation.x() = 0.4 + 0.3 * first.translation.x();
    return std::vector{first, other};
  };
  JointMethod method(configs_, heads_);
  feed(method, 0, 5, both);
  const Time now{milliseconds(4990)};
  EXPECT_LT(error_m(method, 0, now, both(4.99)[0]), 0.01);
  EXPECT_LT(error_m(method, 1, now, both(4.99)[1]), 0.01);
}

TEST_F(JointMethodTest, masks_a_lamp_that_stands_beside_the_walker) {
  JointMethod method(configs_, heads_);
  for (int k = 0; k < 800; ++k) {
    const Time time{milliseconds(10 * k)};
    for (int camera = 0; camera < 2; ++camera) {
      Observation seen = seen_by(camera, {walking(0.01 * k)}, time);
      seen.dots.push_back({512, 600, 2});
      method.absorb(seen);
    }
    method.update(time);
  }
  for (const CameraHealth& health : method.health()) EXPECT_EQ(health.masks, 1u);
  EXPECT_LT(error_m(method, 0, Time{milliseconds(7990)}, walking(7.99)), 0.006);
}

// Where one camera sees two LEDs, a reflection near the third would be taken for it.
TEST_F(JointMethodTest, takes_no_dot_for_an_led_that_is_far_larger_than_they_were) {
  const auto after_reflection = [&](int size) {
    random_ = Random(1);
    JointMethod method(configs_, heads_);
    feed(method, 0, 2, [](double t) { return std::vector{walking(t)}; });
    for (int k = 200; k < 240; ++k) {
      Observation seen = seen_by(0, {walking(0.01 * k)}, Time{milliseconds(10 * k)});
      seen.dots[2] = {seen.dots[2].x_px + (size && k > 210 ? 0.1 * (k - 210) : 500),
                      seen.dots[2].y_px, size};
      method.absorb(seen);
      method.update(seen.arrival);
    }
    return method.pose(0, Time{milliseconds(2390)})->room_from_head.translation;
  };
  EXPECT_EQ(after_reflection(12), after_reflection(0));  // which is far away
  EXPECT_NE(after_reflection(4), after_reflection(0));
}

/// Somebody who comes nearer to the cameras than all others are has larger dots.
TEST_F(JointMethodTest, finds_somebody_whose_dots_are_far_larger_than_those_of_others) {
  heads_.resize(2);
  heads_[1].leds_in_head = kFourLeds;
  const Rigid3 near{Quat::Identity(), {-0.5, 1.65, 2}};
  JointMethod method(configs_, heads_);
  for (int k = 0; k < 300; ++k) {
    const Time time{milliseconds(10 * k)};
    Rigid3 far = walking(0.01 * k);
    far.translation.x() = 0.4 + 0.3 * far.translation.x();
    for (const int camera : {0, 1}) {
      Observation seen = seen_by(camera, {far, near}, time);
      if (k < 100) seen = seen_by(camera, {far}, time);
      for (std::size_t i = 3; i < seen.dots.size(); ++i) seen.dots[i].size = 12;
      method.absorb(seen);
    }
    method.update(time);
  }
  EXPECT_LT(error_m(method, 1, Time{milliseconds(2990)}, near), 0.01);
}

TEST_F(JointMethodTest, knows_the_calibrated_background_from_the_first_report_on) {
  for (CameraConfig& camera : configs_) camera.masks_px = {{512, 600}, {100, 100}};
  JointMethod method(configs_, heads_);
  for (const CameraHealth& health : method.health()) EXPECT_EQ(health.masks, 2u);
}

/// Of which three LEDs fit several poses, one of them facing the wall.
TEST_F(JointMethodTest,
       follows_by_one_camera_whoever_watches_the_wall_and_vouches_for_no_distance) {
  configs_.pop_back();
  for (const std::vector<Vec3>& leds : {kThreeLeds, kFourLeds}) {
    heads_[0].leds_in_head = leds;
    JointMethod method(configs_, heads_);
    double worst_m = 0;
    int found = 0;
    for (int k = 0; k < 2000; ++k) {
      const Time time{milliseconds(10 * k)};
      method.absorb(seen_by(0, {walking(0.01 * k)}, time));
      method.update(time);
      const auto pose = method.pose(0, time);
      if (k < 200 || !pose) continue;
      found += pose->level < TrackingLevel::held;
      worst_m = std::max(worst_m, error_m(method, 0, time, walking(0.01 * k)));
      EXPECT_EQ(pose->level == TrackingLevel::six_dof, leds.size() == 4) << name_of(pose->level);
    }
    EXPECT_EQ(found, 1800);
    EXPECT_LT(worst_m, 0.08);
  }
}

/// A look is spread over frames, and its reports are forgotten after some of them.
TEST_F(JointMethodTest, finds_a_head_however_long_frames_are) {
  configs_.pop_back();
  heads_[0].leds_in_head = kFourLeds;
  for (const int frame : {1, 3, 10, 30}) {  // of ten milliseconds
    JointMethod method(configs_, heads_);
    for (int k = 0; k < 300; ++k) {
      const Time time{milliseconds(10 * k)};
      method.absorb(seen_by(0, {walking(0.01 * k)}, time));
      if ((k + 1) % frame == 0) method.update(time);
    }
    EXPECT_LT(error_m(method, 0, Time{milliseconds(2990)}, walking(2.99)), 0.1) << frame;
  }
}

TEST_F(JointMethodTest, says_that_dots_enough_fit_no_head) {
  JointMethod method(configs_, heads_);
  heads_[0].leds_in_head = {{-0.3, 0, 0}, {0, 0.3, 0.1}, {0.2, 0, 0}};
  feed(method, 0, 3, [](double t) { return std::vector{walking(t)}; });
  EXPECT_FALSE(method.nothing_fits());
  feed(method, 3, 15, [](double t) { return std::vector{walking(t)}; });
  EXPECT_TRUE(method.nothing_fits());
}

TEST_F(JointMethodTest, places_the_eye_for_half_a_second_by_what_was_sure) {
  JointMethod method(configs_, heads_);
  const auto stands = [](double) { return std::vector{walking(0)}; };
  feed(method, 0, 2, stands);
  heads_[0].leds_in_head = {kThreeLeds[0]};  // both cameras see this one alone
  feed(method, 2, 2.4, stands);
  EXPECT_EQ(method.pose(0, Time{milliseconds(2390)})->level, TrackingLevel::position);
  EXPECT_LT(error_m(method, 0, Time{milliseconds(2390)}, walking(0)), 0.03);
  feed(method, 2.4, 2.8, stands);
  EXPECT_EQ(method.pose(0, Time{milliseconds(2790)})->level, TrackingLevel::bearing);
}

/// Two dots of one camera and one of another fit some pose whichever LEDs they are, and so do two
/// LEDs that both see. Two of each that are three LEDs do not.
TEST_F(JointMethodTest, vouches_for_a_place_as_long_as_dots_tell_one_led_from_another) {
  using Leds = std::vector<std::size_t>;
  struct Case {
    Leds left, right;
    bool vouched;
  };
  for (const auto& [left, right, vouched] :
       {Case{{0, 1}, {0}, false}, Case{{0, 1}, {0, 1}, false}, Case{{0, 1}, {1, 2}, true}}) {
    JointMethod method(configs_, heads_);
    const auto stands = [](double) { return std::vector{walking(0)}; };
    feed(method, 0, 2, stands);
    for (int k = 200; k < 400; ++k) {
      const Time time{milliseconds(10 * k)};
      for (const auto& [camera, leds] : {std::pair{0, left}, std::pair{1, right}}) {
        Observation seen = seen_by(camera, stands(0), time);
        const DotList all = std::exchange(seen.dots, {});
        ASSERT_EQ(all.size(), 3u);
        for (const std::size_t led : leds) seen.dots.push_back(all[led]);
        method.absorb(seen);
      }
      method.update(time);
    }
    const auto pose = method.pose(0, Time{milliseconds(3990)});
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->level != TrackingLevel::bearing, vouched) << left.size() << right.size();
    EXPECT_LT(error_m(method, 0, Time{milliseconds(3990)}, walking(0)), 0.06);
  }
}

TEST_F(JointMethodTest, in_position_mode_needs_one_led_in_two_cameras) {
  JointMethod method(configs_, heads_, {.position_only = true});
  heads_[0].leds_in_head = {{0, 0, 0}};
  feed(method, 0, 2, [](double t) { return std::vector{walking(t)}; });
  const auto pose = method.pose(0, Time{milliseconds(1990)});
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->level, TrackingLevel::position);
  EXPECT_LT(pose->room_from_head.rotation.angularDistance(Quat::Identity()), 1e-9);
}

}  // namespace
}  // namespace vindu
