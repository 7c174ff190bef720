// The eye of who stands still: it rests, and nobody can tell by more than half a pixel.
#include "tracker/eye_rest.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/frustum.h"
#include "core/random.h"

namespace vindu {
namespace {

constexpr double kSlack_m = 0.0003;
constexpr double kTick_s = 1.0 / 60;
const Vec3 kEye(0.2, 0.1, 1.8);

/// Feeds an eye that is a function of time; keeps what it showed.
class Play {
 public:
  template <class Eye>
  void run(double length_s, Eye eye_at, double sigma_m = 0) {
    for (const double end_s = now_s_ + length_s; now_s_ < end_s; now_s_ += kTick_s) {
      const Vec3 eye = eye_at(now_s_);
      const Vec3 before = shown;
      shown = rest.update(eye, kSlack_m, sigma_m, Time(from_seconds(now_s_)));
      largest_error_m = std::max(largest_error_m, (shown - eye).norm());
      if (ticks++ > 0) {
        changes += shown != before;
        largest_step_m = std::max(largest_step_m, (shown - before).norm());
      }
    }
  }

  EyeRest rest;
  Vec3 shown = Vec3::Zero();
  int ticks = 0, changes = 0;
  double largest_error_m = 0, largest_step_m = 0;

 private:
  double now_s_ = 0;
};

TEST(EyeRest, ShowsAFixedEyeAsItIs) {
  Play play;
  play.run(5, [](double) { return kEye; });
  EXPECT_EQ(play.changes, 0);
  EXPECT_EQ(play.shown, kEye);
  EXPECT_TRUE(play.rest.resting());
}

TEST(EyeRest, DoesNotChangeAtAllWhileTheEyeStaysWithinItsSlack) {
  Play play;
  const auto tremble = [](double t_s) -> Vec3 {
    return kEye + 0.3 * kSlack_m * Vec3(std::sin(20 * t_s), std::cos(31 * t_s), 0);
  };
  play.run(2, tremble);
  play.changes = 0;
  play.run(20, tremble);
  EXPECT_EQ(play.changes, 0);
}

TEST(EyeRest, FollowsAnEyeThatMovesAsIfItWereNotThere) {
  Play play;
  const auto walk = [](double t_s) -> Vec3 { return kEye + Vec3(0.5 * std::sin(t_s), 0, 0); };
  play.run(20, walk);
  EXPECT_FALSE(play.rest.resting());
  EXPECT_LE(play.largest_error_m, kSlack_m);
}

TEST(EyeRest, IsNeverFartherOffThanTheSlackHoweverTheEyeMovesAndStops) {
  Random random(4);
  Play play;
  Vec3 from = kEye;
  int rested = 0;
  for (int leg = 0; leg < 300; ++leg) {
    const double speed_m_s = std::pow(10, random.uniform(-5, 0));
    const Vec3 velocity = speed_m_s * Vec3(random.normal(1), random.normal(1), random.normal(1));
    std::optional<double> start_s;
    Vec3 last = from;
    play.run(random.uniform(0.02, 2), [&](double t_s) -> Vec3 {
      if (!start_s) start_s = t_s - kTick_s;
      return last = from + (t_s - *start_s) * velocity;
    });
    from = last;
    rested += play.rest.resting();
  }
  EXPECT_LE(play.largest_error_m, kSlack_m * (1 + 1e-9));
  EXPECT_GT(rested, 30);
  EXPECT_LT(rested, 270);
}

TEST(EyeRest, LetsNobodySeeThatItBeginsOrEnds) {
  Play play;
  const auto creep = [](double t_s) -> Vec3 {
    return kEye + Vec3(t_s < 3 ? 0 : 0.01 * (t_s - 3), 0, 0);
  };
  play.run(6, creep);
  EXPECT_LE(play.largest_step_m, 3 * 0.01 * kTick_s);
}

// A helmet on a stand, as a tracker sees it whose noise is several pixels.
TEST(EyeRest, HoldsTheMeanOfATrackedEyeThatTrembles) {
  Random random(8);
  Play play;
  const double sigma_m = 3 * kSlack_m;
  Vec3 noise = Vec3::Zero();
  const auto tracked = [&](double) -> Vec3 {
    noise =
        0.8 * noise + 0.6 * sigma_m * Vec3(random.normal(1), random.normal(1), random.normal(1));
    return kEye + noise;
  };
  play.run(5, tracked, sigma_m);
  play.changes = play.ticks = 0;
  play.run(60, tracked, sigma_m);
  EXPECT_LT(play.changes, play.ticks / 2);
  EXPECT_LE(play.largest_error_m, 4 * sigma_m * (1 + 1e-9));
  EXPECT_LT((play.shown - kEye).norm(), 2 * sigma_m);
}

TEST(EyeRest, FollowsATrackedEyeThatDriftsThoughItTrembles) {
  Random random(8);
  Play play;
  const double sigma_m = 3 * kSlack_m;
  double worst_m = 0;
  play.run(
      60,
      [&](double t_s) -> Vec3 {
        const Vec3 eye = kEye + Vec3(1e-4 * t_s, 0, 0);
        if (t_s > 3) worst_m = std::max(worst_m, std::abs(play.shown.x() - eye.x()));
        return eye + sigma_m * Vec3(random.normal(1), random.normal(1), random.normal(1));
      },
      sigma_m);
  EXPECT_LT(worst_m, 4 * sigma_m);
}

Wall tromso() {
  WallGrid grid;
  grid.columns = 7;
  grid.rows = 4;
  grid.width_m = 5.185;
  grid.height_m = 2.238;
  grid.tile_width_px = 1024;
  grid.tile_height_px = 768;
  return expand_wall(grid, {}, {});
}

/// Where the ray from the eye to a point meets the wall's plane.
Vec2 seen_at(const Vec3& eye, const Vec3& point) {
  const double share = eye.z() / (eye.z() - point.z());
  return (eye + share * (point - eye)).head<2>();
}

TEST(EyeSlack, DisplacesNothingOnTheWallByMoreThanHalfAPixel) {
  const Wall wall = tromso();
  const double pixel_m = wall.pixel_pitch_m();
  Random random(2);
  double largest_px = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 eye(random.uniform(-2.5, 2.5), random.uniform(-1, 1), random.uniform(0.4, 4));
    const std::vector<Vec3> front = {{0, 0, random.uniform(-1, 0.9 * eye.z())}};
    const double slack_m = eye_slack_m(wall, eye, front);
    const Vec3 off =
        slack_m * Vec3(random.normal(1), random.normal(1), random.normal(1)).normalized();
    const Vec2 at(random.uniform(-2.59, 2.59), random.uniform(-1.11, 1.11));  // on the wall
    const Vec3 ray = Vec3(at.x(), at.y(), 0) - eye;
    const double z_m = random.uniform(0, 1) < 0.5 ? -std::pow(10, random.uniform(-2, 4))
                                                  : front[0].z() * random.uniform(0, 1);
    const Vec3 point = eye + (eye.z() - z_m) / eye.z() * ray;
    const double moved_m = (seen_at(Vec3(eye + off), point) - at).norm();
    largest_px = std::max(largest_px, moved_m / pixel_m);
  }
  EXPECT_LE(largest_px, 0.505);  // of the first order
  EXPECT_GE(largest_px, 0.3);    // and not by far less
}

TEST(EyeSlack, IsNothingBesideWhatReachesTheEye) {
  const std::vector<Vec3> front = {{0, 0, 2}};
  EXPECT_LT(eye_slack_m(tromso(), Vec3(0, 0, 2), front), 1e-9);
}

TEST(EyeSigma, CountsTheHeadsTurningByTheEyesLever) {
  PoseSample pose;
  EXPECT_EQ(eye_sigma_m(pose, Vec3(0, 0, -0.2)), 0);
  pose.covariance.topLeftCorner<3, 3>() = 1e-6 * Mat3::Identity();
  EXPECT_NEAR(eye_sigma_m(pose, Vec3(0, 0, -0.2)), 1e-3, 1e-12);
  pose.covariance.setZero();
  pose.covariance(4, 4) = 1e-4;  // about y: the eye goes to and fro in x
  EXPECT_NEAR(eye_sigma_m(pose, Vec3(0, 0, -0.2)), 0.01 * 0.2 / std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace vindu
