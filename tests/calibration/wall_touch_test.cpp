// The wall's frame from touched points, on report bytes of emulated Wiimotes.
#include "tracker/calibration/wall_touch.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/calibration/emulated_capture.h"

namespace vindu {
namespace {

using namespace testing;

Site room_with_wall() {
  Site site = true_site({{-1, 2.3, 4}, {1, 2.3, 4}});
  site.wall = expand_wall({.columns = 7,
                           .rows = 4,
                           .width_m = 5.185,
                           .height_m = 2.238,
                           .tile_width_px = 1024,
                           .tile_height_px = 768,
                           .mount = {}},
                          {}, room_from_wall_at(1.55, 0));
  for (CameraConfig& camera : site.cameras)
    camera.room_from_camera = look_at(camera.room_from_camera.translation, {0, 1.55, 0});
  return site;
}

LedBody touching_led(const std::vector<WallTarget>& targets, const Rigid3& room_from_wall) {
  std::vector<Vec3> points_in_room;
  for (const WallTarget& target : targets)
    points_in_room.push_back(room_from_wall * target.x_in_wall);
  return touching(std::move(points_in_room));
}

TEST(WallTargets, AreTileCornersThatTwoCamerasSeeFarApart) {
  const auto targets = choose_targets(room_with_wall(), 5);
  ASSERT_EQ(targets.size(), 5u);
  EXPECT_THAT(targets[0].name, ::testing::HasSubstr("corner of tile-"));
  EXPECT_GT((targets[0].x_in_wall - targets[1].x_in_wall).norm(), 1);
}

TEST(WallFit, BringsMovedCamerasBackToTheWall) {
  EmulatedCapture wanted{.site = room_with_wall(), .seconds = 17};
  const auto targets = choose_targets(wanted.site, 5);
  wanted.body = touching_led(targets, wanted.site.wall.room_from_wall);
  const Capture capture = capture_of(wanted);
  const Rigid3 moved{Quat(Eigen::AngleAxisd(0.2, Vec3(1, 2, 3).normalized())), {0.3, -0.1, 0.2}};
  auto said = wanted.site.cameras;
  for (CameraConfig& camera : said) camera.room_from_camera = moved * camera.room_from_camera;
  const auto touches = find_touches(capture, said);
  ASSERT_EQ(touches.size(), targets.size());
  const WallFit fit = fit_wall(touches, targets, wanted.site.wall.room_from_wall);
  EXPECT_LT(fit.rms_mm, 15);
  EXPECT_NEAR(fit.scale, 1, 0.01);
  for (std::size_t i = 0; i < 2; ++i) {
    const Rigid3 found = fit.room_from_before * said[i].room_from_camera;
    const Rigid3& truth = wanted.site.cameras[i].room_from_camera;
    EXPECT_LT((found.translation - truth.translation).norm(), 0.05);
    EXPECT_LT(1e3 * (found.translation - truth.translation).norm(),
              3 * fit.sigma_mm_at(truth.translation));
    EXPECT_LT(fit.sigma_mm_at(truth.translation), 50);
    EXPECT_LT(found.rotation.angularDistance(truth.rotation), radians(1));
  }
}

/// The end of the capture is cut off.
Capture until(const Capture& capture, double end_s) {
  Capture begun = capture;
  std::erase_if(begun.observations,
                [&](const Observation& seen) { return seen.arrival > Time{from_seconds(end_s)}; });
  return begun;
}

TEST(WallTouches, AreCountedOneAfterTheOtherWhileTheLedIsHeld) {
  EmulatedCapture wanted{.site = room_with_wall(), .seconds = 17};
  const auto targets = choose_targets(wanted.site, 5);
  wanted.body = touching_led(targets, wanted.site.wall.room_from_wall);
  const Capture capture = capture_of(wanted);
  const auto after = [&](double end_s) {
    return follow_touches(until(capture, end_s), wanted.site.cameras, targets);
  };
  const TouchProgress half = after(3.5), held = after(4.3), on_its_way = after(5.5);
  EXPECT_EQ(half.touches.size(), 1u);
  EXPECT_GT(half.held, 0.3);
  EXPECT_LT(half.held, 1);
  EXPECT_EQ(held.touches.size(), 2u);  // and is still held there: that is not the third's time
  EXPECT_EQ(held.held, 0);
  EXPECT_LT(on_its_way.held, 0.2);
  const TouchProgress end = after(17);
  EXPECT_EQ(end.touches.size(), targets.size());
  EXPECT_EQ(end.remark, "");
}

TEST(WallTouches, OfAnotherPointAreRefusedAndTheRightOneStillCounts) {
  EmulatedCapture wanted{.site = room_with_wall(), .seconds = 11};
  const auto targets = choose_targets(wanted.site, 3);
  wanted.body = touching_led({targets[0], targets[2], targets[1], targets[2]},
                             wanted.site.wall.room_from_wall);
  const Capture capture = capture_of(wanted);
  const auto refused = follow_touches(until(capture, 5), wanted.site.cameras, targets);
  EXPECT_EQ(refused.touches.size(), 1u);
  EXPECT_THAT(refused.remark, ::testing::HasSubstr("point 2 is"));
  const auto end = follow_touches(capture, wanted.site.cameras, targets);
  EXPECT_EQ(end.touches.size(), 3u);
}

TEST(WallTouches, NameWhatKeepsTheCamerasFromSeeingThem) {
  EmulatedCapture wanted{.site = room_with_wall(), .seconds = 2};
  const auto targets = choose_targets(wanted.site, 5);
  wanted.body = touching_led(targets, wanted.site.wall.room_from_wall);
  Capture hidden = capture_of(wanted), lamps = hidden;
  for (Observation& seen : hidden.observations)
    if (seen.camera == 1) seen.dots = {};
  EXPECT_THAT(follow_touches(hidden, wanted.site.cameras, targets).remark,
              ::testing::HasSubstr("only camera-0 sees the LED"));
  for (Observation& seen : lamps.observations)
    if (seen.camera == 1) seen.dots.push_back({500, 300, 2});
  EXPECT_THAT(follow_touches(lamps, wanted.site.cameras, targets).remark,
              ::testing::HasSubstr("camera-1 sees several lights"));
  EXPECT_EQ(follow_touches({}, wanted.site.cameras, targets).remark, "");
}

TEST(WallFit, OfTouchesInAnotherOrderIsRefused) {
  EmulatedCapture wanted{.site = room_with_wall(), .seconds = 17};
  auto targets = choose_targets(wanted.site, 5);
  wanted.body = touching_led(targets, wanted.site.wall.room_from_wall);
  const auto touches = find_touches(capture_of(wanted), wanted.site.cameras);
  std::swap(targets[0], targets[2]);
  EXPECT_THROW(fit_wall(touches, targets, wanted.site.wall.room_from_wall), Error);
}

TEST(WallFit, OfTooFewTouchesIsRefused) {
  const auto targets = choose_targets(room_with_wall(), 5);
  EXPECT_THROW(fit_wall({}, targets, {}), Error);
}

}  // namespace
}  // namespace vindu
