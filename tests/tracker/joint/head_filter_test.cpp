// The filter of one head, its association with dots, and what is known of reflections.
#include "tracker/joint/head_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <functional>

#include "tests/tracker/joint/scene.h"
#include "tracker/joint/association.h"
#include "tracker/joint/camera_watch.h"
#include "tracker/joint/dot_sizes.h"
#include "tracker/joint/rotation.h"
#include "tracker/joint/static_dots.h"

namespace vindu {
namespace {

using namespace test;
using std::chrono::milliseconds;
using std::chrono::seconds;

HeadState known_at(const Rigid3& head, Time time, double sigma_m = 0.01) {
  PoseFit fit{.room_from_head = head};
  fit.information.diagonal().head<3>().setConstant(1 / (sigma_m * sigma_m));
  fit.information.diagonal().tail<3>().setConstant(1 / std::pow(radians(3), 2));
  return state_of(fit, time);
}

/// After so long, by Euler's steps of a hundredth of a millisecond: da/dt = -k a - k^2 v.
struct Drawn {
  double way = 0, velocity = 0, acceleration = 0;

  void on(double length_s) {
    constexpr double k = 2.5, kStep_s = 1e-5;
    for (long i = 0; i < std::lround(length_s / kStep_s); ++i) {
      way += kStep_s * velocity;
      const double jerk = -k * acceleration - k * k * velocity;
      velocity += kStep_s * acceleration;
      acceleration += kStep_s * jerk;
    }
  }
};

TEST(HeadFilter, moves_on_with_velocities_that_are_drawn_back_to_zero) {
  HeadState state = known_at({Quat::Identity(), {0, 1.6, 2}}, Time{});
  state.move = {{0.4, 0, 0}, {1.5, 0, 0}};
  state.turn = {{0, 0.5, 0}, {0, -2, 0}};
  Drawn move{0, 0.4, 1.5}, turn{0, 0.5, -2};
  move.on(0.5), turn.on(0.5);
  propagate(state, Time{} + milliseconds(500), {});
  EXPECT_NEAR(state.room_from_head.translation.x(), move.way, 1e-4);
  EXPECT_NEAR(state.move.velocity.x(), move.velocity, 1e-4);
  EXPECT_NEAR(state.move.acceleration.x(), move.acceleration, 1e-4);
  EXPECT_NEAR(vector_of(state.room_from_head.rotation).y(), turn.way, 1e-4);
  EXPECT_NEAR(state.turn.velocity.y(), turn.velocity, 1e-4);
}

/// What a step does to the state it does to its errors.
TEST(HeadFilter, carries_its_errors_as_it_carries_its_state) {
  const auto moved_on = [](double velocity, double acceleration) {
    HeadState state = known_at({}, Time{});
    state.covariance *= 1e-20;
    state.move = {{velocity, 0, 0}, {acceleration, 0, 0}};
    state.covariance(3, 3) = velocity * velocity;
    state.covariance(6, 6) = acceleration * acceleration;
    propagate(state, Time{} + milliseconds(200), {Mat3::Zero(), Mat3::Zero()});
    return state;
  };
  for (const HeadState& state : {moved_on(1, 0), moved_on(0, 1)}) {
    const auto sigma = [&](int i) { return std::sqrt(state.covariance(i, i)); };
    EXPECT_NEAR(sigma(0), std::abs(state.room_from_head.translation.x()), 1e-9);
    EXPECT_NEAR(sigma(3), std::abs(state.move.velocity.x()), 1e-9);
    EXPECT_NEAR(sigma(6), std::abs(state.move.acceleration.x()), 1e-9);
  }
}

TEST(HeadFilter, comes_to_rest_when_damped) {
  HeadState state = known_at({}, Time{});
  state.move.velocity = {1, 0, 0};
  for (int i = 1; i <= 100; ++i)
    propagate(state, Time{} + milliseconds(10 * i), {}, {.move_damping = milliseconds(100)});
  EXPECT_NEAR(state.room_from_head.translation.x(), 0.1, 1e-4);  // velocity times time constant
  EXPECT_LT(state.move.velocity.norm(), 1e-3);
}

TEST(HeadFilter, grows_its_covariance_alike_in_one_step_and_in_many) {
  HeadState one = known_at({}, Time{}), many = one;
  one.turn.velocity = many.turn.velocity = {0.2, 0.7, -0.1};
  propagate(one, Time{} + milliseconds(64), {});
  for (int i = 1; i <= 64; ++i) propagate(many, Time{} + milliseconds(i), {});
  EXPECT_LT((one.covariance - many.covariance).norm(), 0.01 * one.covariance.norm());
}

TEST(HeadFilter, draws_an_open_rotation_to_facing_the_wall_and_leaves_a_known_one) {
  const Quat aside(Eigen::AngleAxisd(radians(70), Vec3::UnitY()));
  const auto turned_after = [&](double sigma_rad, Duration waited) {
    HeadState state = known_at({aside, {0, 1.6, 2}}, Time{});
    state.covariance.diagonal().segment<3>(9).setConstant(sigma_rad * sigma_rad);
    for (int i = 0; i < waited / milliseconds(10); ++i) expect_facing(state, milliseconds(10));
    EXPECT_LT((state.room_from_head.translation - Vec3(0, 1.6, 2)).norm(), 1e-12);
    return vector_of(state.room_from_head.rotation).y();
  };
  EXPECT_GT(turned_after(radians(1), seconds(1)), radians(69.8));
  // Of the 3.3 looks of a second, each with a sigma of 50 degrees, and a memory with one of 40.
  EXPECT_NEAR(turned_after(radians(40), seconds(1)), radians(70 / (1 + 1 / 0.3 * 0.64)),
              radians(1));
}

TEST(HeadFilter, calms_its_turning_about_one_axis_alone) {
  HeadState state = known_at({}, Time{});
  state.turn.velocity = {0.8, 0.5, 0};
  state.covariance(12, 0) = state.covariance(0, 12) = 0.004;
  const HeadState before = state;
  calm_turning(state, Vec3::UnitX(), 0.25);
  EXPECT_LT((state.turn.velocity - Vec3(0.2, 0.5, 0)).norm(), 1e-12);
  EXPECT_NEAR(state.covariance(12, 12), before.covariance(12, 12) / 16, 1e-12);
  EXPECT_NEAR(state.covariance(13, 13), before.covariance(13, 13), 1e-12);
  EXPECT_NEAR(state.covariance(0, 12), 0.001, 1e-12);
  EXPECT_EQ(state.covariance, state.covariance.transpose());
}

TEST(HeadFilter, expects_a_dot_as_uncertain_as_it_really_is) {
  const CameraModel camera = cameras_behind(2)[0];
  const Rigid3 head{Quat::Identity(), {0.1, 1.65, 2}};
  const HeadState state = known_at(head, Time{}, 0.005);
  const auto expected = expect_dot(state, camera, kFourLeds[0]);
  ASSERT_TRUE(expected);
  Random random(1);
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    const auto noise = [&](double sigma) {
      return Vec3(random.normal(sigma), random.normal(sigma), random.normal(sigma));
    };
    const Rigid3 other{rotation_of(noise(radians(3))) * head.rotation,
                       head.translation + noise(0.005)};
    const Vec2 off = dot_of(camera, other, kFourLeds[0]) - expected->raw_px;
    scatter += off * off.transpose() / kTrials;
  }
  EXPECT_LT((scatter - expected->covariance_px2).norm(), 0.1 * scatter.norm());
}

TEST(HeadFilter, stays_a_covariance_through_a_thousand_dots) {
  const auto cameras = cameras_behind(2);
  Random random(2);
  HeadState state = known_at({Quat::Identity(), {0, 1.65, 2}}, Time{});
  for (int i = 1; i <= 1000; ++i) {
    propagate(state, Time{} + milliseconds(5 * i), noise_of_motion(state));
    const CameraModel& camera = cameras[static_cast<std::size_t>(i % 2)];
    const auto expected = expect_dot(state, camera, kFourLeds[static_cast<std::size_t>(i % 4)]);
    ASSERT_TRUE(expected);
    correct(state, *expected, expected->raw_px + Vec2(random.normal(0.5), random.normal(0.5)),
            0.36 * Eigen::Matrix2d::Identity());
    ASSERT_EQ(state.covariance.llt().info(), Eigen::Success) << "not positive definite";
  }
}

TEST(HeadFilter, may_accelerate_the_way_it_moves_more_than_aside) {
  HeadState state = known_at({}, Time{});
  state.covariance *= 1e-4;
  const double at_rest = noise_of_motion(state).move_m2_s5(0, 0);
  EXPECT_LT((noise_of_motion(state).move_m2_s5 - at_rest * Mat3::Identity()).norm(), 1e-12);
  const Vec3 way(0.6, 0, 0.8), aside(0, 1, 0);
  state.move.velocity = 0.5 * way;
  const Mat3 noise = noise_of_motion(state).move_m2_s5;
  EXPECT_GT(way.dot(noise * way), 50 * at_rest);
  EXPECT_NEAR((way.dot(noise * way) - at_rest) / (aside.dot(noise * aside) - at_rest), 10, 1e-6);
  EXPECT_LT((noise_of_motion(state).turn_rad2_s5 - at_rest * Mat3::Identity()).norm(), 1e-12);
}

TEST(HeadFilter, takes_noise_of_a_rate_for_no_motion) {
  HeadState state = known_at({}, Time{});
  const double sigma_m_s = std::sqrt(state.covariance.diagonal().segment<3>(3).sum());
  state.move.velocity = {0.4 * sigma_m_s, 0, 0};
  EXPECT_EQ(noise_of_motion(state).move_m2_s5, noise_of_motion(known_at({}, Time{})).move_m2_s5);
}

TEST(HeadFilter, may_change_more_the_harder_it_accelerates) {
  HeadState state = known_at({}, Time{});
  state.covariance *= 1e-4;
  EXPECT_EQ(noise_of_change(state).turn_rad2_s5, Mat3(Mat3::Zero()));
  state.turn.acceleration = {0, 4, 0};
  const Mat3 noise = noise_of_change(state).turn_rad2_s5;
  EXPECT_NEAR(noise(1, 1) / noise(0, 0), 10, 1e-6);
  state.turn.acceleration = {0, 8, 0};
  EXPECT_NEAR(noise_of_change(state).turn_rad2_s5(1, 1), 4 * noise(1, 1), 0.01 * noise(1, 1));
  EXPECT_GT(noise(1, 1), 50);
}

/// Noise for change of a head at rest after 150 ms of dots, each aside by its share of a pixel.
MotionNoise change_after(const std::function<double(int)>& aside_px) {
  const auto cameras = cameras_behind(2);
  HeadState state = known_at({Quat::Identity(), {0, 1.65, 2}}, Time{}, 0.002);
  state.covariance.diagonal().segment<6>(3) *= 1e-3;
  state.covariance.diagonal().segment<6>(12) *= 1e-3;
  const HeadState at_rest = state;
  for (int i = 1; i <= 30; ++i) {
    propagate(state, Time{} + milliseconds(5 * i), noise_of_motion(state));
    const CameraModel& camera = cameras[static_cast<std::size_t>(i % 2)];
    for (const Vec3& led : kFourLeds) {
      const Vec2 raw_px = expect_dot(at_rest, camera, led)->raw_px + Vec2(aside_px(i), 0);
      correct(state, *expect_dot(state, camera, led), raw_px, 0.36 * Eigen::Matrix2d::Identity());
    }
  }
  return noise_of_change(state);
}

TEST(HeadFilter, allows_for_change_where_dots_keep_pulling_one_way) {
  Random random(3);
  const auto scattered = [&](int) { return random.normal(0.6); };
  const auto setting_off = [](int i) { return 1300 * std::pow(0.005 * i, 3); };  // 18 m/s^3
  EXPECT_LT(change_after(scattered).move_m2_s5.trace(), 0.5);
  const Mat3 change = change_after(setting_off).move_m2_s5;
  EXPECT_GT(change(0, 0), 5);
  EXPECT_GT(change(0, 0), 3 * change(1, 1));
}

TEST(HeadFilter, is_less_sure_of_what_it_predicts) {
  HeadState state = known_at({}, Time{});
  const auto place = [](const PoseSample& pose) -> Mat3 {
    return pose.covariance.topLeftCorner<3, 3>();
  };
  EXPECT_LT((place(predicted(state, milliseconds(40))) - place(sample_of(state))).norm(), 1e-8)
      << "at rest nothing is predicted";
  state.move.velocity = {0.5, 0, 0};
  HeadState later = state;
  propagate(later, Time{} + milliseconds(40), noise_of_motion(state));
  EXPECT_LT((place(predicted(state, milliseconds(40))) - place(sample_of(later))).norm(), 1e-12);
  EXPECT_GT(place(sample_of(later)).trace(), 2 * place(sample_of(state)).trace());
}

TEST(HeadFilter, predicts_a_moving_head_and_leaves_a_still_one) {
  HeadState state = known_at({}, Time{});
  state.move.velocity = {0.5, 0, 0};
  const auto way_after = [&](Duration ahead) {
    return predicted(state, ahead).room_from_head.translation.x();
  };
  Drawn move{0, 0.5, 0};
  move.on(0.04);
  EXPECT_NEAR(way_after(milliseconds(40)), move.way, 1e-6);
  move.on(0.02);
  EXPECT_NEAR(way_after(milliseconds(60)), move.way, 1e-6);
  EXPECT_EQ(way_after(seconds(3)), way_after(milliseconds(60)));  // the farthest that it looks
  state.move.velocity = {0.005, 0, 0};
  EXPECT_EQ(way_after(milliseconds(40)), 0);
}

class AssociationTest : public ::testing::Test {
 protected:
  TimedDots seen_of(const Rigid3& head, int camera, Time time) const {
    return seen_of(head, camera, time, leds_[0]);
  }
  TimedDots seen_of(const Rigid3& head, int camera, Time time,
                    std::span<const Vec3> leds_in_head) const {
    TimedDots seen{.camera = camera, .captured = time, .dots = {}};
    for (const Vec3& led : leds_in_head) {
      const Vec2 raw_px = dot_of(cameras_[static_cast<std::size_t>(camera)], head, led);
      seen.dots.push_back({std::round(raw_px.x()), std::round(raw_px.y()), 3});
    }
    return seen;
  }

  std::vector<CameraModel> cameras_ = cameras_behind(2);
  std::vector<std::vector<Vec3>> leds_ = {kFourLeds};
  Rigid3 head_{Quat::Identity(), {0, 1.65, 2}};
  std::vector<HeadTrack> heads_ = {{known_at(head_, Time{}), Time{}}};
};

TEST_F(AssociationTest, gives_each_dot_its_led_whatever_their_order) {
  TimedDots seen = seen_of(head_, 0, Time{} + milliseconds(10));
  std::swap(seen.dots[0], seen.dots[2]);
  std::swap(seen.dots[1], seen.dots[3]);
  const auto result = associate(seen, cameras_[0], leds_, heads_);
  ASSERT_EQ(result.accepted.size(), 4u);
  const int led_of_dot[] = {2, 3, 0, 1};
  for (const AcceptedDot& dot : result.accepted) EXPECT_EQ(dot.led, led_of_dot[dot.dot]);
}

TEST_F(AssociationTest, leaves_out_false_dots_and_does_with_missing_leds) {
  TimedDots seen = seen_of(head_, 0, Time{} + milliseconds(10));
  seen.dots[1] = {900, 100, 3};
  seen.dots.push_back({20, 700, 3});
  const auto result = associate(seen, cameras_[0], leds_, heads_);
  EXPECT_EQ(result.accepted.size(), 3u);
  for (const AcceptedDot& dot : result.accepted) EXPECT_NE(dot.dot, 1u);
}

TEST_F(AssociationTest, tells_of_dots_a_little_aside_though_they_correct_nothing) {
  heads_[0].state = known_at(head_, Time{}, 1e-4);
  heads_[0].state->covariance.diagonal().segment<3>(9).setConstant(1e-8);
  const auto with_one_aside_by = [&](double y_px) {
    std::vector<HeadTrack> heads = heads_;
    TimedDots seen = seen_of(head_, 0, Time{} + milliseconds(1));
    seen.dots[2].y_px = dot_of(cameras_[0], head_, leds_[0][2]).y() + y_px;
    return associate(seen, cameras_[0], leds_, heads, {.may_widen = false});
  };
  EXPECT_EQ(with_one_aside_by(1).accepted.size(), 4u);
  EXPECT_TRUE(with_one_aside_by(1).aside.empty());
  const Association near = with_one_aside_by(2.7), far = with_one_aside_by(5);
  EXPECT_EQ(near.accepted.size(), 3u);
  ASSERT_EQ(near.aside.size(), 1u);
  EXPECT_NEAR(near.aside[0].residual_px.y(), 2.7, 0.1);
  EXPECT_EQ(far.accepted.size(), 3u);
  EXPECT_TRUE(far.aside.empty());
}

TEST_F(AssociationTest, takes_a_masked_dot_only_where_an_led_must_be) {
  TimedDots seen = seen_of(head_, 0, Time{} + milliseconds(10));
  seen.masked.fill(true);
  EXPECT_EQ(associate(seen, cameras_[0], leds_, heads_).accepted.size(), 4u);
  heads_[0].state->covariance.diagonal().head<3>().setConstant(0.05 * 0.05);
  TimedDots aside =
      seen_of({head_.rotation, head_.translation + Vec3(0.02, 0, 0)}, 0, Time{} + milliseconds(20));
  aside.masked.fill(true);
  EXPECT_TRUE(associate(aside, cameras_[0], leds_, heads_).accepted.empty());
}

TEST_F(AssociationTest, leaves_a_reflection_alone_unless_the_head_is_well_seen) {
  heads_[0].led_seen.fill(Time{} - seconds(1));
  TimedDots seen = seen_of(head_, 0, Time{} + milliseconds(10));
  seen.masked.fill(true);
  EXPECT_TRUE(associate(seen, cameras_[0], leds_, heads_).accepted.empty());
}

TEST_F(AssociationTest, lets_a_dot_that_may_be_either_of_two_leds_correct_nothing) {
  const Vec3 between = 0.5 * (leds_[0][2] + leds_[0][3]);
  const TimedDots seen = seen_of(head_, 0, Time{} + milliseconds(10), {&between, 1});
  heads_[0].state->covariance.diagonal().head<3>().setConstant(0.03 * 0.03);
  const auto result = associate(seen, cameras_[0], leds_, heads_);
  EXPECT_TRUE(result.accepted.empty());
  EXPECT_TRUE(result.disputed[0]);
  EXPECT_LT((heads_[0].state->room_from_head.translation - head_.translation).norm(), 1e-9);
}

TEST_F(AssociationTest, takes_no_two_dots_that_may_as_well_change_places) {
  leds_[0][2] = {-0.015, -0.06, 0};
  leds_[0][3] = {0.015, -0.06, 0};
  const auto of_two_leds = [&](double sigma_m) {
    heads_ = {{known_at(head_, Time{}, sigma_m), Time{}}};
    const TimedDots seen =
        seen_of(head_, 0, Time{} + milliseconds(10), std::span(leds_[0]).last(2));
    return associate(seen, cameras_[0], leds_, heads_);
  };
  EXPECT_EQ(of_two_leds(0.005).accepted.size(), 2u);
  const Association vague = of_two_leds(0.06);
  EXPECT_TRUE(vague.accepted.empty());
  EXPECT_TRUE(vague.disputed[0] && vague.disputed[1]);
}

/// Nothing tells how a head turns about the line through the only two LEDs that are seen.
TEST_F(AssociationTest, stops_a_head_that_turns_about_two_leds) {
  leds_ = {kThreeLeds};
  heads_[0].led_seen.fill(Time{} - seconds(1));
  const Vec3 axis = (kThreeLeds[1] - kThreeLeds[0]).normalized();
  heads_[0].state->turn.velocity = 2 * axis;
  for (int i = 1; i <= 50; ++i) {
    const TimedDots seen =
        seen_of(head_, i % 2, Time{} + milliseconds(10 * i), std::span(kThreeLeds).first(2));
    associate(seen, cameras_[static_cast<std::size_t>(i % 2)], leds_, heads_);
  }
  ASSERT_TRUE(heads_[0].state);
  EXPECT_LT(heads_[0].state->turn.velocity.norm(), 0.3);
  EXPECT_LT(vector_of(heads_[0].state->room_from_head.rotation).norm(), 0.4);  // of 1 rad
}

TEST_F(AssociationTest, doubts_a_head_of_which_all_dots_stand_aside) {
  const Rigid3 aside{head_.rotation, head_.translation + Vec3(0.02, 0.01, 0)};
  heads_[0].state->covariance.diagonal().head<3>().setConstant(1e-6);
  heads_[0].state->covariance.diagonal().segment<3>(9).setConstant(1e-6);
  heads_[0].state->covariance.diagonal().segment<3>(3).setConstant(1e-6);
  for (int i = 1; i <= 8; ++i)
    associate(seen_of(aside, i % 2, Time{} + milliseconds(5 * i)), cameras_[i % 2], leds_, heads_);
  EXPECT_LT((heads_[0].state->room_from_head.translation - aside.translation).norm(), 0.004);
}

TEST_F(AssociationTest, gives_up_a_head_that_is_not_seen) {
  TimedDots empty{.camera = 0, .captured = Time{} + milliseconds(240), .dots = {}};
  associate(empty, cameras_[0], leds_, heads_);
  EXPECT_TRUE(heads_[0].state);
  empty.captured = Time{} + milliseconds(260);
  associate(empty, cameras_[0], leds_, heads_);
  EXPECT_FALSE(heads_[0].state);
}

TEST(StaticDots, mask_what_stands_still_for_five_seconds) {
  StaticDots dots;
  for (int i = 0; i <= 49; ++i) dots.watch({300 + (i % 2), 200}, Time{} + milliseconds(100 * i));
  EXPECT_FALSE(dots.masked({300, 200}));
  for (int i = 50; i <= 52; ++i) dots.watch({300, 200}, Time{} + milliseconds(100 * i));
  EXPECT_TRUE(dots.masked({305, 203}));
  EXPECT_FALSE(dots.masked({312, 200}));
}

TEST(StaticDots, do_not_mask_what_moves_or_belongs_to_a_head) {
  StaticDots dots;
  for (int i = 0; i <= 100; ++i) {
    const Time time = Time{} + milliseconds(100 * i);
    dots.watch({100 + i, 500}, time);
    dots.watch({300, 200}, time);
    if (i % 20 == 0) dots.release({301, 200}, time);
  }
  EXPECT_TRUE(dots.masks_px().empty());
}

TEST(StaticDots, forget_a_mask_that_hid_nothing_for_ten_minutes_but_not_the_background) {
  StaticDots dots({}, {{700, 700}});
  for (int i = 0; i <= 60; ++i) dots.watch({300, 200}, Time{} + milliseconds(100 * i));
  dots.watch({10, 10}, Time{} + std::chrono::minutes(12));
  EXPECT_FALSE(dots.masked({300, 200}));
  EXPECT_TRUE(dots.masked({700, 700}));
}

TEST(DotSizes, know_what_is_far_larger_than_the_dots_of_heads_were_lately) {
  DotSizes sizes;
  EXPECT_FALSE(sizes.too_large({0, 0, 15}, Time{}));
  sizes.note({0, 0, 3}, Time{});
  sizes.note({0, 0, 1}, Time{} + milliseconds(10));
  EXPECT_FALSE(sizes.too_large({0, 0, 8}, Time{} + milliseconds(20)));
  EXPECT_TRUE(sizes.too_large({0, 0, 10}, Time{} + milliseconds(20)));
  EXPECT_FALSE(sizes.too_large({0, 0, 10}, Time{} + milliseconds(2020)));
}

TEST(DotSizes, let_a_head_grow_that_comes_nearer_and_shrink_as_it_goes) {
  DotSizes sizes;
  for (int size = 1; size <= 15; ++size) {
    const Time time = Time{} + milliseconds(100 * size);
    EXPECT_FALSE(sizes.too_large({0, 0, size}, time)) << size;
    sizes.note({0, 0, size}, time);
  }
  for (int i = 0; i < 300; ++i) sizes.note({0, 0, 1}, Time{} + milliseconds(2000 + 100 * i));
  EXPECT_TRUE(sizes.too_large({0, 0, 6}, Time{} + milliseconds(32000)));
}

TEST(DotSizes, are_areas_in_a_video_cameras_pictures) {
  DotSizes sizes(CameraSource::video);
  sizes.note({0, 0, 9}, Time{});
  EXPECT_FALSE(sizes.too_large({0, 0, 64}, Time{}));
  EXPECT_TRUE(sizes.too_large({0, 0, 100}, Time{}));
}

TEST(CameraWatch, names_a_camera_that_fits_nothing_for_a_second_and_takes_it_back) {
  CameraWatch watch;
  for (int i = 0; i < 20; ++i) watch.judge(false);
  EXPECT_FALSE(watch.moved());
  for (int i = 0; i < 20; ++i) watch.judge(false);
  EXPECT_TRUE(watch.moved());
  EXPECT_GT(watch.distrust(), 1);
  for (int i = 0; i < 40; ++i) watch.judge(true);
  EXPECT_FALSE(watch.moved());
}

TEST(CameraWatch, lets_a_camera_doubt_a_head_three_times_in_a_row) {
  CameraWatch watch;
  Association doubt{.accepted = {{}}, .widened = true}, fit{.accepted = {{}}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(watch.may_widen());
    watch.count(doubt);
  }
  EXPECT_FALSE(watch.may_widen());
  for (int i = 0; i < 40; ++i) watch.count(fit);
  EXPECT_TRUE(watch.may_widen());
}

}  // namespace
}  // namespace vindu
