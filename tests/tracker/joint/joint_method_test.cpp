// The whole joint method on reports: late ones, lost heads, several heads, a camera that was
// bumped.
#include "tracker/joint/joint_method.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/tracker/joint/scene.h"

namespace vindu {
namespace {

using namespace test;
using std::chrono::milliseconds;

struct Report {
  Time arrival{};
  Observation seen;
};

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
      const Time time{milliseconds(10 * k)};
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

TEST_F(JointMethodTest, knows_the_calibrated_background_from_the_first_report_on) {
  for (CameraConfig& camera : configs_) camera.masks_px = {{512, 600}, {100, 100}};
  JointMethod method(configs_, heads_);
  for (const CameraHealth& health : method.health()) EXPECT_EQ(health.masks, 2u);
}

TEST_F(JointMethodTest, names_the_one_of_three_cameras_that_was_bumped) {
  add_middle_camera();
  JointMethod method(configs_, heads_);
  const auto walks = [](double t) { return std::vector{walking(t)}; };
  feed(method, 0, 3, walks);
  EXPECT_FALSE(method.health()[2].moved);
  bump(1, 28, 2);
  feed(method, 3, 9, walks);
  EXPECT_TRUE(method.health()[2].moved);
  EXPECT_FALSE(method.health()[0].moved);
  EXPECT_FALSE(method.health()[1].moved);
  EXPECT_LT(error_m(method, 0, Time{milliseconds(8990)}, walking(8.99)), 0.02);
}

/// A quarter of a degree (5 px), up and down: no pose of a head fits both cameras' dots.
TEST_F(JointMethodTest, follows_a_head_though_two_cameras_contradict_each_other_and_says_so) {
  const std::vector<CameraConfig> calibrated = configs_;
  for (const double px : {0.0, 5.0, 15.0, 40.0}) {
    JointMethod method(calibrated, heads_);
    configs_ = calibrated;
    bump(0, px);
    feed(method, 0, 20, [](double t) { return std::vector{walking(t)}; });
    const Time end{milliseconds(19990)};
    const auto pose = method.pose(0, end);
    ASSERT_TRUE(pose) << px;
    EXPECT_LT(pose->level, TrackingLevel::held) << px;
    EXPECT_GE(method.disagreement_px(), 0.25 * px);
    EXPECT_LE(method.disagreement_px(), 0.75 * px);
    const double sigma_m = std::sqrt(pose->covariance.topLeftCorner<3, 3>().trace());
    EXPECT_LT(error_m(method, 0, end, walking(19.99)), 3 * sigma_m) << px;
    EXPECT_LT(sigma_m, 0.003 + 0.004 * px);
  }
}

/// Of two helmets, whose layouts differ, one is there.
TEST_F(JointMethodTest, takes_no_head_for_another_though_two_cameras_contradict_each_other) {
  const std::vector<CameraConfig> calibrated = configs_;
  std::vector<HeadConfig> both(2);
  both[0].leds_in_head = kThreeLeds;
  both[1].leds_in_head = kFourLeds;
  for (const double px : {5.0, 15.0})
    for (const std::size_t there : {0u, 1u}) {
      JointMethod method(calibrated, both);
      configs_ = calibrated;
      bump(0, px);
      heads_ = {both[there]};
      feed(method, 0, 20, [](double t) { return std::vector{walking(t)}; });
      const Time end{milliseconds(19990)};
      EXPECT_LT(error_m(method, there, end, walking(19.99)), 0.004 * px) << px << ", " << there;
      const auto other = method.pose(1 - there, end);
      EXPECT_TRUE(!other || other->level == TrackingLevel::lost) << px << ", " << there;
      EXPECT_GE(method.disagreement_px(), 0.25 * px);
    }
}

TEST_F(JointMethodTest, tracks_two_heads_though_two_cameras_contradict_each_other) {
  heads_.resize(2);
  heads_[1].leds_in_head = kFourLeds;
  const auto both = [](double t) {
    Rigid3 first = walking(t), other = walking(1.3 * t + 1);
    first.translation.x() += 0.4;
    other.translation.x() -= 0.55;
    return std::vector{first, other};
  };
  JointMethod method(configs_, heads_);
  bump(0, 8);
  feed(method, 0, 20, both);
  const Time end{milliseconds(19990)};
  for (const std::size_t head : {0u, 1u})
    EXPECT_LT(error_m(method, head, end, both(19.99)[head]), 0.03);
}

TEST_F(JointMethodTest, takes_a_camera_that_is_bumped_and_put_right_again_as_it_is) {
  const std::vector<CameraConfig> calibrated = configs_;
  JointMethod method(calibrated, heads_);
  const auto walks = [](double t) { return std::vector{walking(t)}; };
  feed(method, 0, 3, walks);
  EXPECT_EQ(method.disagreement_px(), 0);
  bump(0, 8);
  feed(method, 3, 10, walks);
  EXPECT_LT(method.pose(0, Time{milliseconds(9990)})->level, TrackingLevel::held);
  EXPECT_GT(method.disagreement_px(), 2);
  configs_ = calibrated;
  feed(method, 10, 50, walks);
  EXPECT_EQ(method.disagreement_px(), 0);
  EXPECT_LT(error_m(method, 0, Time{milliseconds(49990)}, walking(49.99)), 0.006);
}

/// To the side their rays meet all the same, in a wrong place, where the head looks too small.
TEST_F(JointMethodTest, knows_by_how_much_a_place_is_off_that_heads_look_too_small_for) {
  const std::vector<CameraConfig> calibrated = configs_;
  for (const double px : {8.0, 15.0, -15.0}) {
    JointMethod method(calibrated, heads_);
    configs_ = calibrated;
    bump(1, px);
    feed(method, 0, 10, [](double t) { return std::vector{walking(t)}; });
    const Time end{milliseconds(9990)};
    const double off_m = error_m(method, 0, end, walking(9.99));
    EXPECT_NEAR(std::abs(method.heads_look_larger()), off_m / 3.3, 0.25 * off_m / 3.3) << px;
    const auto pose = method.pose(0, end);
    const double sigma_m = std::sqrt(pose->covariance.topLeftCorner<3, 3>().trace());
    EXPECT_NEAR(sigma_m, off_m, 0.3 * off_m) << px;
  }
}

/// The rotation is given there, not found: a head that turns looks narrower.
TEST_F(JointMethodTest, finds_no_contradiction_where_heads_are_taken_to_face_the_wall) {
  JointMethod method(configs_, heads_, {.position_only = true});
  feed(method, 0, 20, [](double t) {
    Rigid3 head = walking(t);
    head.rotation = rotation_of({0.2, 0.7 * std::sin(1.1 * t), 0});
    return std::vector{head};
  });
  EXPECT_EQ(method.disagreement_px(), 0);
  EXPECT_EQ(method.heads_look_larger(), 0);
  EXPECT_FALSE(method.nothing_fits());
}

/// Two of three are right.
TEST_F(JointMethodTest, follows_the_two_of_three_cameras_that_agree_and_knows_which_stands_aside) {
  add_middle_camera();
  const std::vector<CameraConfig> calibrated = configs_;
  for (const std::size_t bumped : {0u, 1u, 2u})
    for (const double px : {0.0, 4.0, 5.0, 6.0, 8.0, 21.0}) {
      JointMethod method(calibrated, heads_);
      configs_ = calibrated;
      bump(0, px, bumped);
      double worst_m = 0;
      for (int k = 0; k < 1000; ++k) {
        const Time time{milliseconds(10 * k)};
        for (int camera = 0; camera < 3; ++camera)
          method.absorb(seen_by(camera, {walking(0.01 * k)}, time));
        method.update(time);
        if (k > 500) worst_m = std::max(worst_m, error_m(method, 0, time, walking(0.01 * k)));
      }
      EXPECT_LT(worst_m, 0.01) << px << " px, camera " << bumped;
      EXPECT_LT(method.pose(0, Time{milliseconds(9990)})->level, TrackingLevel::held);
      const auto health = method.health();
      for (const std::size_t camera : {0u, 1u, 2u}) {
        const double aside_px = health[camera].aside_px;
        if (camera == bumped)
          EXPECT_NEAR(aside_px, px, 0.5 * px) << px << " px, camera " << bumped;
        else
          EXPECT_LE(aside_px, 0.4 * px) << px << " px, camera " << bumped;
      }
    }
}

/// To the side all rays go on meeting, somewhere else.
TEST_F(JointMethodTest, goes_on_with_the_two_that_agree_when_a_third_is_bumped_to_the_side) {
  add_middle_camera();
  const std::vector<CameraConfig> calibrated = configs_;
  for (const std::size_t bumped : {0u, 1u, 2u})
    for (const double px : {-17.0, 12.0, 35.0}) {
      configs_ = calibrated;
      JointMethod method(calibrated, heads_);
      feed(method, 0, 4, [](double t) { return std::vector{walking(t)}; });
      bump(1, px, bumped);
      feed(method, 4, 12, [](double t) { return std::vector{walking(t)}; });
      EXPECT_LT(error_m(method, 0, Time{milliseconds(11990)}, walking(11.99)), 0.01)
          << px << " px, camera " << bumped;
      const auto health = method.health();
      for (const std::size_t camera : {0u, 1u, 2u})
        EXPECT_NEAR(health[camera].aside_px, camera == bumped ? std::abs(px) : 0,
                    0.1 * std::abs(px))
            << px << " px, camera " << bumped;
    }
}

TEST_F(JointMethodTest, takes_no_still_head_for_lamps_where_a_camera_stands_aside) {
  add_middle_camera();
  JointMethod method(configs_, heads_);
  bump(0, 12, 2);
  feed(method, 0, 12, [](double) { return std::vector{walking(0)}; });
  const auto health = method.health();
  EXPECT_NEAR(health[2].aside_px, 12, 1);
  for (const CameraHealth& camera : health) EXPECT_EQ(camera.masks, 0u);
}

TEST_F(JointMethodTest, takes_in_again_a_camera_that_stood_aside_when_another_is_gone) {
  add_middle_camera();
  const std::vector<CameraConfig> calibrated = configs_;
  JointMethod method(calibrated, heads_);
  const auto walks = [](double t) { return std::vector{walking(t)}; };
  const auto nobody = [](double) { return std::vector<Rigid3>{}; };
  bump(0, 10, 2);
  feed(method, 0, 5, walks);
  EXPECT_NEAR(method.health()[2].aside_px, 10, 1);
  configs_ = calibrated;  // the middle one is put right; the right one is gone
  const auto feed_two = [&](double from_s, double to_s, const auto& heads_at) {
    for (int k = static_cast<int>(100 * from_s); k < static_cast<int>(100 * to_s); ++k) {
      const Time time{milliseconds(10 * k)};
      for (const int camera : {0, 2}) method.absorb(seen_by(camera, heads_at(0.01 * k), time));
      method.update(time);
    }
  };
  feed_two(5, 6, nobody);
  feed_two(6, 14, walks);
  EXPECT_EQ(method.health()[2].aside_px, 0);
  EXPECT_LT(method.pose(0, Time{milliseconds(13990)})->level, TrackingLevel::bearing);
  EXPECT_LT(error_m(method, 0, Time{milliseconds(13990)}, walking(13.99)), 0.01);
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
