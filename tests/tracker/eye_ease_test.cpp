// The shown eye when tracking comes and goes: it never jumps.
#include "tracker/eye_ease.h"

#include <gtest/gtest.h>

#include <utility>

namespace vindu {
namespace {

using std::chrono::milliseconds;

const Vec3 kDefault(0, 0.1, 2);
const Vec3 kViewer(0.8, 0.2, 1.5);
constexpr Duration kFrame = std::chrono::microseconds(16667);

// Feeds one eye (or none) for a while; the eye last shown. Every step is checked against a limit.
class Show {
 public:
  Vec3 run(const std::optional<Vec3>& tracked_eye_in_wall, Duration duration) {
    for (const Time end = now_ + duration; now_ < end; now_ += kFrame) {
      const Vec3 shown = ease_.update(tracked_eye_in_wall, now_);
      largest_step_m_ = std::max(largest_step_m_, (shown - shown_).norm());
      shown_ = shown;
    }
    return shown_;
  }
  double largest_step_m() const { return largest_step_m_; }

 private:
  EyeEase ease_{kDefault};
  Time now_{};
  Vec3 shown_ = kDefault;
  double largest_step_m_ = 0;
};

TEST(EyeEase, shows_the_default_eye_until_something_is_tracked) {
  EXPECT_EQ(Show().run(std::nullopt, std::chrono::seconds(10)), kDefault);
}

TEST(EyeEase, shows_the_tracked_eye_itself_once_it_has_caught_up) {
  EXPECT_EQ(Show().run(kViewer, std::chrono::seconds(3)), kViewer);
}

TEST(EyeEase, holds_for_two_seconds_then_eases_to_the_default) {
  Show show;
  show.run(kViewer, std::chrono::seconds(3));
  EXPECT_EQ(show.run(std::nullopt, milliseconds(1980)), kViewer);
  const Vec3 halfway = show.run(std::nullopt, milliseconds(770));
  EXPECT_LT((halfway - 0.5 * (kViewer + kDefault)).norm(), 0.05);
  EXPECT_LT((show.run(std::nullopt, milliseconds(1000)) - kDefault).norm(), 1e-12);
}

TEST(EyeEase, never_jumps) {
  Show show;
  show.run(kViewer, std::chrono::seconds(2));
  show.run(std::nullopt, std::chrono::seconds(3));  // on its way to the default
  show.run(Vec3(-1, 0, 1), milliseconds(200));      // found again elsewhere
  show.run(std::nullopt, std::chrono::seconds(6));
  show.run(kViewer, std::chrono::seconds(2));
  EXPECT_LT(show.largest_step_m(), 1.5 * seconds(kFrame) * 1.01);  // 1.5 m/s
  EXPECT_GT(show.largest_step_m(), 0);
}

TEST(EyeEase, is_over_a_short_gap_within_a_few_frames) {
  Show show;
  show.run(kViewer, std::chrono::seconds(2));
  show.run(std::nullopt, 2 * kFrame);
  const Vec3 moved = kViewer + Vec3(0.02, 0, 0);
  EXPECT_EQ(show.run(moved, 4 * kFrame), moved);
}

TEST(EyeEase, follows_a_correction_of_the_tracker_softly_and_to_its_end) {
  Show show;
  show.run(kViewer, std::chrono::seconds(3));
  const Vec3 corrected = kViewer + Vec3(0.1, 0, 0);
  show.run(corrected, kFrame);
  EXPECT_LT((show.run(corrected, kFrame) - kViewer).norm(), 0.02);
  EXPECT_EQ(show.run(corrected, std::chrono::seconds(1)), corrected);
}

TEST(EyeEase, catches_up_with_an_eye_that_runs_away_no_faster_than_heads_move) {
  EyeEase ease(kDefault);
  Time now{};
  Vec3 eye = kDefault + Vec3(0.3, 0, 0), shown = ease.update(eye, now);
  double largest_m_s = 0;
  for (int frame = 0; frame < 300; ++frame) {
    eye.x() += (frame < 120 ? 0.9 : 0.2) * seconds(kFrame);
    const Vec3 before = std::exchange(shown, ease.update(eye, now += kFrame));
    largest_m_s = std::max(largest_m_s, (shown - before).norm() / seconds(kFrame));
  }
  EXPECT_LT(largest_m_s, EyeEaseOptions{}.most_m_s * 1.01);
  EXPECT_EQ(shown, eye);
}

TEST(EyeEase, does_not_lag_behind_a_head_that_sets_off) {
  EyeEase ease(kDefault);
  Time now{};
  double worst_m = 0;
  for (int i = 0; i < 600; ++i, now += kFrame) {
    const double t = seconds(now.time_since_epoch());
    const double moved_s = std::max(0.0, t - 5);
    const double way_m = moved_s < 0.4 ? moved_s * moved_s : 0.8 * (moved_s - 0.2);  // to 0.8 m/s
    const Vec3 eye = kDefault + Vec3(way_m, 0, 0);
    const Vec3 shown = ease.update(eye, now);
    if (i > 0) worst_m = std::max(worst_m, (shown - eye).norm());
  }
  EXPECT_LT(worst_m, 1e-9);
}

}  // namespace
}  // namespace vindu
