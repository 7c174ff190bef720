// The tracker as the application sees it: tracked, held, lost, and the account of it.
#include "tracker/tracker.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class TrackerTest : public testing::Test {
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

TEST_F(TrackerTest, refuses_a_method_it_does_not_know) {
  EXPECT_THROW(Tracker(cameras_, heads_, room_from_wall_, {.method = "magic"}), Error);
}

}  // namespace
}  // namespace vindu
