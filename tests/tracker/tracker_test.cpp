// The tracker as the application sees it: tracked, held, lost, and the account of it.
#include "tracker/tracker.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class TrackerTest : public ::testing::Test {
 protected:
  TrackerTest() : cameras_(2) {
    cameras_[0].room_from_camera = look_at({-1, 2.3, 5}, {0, 1.65, 2});
    cameras_[1].room_from_camera = look_at({1, 2.3, 5}, {0, 1.65, 2});
  }

  void see_head(Tracker& tracker, Time arrival) {
    for (int camera = 0; camera < 2; ++camera) {
      const CameraModel model(cameras_[static_cast<std::size_t>(camera)]);
      Observation seen{camera, arrival, {}};
      for (const Vec3& led : heads_.front().leds_in_head) {
        const auto raw_px = model.project(model.camera_from_room() * (room_from_head_ * led));
        seen.dots.push_back({raw_px->x(), raw_px->y(), 3});
      }
      tracker.absorb(seen);
    }
  }

  static std::optional<PoseSample> track(Tracker& tracker, Time now) {
    return tracker.track(now, now);
  }

  std::vector<CameraConfig> cameras_;
  std::vector<HeadConfig> heads_ = std::vector<HeadConfig>(1);
  Rigid3 room_from_wall_ = room_from_wall_at(1.55, 0);
  Rigid3 room_from_head_{Quat::Identity(), {0.1, 1.75, 2.2}};
};

TEST_F(TrackerTest, has_no_pose_before_it_has_found_a_head) {
  Tracker tracker(cameras_, heads_, room_from_wall_, {.method = "thesis"});
  EXPECT_FALSE(track(tracker, Time{}));
  EXPECT_EQ(tracker.counts().frames_lost(), 1u);
}

TEST_F(TrackerTest, finds_head_and_eye) {
  Tracker tracker(cameras_, heads_, room_from_wall_, {.method = "thesis"});
  see_head(tracker, Time{});
  const auto pose = track(tracker, Time{} + milliseconds(5));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->level, TrackingLevel::six_dof);
  EXPECT_EQ(tracker.points().size(), 3u);
  // Head at (0.1, 1.75, 2.2) in room, eye 0.10 below and 0.19 ahead, the wall's centre 1.55 high.
  EXPECT_LT((tracker.eye_in_wall(*pose) - Vec3(0.1, 0.10, 2.01)).norm(), 1e-6);
}

TEST_F(TrackerTest, holds_the_last_pose_for_two_seconds_and_then_calls_it_lost) {
  Tracker tracker(cameras_, heads_, room_from_wall_, {.method = "thesis"});
  see_head(tracker, Time{});
  const auto found = track(tracker, Time{});
  const auto held = track(tracker, Time{} + seconds(2));
  const auto lost = track(tracker, Time{} + seconds(2) + milliseconds(1));
  ASSERT_TRUE(found && held && lost);
  EXPECT_EQ(held->level, TrackingLevel::held);
  EXPECT_EQ(held->capture_time, found->capture_time);
  EXPECT_EQ(held->room_from_head.translation, found->room_from_head.translation);
  EXPECT_EQ(lost->level, TrackingLevel::lost);
}

TEST_F(TrackerTest, counts_reports_frames_and_losses_by_reason) {
  Tracker tracker(cameras_, heads_, room_from_wall_, {.method = "thesis"});
  see_head(tracker, Time{});
  track(tracker, Time{});
  tracker.absorb({1, Time{} + milliseconds(10), {}});  // the right camera sees nothing any more
  track(tracker, Time{} + milliseconds(10));
  const TrackerCounts& counts = tracker.counts();
  EXPECT_EQ(counts.reports, 3u);
  EXPECT_EQ(counts.frames_tracked(), 1u);
  EXPECT_EQ(counts.frames_lost(), 1u);
  EXPECT_EQ(counts.frames_lost_by_reason[static_cast<std::size_t>(NoPose::too_few_dots)], 1u);
}

TEST_F(TrackerTest, knows_which_cameras_report_though_they_see_no_dots) {
  Tracker tracker(cameras_, heads_, room_from_wall_);
  tracker.absorb({.camera = 1, .arrival = Time{} + milliseconds(10), .dots = {}});
  EXPECT_EQ(tracker.heard(Time{} + milliseconds(20)), (std::vector{false, true}));
  EXPECT_EQ(tracker.heard(Time{} + milliseconds(1010)), (std::vector{false, false}));
}

TEST_F(TrackerTest, tracks_by_the_way_of_the_thesis_that_the_mode_names) {
  const auto level_in_mode = [&](const std::string& mode) {
    Tracker tracker(cameras_, heads_, room_from_wall_, {.method = "thesis", .mode = mode});
    see_head(tracker, Time{});
    return track(tracker, Time{})->level;
  };
  EXPECT_EQ(level_in_mode("auto"), TrackingLevel::six_dof);
  EXPECT_EQ(level_in_mode("six-dof"), TrackingLevel::six_dof);
  EXPECT_EQ(level_in_mode("hybrid"), TrackingLevel::six_dof);
  EXPECT_EQ(level_in_mode("position"), TrackingLevel::position);
}

TEST_F(TrackerTest, refuses_a_method_it_does_not_know) {
  EXPECT_THROW(Tracker(cameras_, heads_, room_from_wall_, {.method = "magic"}), Error);
}

/// Two helmets side by side, the second nearer to the wall; both cameras report 10 ms apart.
class TwoHeads : public TrackerTest {
 protected:
  TwoHeads() {
    heads_.resize(2);
    heads_[1].name = "guest";
    heads_[1].leds_in_head = {
        {-0.10, 0, -0.09}, {0, 0.06, 0}, {0.10, -0.02, -0.09}, {0.03, -0.06, -0.02}};
  }

  std::optional<PoseSample> see_both(Tracker& tracker, int frames, std::uint16_t buttons = 0,
                                     std::size_t heads = 2) {
    const Rigid3 places[] = {{Quat::Identity(), {0.4, 1.65, 2.2}},
                             {Quat::Identity(), {-0.3, 1.65, 1.6}}};
    std::optional<PoseSample> followed;
    for (int i = 0; i < frames; ++i, now_ += milliseconds(10)) {
      for (int camera = 0; camera < 2; ++camera) {
        const CameraModel model(cameras_[static_cast<std::size_t>(camera)]);
        Observation seen{camera, now_, {}, camera == 0 ? buttons : std::uint16_t{0}};
        for (std::size_t head = 0; head < heads; ++head)
          for (const Vec3& led : heads_[head].leds_in_head) {
            const auto raw_px = model.project(model.camera_from_room() * (places[head] * led));
            seen.dots.push_back({raw_px->x(), raw_px->y(), 3});
          }
        tracker.absorb(seen);
      }
      followed = tracker.track(now_, now_);
    }
    return followed;
  }

  Time now_{};
};

TEST_F(TwoHeads, are_both_known_and_the_nearer_to_the_wall_is_followed) {
  Tracker tracker(cameras_, heads_, room_from_wall_);
  const auto followed = see_both(tracker, 50);
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->object, 1);
  EXPECT_EQ(tracker.poses().size(), 2u);
}

TEST_F(TwoHeads, are_followed_by_name_or_the_first_alone) {
  Tracker by_name(cameras_, heads_, room_from_wall_, {.follow = "head"});
  EXPECT_EQ(see_both(by_name, 50)->object, 0);
  Tracker first(cameras_, heads_, room_from_wall_, {.follow = "first"});
  see_both(first, 50, 0, 1);
  EXPECT_EQ(see_both(first, 50)->object, 0);
}

TEST_F(TwoHeads, are_handed_over_by_each_press_of_home) {
  constexpr std::uint16_t kHome = 0x0080;
  Tracker tracker(cameras_, heads_, room_from_wall_);
  ASSERT_EQ(see_both(tracker, 50)->object, 1);
  EXPECT_EQ(see_both(tracker, 5, kHome)->object, 0);  // held down: once
  EXPECT_EQ(see_both(tracker, 20)->object, 0);
  EXPECT_EQ(see_both(tracker, 5, kHome)->object, 1);
}

TEST_F(TwoHeads, leave_the_buttons_that_were_pressed_and_let_go_in_the_frame_that_follows) {
  constexpr std::uint16_t kA = 0x0008, kUp = 0x0800;
  Tracker tracker(cameras_, heads_, room_from_wall_);
  see_both(tracker, 1, kA);
  ASSERT_EQ(tracker.button_changes().size(), 1u);
  EXPECT_EQ(tracker.button_changes()[0].camera, 0);
  EXPECT_EQ(tracker.button_changes()[0].button, kA);
  EXPECT_TRUE(tracker.button_changes()[0].pressed);
  see_both(tracker, 1, kA);
  EXPECT_TRUE(tracker.button_changes().empty());
  see_both(tracker, 1, kUp);
  ASSERT_EQ(tracker.button_changes().size(), 2u);
  EXPECT_FALSE(tracker.button_changes()[0].pressed);
  EXPECT_EQ(tracker.button_changes()[1].button, kUp);
}

TEST_F(TrackerTest, in_a_mode_that_asks_for_more_holds_what_is_less) {
  heads_.front().leds_in_head = {{-0.09, 0, 0}, {0.09, 0, 0}};  // never more than hybrid
  Tracker any(cameras_, heads_, room_from_wall_),
      whole(cameras_, heads_, room_from_wall_, {.mode = "six-dof"});
  std::optional<PoseSample> pose_of_any, pose_of_whole;
  for (int i = 0; i < 40; ++i) {
    const Time now{milliseconds(10 * i)};
    see_head(any, now);
    see_head(whole, now);
    pose_of_any = track(any, now);
    pose_of_whole = track(whole, now);
  }
  ASSERT_TRUE(pose_of_any && pose_of_whole);
  EXPECT_EQ(pose_of_any->level, TrackingLevel::hybrid);
  EXPECT_EQ(pose_of_whole->level, TrackingLevel::held);
}

}  // namespace
}  // namespace vindu
