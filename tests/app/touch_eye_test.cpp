// The eye of the mode touch, as hands on the bus move it.
#include "app/touch_eye.h"

#include <gmock/gmock.h>

#include "cluster/in_process.h"
#include "tests/core/random_walls.h"

namespace vindu::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// The thesis' wall.
Site site_with(double curve_deg = 0) {
  Site site;
  WallGrid grid = testing::tromso_grid();
  grid.curve_deg = curve_deg;
  site.wall = expand_wall(grid, {}, room_from_wall_at(kDefaultCentreHeight_m, 0));
  site.touch.eye_distance_m = 1.5;
  return site;
}

class TouchEyeTest : public ::testing::Test {
 protected:
  explicit TouchEyeTest(Site site = site_with()) : site_(std::move(site)) {}

  void touch(int id, EventPhase phase, double x_px, double y_px) {
    device_->publish(EventMessage{.source = "frame",
                                  .kind = EventKind::touch,
                                  .phase = phase,
                                  .id = id,
                                  .x_px = x_px,
                                  .y_px = y_px});
  }
  /// Long enough for the eye to have come to rest, frame by frame.
  Vec3 eye_at_rest() {
    Vec3 eye = Vec3::Zero();
    for (int frame = 0; frame < 120; ++frame) {
      now_ += milliseconds(16);
      eye = eye_.at(now_, now_).eye_in_wall;
    }
    return eye;
  }

  Site site_;
  InProcessTransport transport_;
  std::unique_ptr<Bus> device_ = transport_.join(
      {{.role = Role::console, .name = "frame", .host = "a", .version = "1"}, {Topic::event}, {}});
  std::unique_ptr<Bus> bus_ = transport_.join(
      {{.role = Role::master, .name = "master", .host = "a", .version = "1"}, {}, {Topic::event}});
  TouchEye eye_{*bus_, site_};
  Time now_{seconds(1000)};
};

TEST_F(TouchEyeTest, IsAtTheDefaultViewpointBeforeAnybodyTouches) {
  EXPECT_TRUE(eye_at_rest().isApprox(site_.viewer.default_eye_in_wall, 1e-9));
}

TEST_F(TouchEyeTest, StandsBeforeTheTouchedPointAtTheDistanceOfTheFile) {
  touch(1, EventPhase::begin, 0, 0);  // the picture's upper left corner
  EXPECT_TRUE(eye_at_rest().isApprox(Vec3(-2.5925, 1.119, 1.5), 1e-5));
  touch(1, EventPhase::change, 7168 * 0.75, 3072 * 0.25);
  EXPECT_TRUE(eye_at_rest().isApprox(Vec3(5.185 / 4, 2.238 / 4, 1.5), 1e-5));
}

TEST_F(TouchEyeTest, GlidesAndDoesNotJump) {
  const Vec3 before = eye_at_rest();
  touch(1, EventPhase::begin, 7168, 3072);
  const double way_m = (Vec3(2.5925, -1.119, 1.5) - before).norm();
  Vec3 last = before;
  for (int frame = 0; frame < 60; ++frame) {
    now_ += milliseconds(16);
    const Vec3 eye = eye_.at(now_, now_).eye_in_wall;
    EXPECT_LT((eye - last).norm(), 0.16 * way_m);
    last = eye;
  }
  EXPECT_LT((last - Vec3(2.5925, -1.119, 1.5)).norm(), 1e-3);
}

TEST_F(TouchEyeTest, StaysWhereTheLastHandLeft) {
  touch(1, EventPhase::begin, 7168 / 2.0, 3072 / 2.0);
  const Vec3 touched = eye_at_rest();
  touch(1, EventPhase::end, 7168 / 2.0, 3072 / 2.0);
  EXPECT_TRUE(eye_at_rest().isApprox(touched, 1e-9));
}

TEST_F(TouchEyeTest, FollowsOneHandWhileItMovesAndAnotherOnceItLeft) {
  touch(1, EventPhase::begin, 0, 0);
  touch(2, EventPhase::begin, 7168, 0);
  const Vec3 first = eye_at_rest();
  EXPECT_LT(first.x(), -2.5);
  touch(1, EventPhase::end, 0, 0);
  touch(2, EventPhase::change, 7168, 10);
  EXPECT_GT(eye_at_rest().x(), 2.5);
}

TEST_F(TouchEyeTest, LeavesAHandThatWasForgottenForOneThatMoves) {
  touch(1, EventPhase::begin, 0, 0);  // and no end ever comes
  eye_at_rest();
  now_ += seconds(3);
  touch(2, EventPhase::begin, 7168, 0);
  EXPECT_GT(eye_at_rest().x(), 2.5);
}

TEST_F(TouchEyeTest, TakesOtherEventsForWhatTheyAre) {
  const Vec3 before = eye_at_rest();
  device_->publish(EventMessage{.source = "frame", .kind = EventKind::key, .x_px = 1, .y_px = 1});
  EXPECT_TRUE(eye_at_rest().isApprox(before, 1e-9));
}

class TouchEyeBeforeACurve : public TouchEyeTest {
 protected:
  TouchEyeBeforeACurve() : TouchEyeTest(site_with(60)) {}
};

TEST_F(TouchEyeBeforeACurve, StandsSquareToTheTileThatIsTouched) {
  touch(1, EventPhase::begin, 512, 3072 - 384);  // the middle of tile-0-0
  const TileCorners& tile = site_.wall.find("tile-0-0")->corners;
  const Vec3 expected = tile.centre_in_wall() + 1.5 * tile.normal_in_wall();
  EXPECT_TRUE(eye_at_rest().isApprox(expected, 1e-6));
}

}  // namespace
}  // namespace vindu::app
