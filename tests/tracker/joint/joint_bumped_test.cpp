// The joint method before cameras that do not stand where they are said to: of two, which
// contradict each other, and of three, of which two agree.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tracker/joint/joint_method_fixture.h"

namespace vindu {
namespace {

using namespace test;
using std::chrono::milliseconds;

using JointBumpedTest = JointMethodTest;

TEST_F(JointBumpedTest, names_the_one_of_three_cameras_that_was_bumped) {
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
TEST_F(JointBumpedTest, follows_a_head_though_two_cameras_contradict_each_other_and_says_so) {
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
TEST_F(JointBumpedTest, takes_no_head_for_another_though_two_cameras_contradict_each_other) {
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

TEST_F(JointBumpedTest, tracks_two_heads_though_two_cameras_contradict_each_other) {
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

TEST_F(JointBumpedTest, takes_a_camera_that_is_bumped_and_put_right_again_as_it_is) {
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
TEST_F(JointBumpedTest, knows_by_how_much_a_place_is_off_that_heads_look_too_small_for) {
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
TEST_F(JointBumpedTest, finds_no_contradiction_where_heads_are_taken_to_face_the_wall) {
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
TEST_F(JointBumpedTest, follows_the_two_of_three_cameras_that_agree_and_knows_which_stands_aside) {
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
TEST_F(JointBumpedTest, goes_on_with_the_two_that_agree_when_a_third_is_bumped_to_the_side) {
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

TEST_F(JointBumpedTest, takes_no_still_head_for_lamps_where_a_camera_stands_aside) {
  add_middle_camera();
  JointMethod method(configs_, heads_);
  bump(0, 12, 2);
  feed(method, 0, 12, [](double) { return std::vector{walking(0)}; });
  const auto health = method.health();
  EXPECT_NEAR(health[2].aside_px, 12, 1);
  for (const CameraHealth& camera : health) EXPECT_EQ(camera.masks, 0u);
}

TEST_F(JointBumpedTest, takes_in_again_a_camera_that_stood_aside_when_another_is_gone) {
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

/// Half a second after another has gone, the one that is left tells of three LEDs a bearing.
TEST_F(JointBumpedTest, vouches_for_no_place_by_a_camera_that_stands_aside) {
  add_middle_camera();
  JointMethod method(configs_, heads_);
  bump(0, 12, 2);
  const auto walks = [](double t) { return std::vector{walking(t)}; };
  feed(method, 0, 5, walks);
  EXPECT_NEAR(method.health()[2].aside_px, 12, 1);
  for (int k = 500; k < 600; ++k) {
    const Time time{milliseconds(10 * k)};
    for (const int camera : {0, 2}) method.absorb(seen_by(camera, walks(0.01 * k), time));
    method.update(time);
    if (k > 560) {
      EXPECT_GE(method.pose(0, time)->level, TrackingLevel::bearing) << k;
    }
  }
}

}  // namespace
}  // namespace vindu
