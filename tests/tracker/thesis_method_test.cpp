// The thesis' frame and its 6 DoF tracking from dots without noise and without rounding, and which
// of its ways of tracking is taken. Hybrid tracking has its own file.
#include "tracker/thesis_method.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "tests/tracker/thesis_views.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

std::vector<CameraConfig> two_cameras() { return cameras_aside(18.4); }

ThesisResult result_for(const HeadConfig& head, const Rigid3& room_from_head,
                        ThesisMode mode = ThesisMode::automatic) {
  const auto cameras = two_cameras();
  ThesisMethod method(cameras, head, {.mode = mode});
  const Time now{std::chrono::seconds(1)};
  method.absorb(perfect_view(cameras, 0, head, room_from_head, now));
  method.absorb(perfect_view(cameras, 1, head, room_from_head, now, {1, 2, 0}));
  return method.track(now);
}

TEST(LmrFrame, of_the_standing_helmet_is_the_identity) {
  const HeadConfig head;
  const auto frame = lmr_frame(head.leds_in_head[0], head.leds_in_head[1], head.leds_in_head[2]);
  ASSERT_TRUE(frame);
  EXPECT_LT((matrix_of(*frame) - Mat4::Identity()).norm(), 1e-12);
}

TEST(LmrFrame, has_the_columns_r_u_and_minus_f_with_determinant_plus_one) {
  std::mt19937 engine(3);
  std::normal_distribution<double> anywhere;
  const auto point = [&] { return Vec3(anywhere(engine), anywhere(engine), anywhere(engine)); };
  for (int i = 0; i < 100; ++i) {
    const Vec3 left = point(), middle = point(), right = point();
    const Vec3 r = (right - left).normalized();
    const Vec3 f = (left + r.dot(middle - left) * r - middle).normalized();
    Mat3 expected;
    expected << r, r.cross(f), -f;
    const auto frame = lmr_frame(left, middle, right);
    ASSERT_TRUE(frame);
    EXPECT_NEAR(expected.determinant(), 1, 1e-12);
    EXPECT_LT((frame->rotation.toRotationMatrix() - expected).norm(), 1e-12);
    EXPECT_EQ(frame->translation, middle);
  }
}

TEST(LmrFrame, places_the_tracking_offset_where_thesis_equation_3_1_does) {
  const Vec3 left(-0.3, 1.2, 2.0), middle(0.1, 1.3, 2.4), right(0.4, 1.1, 1.9);
  const Vec3 thesis_offset(0.19, 0.03, 0.10);  // (e_f, e_r, e_u)
  // Thesis 3.2.2, written out: columns f, r, u = f x r, then m.
  const Vec3 r = (right - left).normalized();
  const Vec3 f = (left + r.dot(middle - left) * r - middle).normalized();
  const Vec3 u = f.cross(r);
  const Vec3 expected =
      f * thesis_offset.x() + r * thesis_offset.y() + u * thesis_offset.z() + middle;

  const Vec3 placed = *lmr_frame(left, middle, right) * head_offset_from_thesis(thesis_offset);

  EXPECT_LT((placed - expected).norm(), 1e-12);
}

TEST(LmrFrame, needs_three_points_that_are_not_on_one_line) {
  EXPECT_FALSE(lmr_frame({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  EXPECT_FALSE(lmr_frame({0, 0, 0}, {1, 0, 0}, {0, 0, 0}));
}

TEST(ThesisMethod, recovers_the_exact_pose_from_exact_dots) {
  const HeadConfig head;
  for (const double yaw_deg : {-20, -10, 0, 10, 20})
    for (const double roll_deg : {-10, 0, 10}) {
      const Rigid3 room_from_head{turned(yaw_deg, 5, roll_deg), {0.05, 1.75, 2.1}};
      const ThesisResult result = result_for(head, room_from_head);
      ASSERT_TRUE(result.pose) << yaw_deg << ' ' << roll_deg;
      const Vec3 eye_error_m =
          result.pose->room_from_head * head.eye_in_head - room_from_head * head.eye_in_head;
      EXPECT_LT(eye_error_m.norm(), 1e-6);
      EXPECT_LT(result.pose->room_from_head.rotation.angularDistance(room_from_head.rotation),
                1e-6);
      ASSERT_EQ(result.points.size(), 3u);
      for (const auto& point : result.points) EXPECT_LT(point.gap_m, 1e-7);
    }
}

TEST(ThesisMethod, knows_the_head_frame_of_a_helmet_that_is_not_the_standard_one) {
  HeadConfig head;
  head.leds_in_head = {{-0.11, 0.02, -0.08}, {0.01, 0.05, 0.02}, {0.08, -0.01, -0.10}};
  const Rigid3 room_from_head{turned(10, -5, 4), {-0.3, 1.7, 1.8}};
  const ThesisResult result = result_for(head, room_from_head);
  ASSERT_TRUE(result.pose);
  EXPECT_LT((result.pose->room_from_head.translation - room_from_head.translation).norm(), 1e-6);
}

TEST(ThesisMethod, names_the_newest_report_used_as_capture_time) {
  const auto cameras = two_cameras();
  const HeadConfig head;
  const Rigid3 room_from_head{Quat::Identity(), {0, 1.75, 2.2}};
  ThesisMethod method(cameras, head);
  const Time start{std::chrono::seconds(1)};
  method.absorb(perfect_view(cameras, 0, head, room_from_head, start + milliseconds(4)));
  method.absorb(perfect_view(cameras, 1, head, room_from_head, start));
  const auto result = method.track(start + milliseconds(10));
  ASSERT_TRUE(result.pose);
  EXPECT_EQ(result.pose->capture_time, start + milliseconds(4));
  EXPECT_EQ(result.pose->level, TrackingLevel::six_dof);
}

TEST(ThesisMethod, says_why_there_is_no_pose) {
  const auto cameras = two_cameras();
  const HeadConfig head;
  const Rigid3 room_from_head{Quat::Identity(), {0, 1.75, 2.2}};
  const Time now{std::chrono::seconds(1)};
  const auto reason = [&](const std::vector<std::size_t>& first,
                          const std::vector<std::size_t>& second,
                          ThesisMode mode = ThesisMode::six_dof) {
    ThesisMethod method(cameras, head, {.mode = mode});
    method.absorb(perfect_view(cameras, 0, head, room_from_head, now, first));
    method.absorb(perfect_view(cameras, 1, head, room_from_head, now, second));
    const ThesisResult result = method.track(now);
    EXPECT_FALSE(result.pose);
    return result.reason;
  };
  EXPECT_EQ(reason({0, 1}, {0, 1, 2}), NoPose::too_few_dots);
  EXPECT_EQ(reason({}, {}), NoPose::too_few_dots);
  EXPECT_EQ(reason({0, 1, 2}, {0, 1, 2, 1}), NoPose::unequal_counts);
  EXPECT_EQ(reason({0, 1, 2, 1}, {0, 1, 2, 1}), NoPose::too_many_dots);
  EXPECT_EQ(reason({1, 1, 1}, {1, 1, 1}), NoPose::degenerate);
  EXPECT_EQ(reason({0, 1, 2}, {}, ThesisMode::position), NoPose::too_few_dots);
  EXPECT_EQ(reason({0, 1}, {}, ThesisMode::automatic), NoPose::too_few_dots);
}

TEST(ThesisMethod, finds_no_pose_where_the_rays_run_apart) {
  const auto cameras = two_cameras();
  ThesisMethod method(cameras, HeadConfig{});
  // The left camera's left edge and the right camera's right edge look away from each other.
  Observation left{0, Time{}, {}}, right{1, Time{}, {}};
  for (const double offset_px : {0.0, 20.0, 40.0}) {
    left.dots.push_back({offset_px, 384, 3});
    right.dots.push_back({983 + offset_px, 384, 3});
  }
  method.absorb(left);
  method.absorb(right);
  const ThesisResult result = method.track(Time{});
  EXPECT_FALSE(result.pose);
  EXPECT_EQ(result.reason, NoPose::rays_do_not_meet);
}

TEST(ThesisMethod, refuses_a_head_turned_so_far_that_one_camera_sees_the_leds_in_another_order) {
  // 54 degrees off the right camera.
  const ThesisResult result =
      result_for(HeadConfig{}, {turned(-35, 0, 0), {0, 1.75, 2.1}}, ThesisMode::six_dof);
  EXPECT_FALSE(result.pose);
  EXPECT_EQ(result.reason, NoPose::rays_do_not_meet);
}

TEST(ThesisMethod, takes_a_camera_silent_for_over_100_ms_as_blind) {
  const auto cameras = two_cameras();
  const HeadConfig head;
  const Rigid3 room_from_head{Quat::Identity(), {0, 1.75, 2.2}};
  ThesisMethod method(cameras, head);
  method.absorb(perfect_view(cameras, 0, head, room_from_head, Time{}));
  method.absorb(perfect_view(cameras, 1, head, room_from_head, Time{} + milliseconds(50)));
  EXPECT_TRUE(method.track(Time{} + milliseconds(100)).pose);
  const ThesisResult later = method.track(Time{} + milliseconds(101));
  EXPECT_FALSE(later.pose);
  EXPECT_EQ(later.reason, NoPose::too_few_dots);
}

/// A head that both cameras see whole at first, and less of afterwards.
class Sighted {
 public:
  explicit Sighted(ThesisMode mode, const HeadConfig& head = {})
      : head_(head), method_(cameras_, head, {.mode = mode}) {}

  ThesisResult see(const Rigid3& room_from_head, const std::vector<std::size_t>& first,
                   const std::vector<std::size_t>& second) {
    now_ += milliseconds(17);
    method_.absorb(perfect_view(cameras_, 0, head_, room_from_head, now_, first));
    method_.absorb(perfect_view(cameras_, 1, head_, room_from_head, now_, second));
    return method_.track(now_);
  }
  void wait(Duration duration) { now_ += duration; }

 private:
  std::vector<CameraConfig> cameras_ = two_cameras();
  HeadConfig head_;
  ThesisMethod method_;
  Time now_{};
};

const std::vector<std::size_t> kAll = {0, 1, 2};
const Rigid3 kTurnedHead{turned(15, 5, -3), {0.05, 1.75, 2.1}};

TEST(ThesisMethod, with_one_led_in_common_knows_the_position_and_keeps_the_last_rotation) {
  for (const std::size_t led : kAll) {
    Sighted head(ThesisMode::automatic);
    ASSERT_EQ(head.see(kTurnedHead, kAll, kAll).pose->level, TrackingLevel::six_dof);
    const Rigid3 moved{kTurnedHead.rotation, kTurnedHead.translation + Vec3(0.02, -0.01, 0.01)};
    const ThesisResult result = head.see(moved, {led}, {led});
    ASSERT_TRUE(result.pose);
    EXPECT_EQ(result.pose->level, TrackingLevel::position);
    EXPECT_LT((result.pose->room_from_head.translation - moved.translation).norm(), 1e-6);
    EXPECT_LT(result.pose->room_from_head.rotation.angularDistance(moved.rotation), 1e-6);
    EXPECT_EQ(result.points.size(), 1u);
  }
}

TEST(ThesisMethod, knows_the_position_where_one_camera_sees_the_leds_in_another_order) {
  Sighted head(ThesisMode::automatic);
  const Vec3 place(0, 1.75, 2.1);
  for (double yaw_deg = 0; yaw_deg > -36; yaw_deg -= 5) {
    const ThesisResult result = head.see({turned(yaw_deg, 0, 0), place}, kAll, kAll);
    ASSERT_TRUE(result.pose) << yaw_deg;
    EXPECT_EQ(result.pose->level, yaw_deg > -27 ? TrackingLevel::six_dof : TrackingLevel::position);
    EXPECT_LT((result.pose->room_from_head.translation - place).norm(), 0.04);
  }
}

TEST(ThesisMethod, takes_a_lone_point_of_a_head_it_has_not_seen_before_for_the_rear_led) {
  Sighted head(ThesisMode::automatic);
  const ThesisResult result = head.see(kTurnedHead, {1}, {1});
  ASSERT_TRUE(result.pose);
  EXPECT_EQ(result.pose->level, TrackingLevel::position);
  EXPECT_LT((result.pose->room_from_head.translation - kTurnedHead.translation).norm(), 1e-6);
  EXPECT_EQ(result.pose->room_from_head.rotation.angularDistance(Quat::Identity()), 0);
}

TEST(ThesisMethod, tells_by_its_rank_which_led_a_camera_that_sees_all_has_in_common) {
  // Tilted: the rays to LEDs of one height meet where there is none.
  const Rigid3 tilted{turned(0, 0, 6), kTurnedHead.translation};
  for (const std::size_t led : kAll) {
    Sighted head(ThesisMode::automatic);
    const ThesisResult result = head.see(tilted, kAll, {led});
    ASSERT_TRUE(result.pose);
    EXPECT_LT((result.pose->room_from_head.translation - tilted.translation).norm(), 0.02) << led;
  }
}

TEST(ThesisMethod, does_not_believe_that_a_head_leaps) {
  Sighted head(ThesisMode::automatic);
  head.see(kTurnedHead, kAll, kAll);
  const Rigid3 elsewhere{kTurnedHead.rotation, kTurnedHead.translation + Vec3(0.4, 0, 0)};
  EXPECT_FALSE(head.see(elsewhere, {1}, {1}).pose);
  head.wait(milliseconds(300));  // after which it may be anywhere
  EXPECT_TRUE(head.see(elsewhere, {1}, {1}).pose);
}

TEST(ThesisMethod, forced_to_position_never_measures_the_rotation) {
  Sighted head(ThesisMode::position);
  for (const auto& seen : {kAll, {1}, kAll}) {
    const ThesisResult result = head.see(kTurnedHead, seen, seen);
    ASSERT_TRUE(result.pose);
    EXPECT_EQ(result.pose->level, TrackingLevel::position);
    EXPECT_EQ(result.pose->room_from_head.rotation.angularDistance(Quat::Identity()), 0);
    EXPECT_LT((result.pose->room_from_head.translation - kTurnedHead.translation).norm(), 0.04);
  }
}

TEST(ThesisMethod, forced_to_position_is_content_with_one_led) {
  HeadConfig single;
  single.leds_in_head = {{0, 0.05, 0.01}};
  Sighted head(ThesisMode::position, single);
  const Rigid3 facing{Quat::Identity(), kTurnedHead.translation};
  const ThesisResult result = head.see(facing, {0}, {0});
  ASSERT_TRUE(result.pose);
  EXPECT_LT((result.pose->room_from_head.translation - facing.translation).norm(), 1e-6);
}

TEST(ThesisMethod, forced_to_a_better_way_has_no_pose_where_that_fails) {
  using Level = TrackingLevel;
  const auto level = [](ThesisMode mode, const std::vector<std::size_t>& first,
                        const std::vector<std::size_t>& second) {
    const ThesisResult result = Sighted(mode).see(kTurnedHead, first, second);
    return result.pose ? result.pose->level : Level::lost;
  };
  EXPECT_EQ(level(ThesisMode::six_dof, kAll, kAll), Level::six_dof);
  EXPECT_EQ(level(ThesisMode::six_dof, {0, 1}, {1, 2}), Level::lost);
  EXPECT_EQ(level(ThesisMode::hybrid, kAll, kAll), Level::six_dof);
  EXPECT_EQ(level(ThesisMode::hybrid, {0, 1}, {1, 2}), Level::hybrid);
  EXPECT_EQ(level(ThesisMode::hybrid, kAll, {1}), Level::lost);  // each must see two (A.7)
  EXPECT_EQ(level(ThesisMode::automatic, kAll, {1}), Level::position);
}

TEST(ThesisMethod, refuses_what_it_cannot_work_with) {
  const auto cameras = two_cameras();
  HeadConfig four, straight;
  four.leds_in_head.emplace_back(0, 0.1, 0);
  straight.leds_in_head = {{-0.1, 0, 0}, {0, 0, 0}, {0.1, 0, 0}};
  EXPECT_THROW(ThesisMethod(cameras, four), Error);
  EXPECT_THROW(ThesisMethod(cameras, straight), Error);
  EXPECT_THROW(ThesisMethod(cameras, straight, {.mode = ThesisMode::hybrid}), Error);
  EXPECT_NO_THROW(ThesisMethod(cameras, straight, {.mode = ThesisMode::position}));
  EXPECT_THROW(ThesisMethod(std::span(cameras).first(1), HeadConfig{}), Error);
}

}  // namespace
}  // namespace vindu
