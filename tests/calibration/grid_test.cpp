// Lenses and places from a rig of LEDs in a grid, on report bytes of emulated Wiimotes.
#include "tracker/calibration/grid.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/calibration/emulated_capture.h"

namespace vindu {
namespace {

using ::testing::HasSubstr;
using namespace testing;

constexpr Grid kThesisRig{};

std::vector<Vec2> seen_turned(const Grid& grid, double turn_rad) {
  std::vector<Vec2> dots;
  const Eigen::Rotation2Dd turn(turn_rad);
  for (const Vec3& led : grid.leds_in_rig())
    dots.emplace_back(turn * Vec2(900 * led.x() + 60 * led.x() * led.y(), -900 * led.y()) +
                      Vec2(500, 380));
  return dots;
}

/// The rig, waved before a camera that it faces.
LedBody waved_rig(const CameraConfig& camera, const Grid& grid, double turn_rad) {
  const Rigid3 camera_from_rest{Quat(Eigen::AngleAxisd(kPi, Vec3::UnitX())), {0, 0, 0.75}};
  WaveOptions wave;
  wave.seed = 5;
  wave.room_from_rest = camera.room_from_camera * camera_from_rest;
  wave.reach_m = {0.2, 0.15, 0.2};
  wave.turn_rad = {turn_rad, turn_rad, 0.6};
  return bare_leds(grid.leds_in_rig(), waved(wave));
}

TEST(GridLabels, AreThoseOfTheThesisFigureWhicheverWayTheCameraIsHeld) {
  for (const Grid& grid : {Grid{}, Grid{3, 2, 0.1, 0.1}, Grid{4, 4, 0.1, 0.08}})
    for (const double turn_deg : {0.0, 20.0, 100.0, 180.0, 270.0}) {
      const auto dots = seen_turned(grid, radians(turn_deg));
      const Vec2 up = Eigen::Rotation2Dd(radians(turn_deg)) * Vec2(0, -1);
      const auto labels = label_grid(dots, grid, up);
      ASSERT_TRUE(labels) << grid.columns << " " << turn_deg;
      for (std::size_t i = 0; i < labels->size(); ++i) EXPECT_EQ((*labels)[i], i);
    }
}

TEST(GridLabels, OfDotsThatAreNoGridAreNone) {
  EXPECT_FALSE(label_grid({{0, 0}, {1, 0}, {1, 1}}, Grid{}));
  auto dots = seen_turned({3, 3, 0.1, 0.1}, 0);
  dots[4] += Vec2(40, 0);
  EXPECT_FALSE(label_grid(dots, {3, 3, 0.1, 0.1}));
}

TEST(Lens, IsFoundFromThirtyViewsOfTheThesisRig) {
  EmulatedCapture wanted{.site = true_site({{0, 1.5, 5}}), .seconds = 25};
  wanted.body = waved_rig(wanted.site.cameras[0], kThesisRig, 1.0);
  const LensResult lens = calibrate_lens(capture_of(wanted), wanted.site.cameras, 0, kThesisRig);
  const Intrinsics& truth = wanted.site.cameras[0].intrinsics;
  EXPECT_GE(lens.views, 20);
  EXPECT_LT(std::abs(lens.intrinsics.fx_px - truth.fx_px), 3 * lens.focal_sigma_px + 1);
  EXPECT_LT(lens.focal_sigma_px, 40);
  EXPECT_LT(lens.rms_px, 1);
}

TEST(Lens, OfACameraUpsideDownIsFound) {
  EmulatedCapture wanted{.site = true_site({{0, 1.5, 5}}), .seconds = 25};
  Rigid3& pose = wanted.site.cameras[0].room_from_camera;
  wanted.body = waved_rig(wanted.site.cameras[0], kThesisRig, 1.0);
  pose.rotation = pose.rotation * Quat(Eigen::AngleAxisd(kPi, Vec3::UnitZ()));
  const LensResult lens = calibrate_lens(capture_of(wanted), wanted.site.cameras, 0, kThesisRig);
  EXPECT_LT(std::abs(lens.intrinsics.fx_px - wanted.site.cameras[0].intrinsics.fx_px),
            3 * lens.focal_sigma_px + 1);
}

TEST(Lens, FromARigThatIsNeverTiltedIsRefused) {
  EmulatedCapture wanted{.site = true_site({{0, 1.5, 5}}), .seconds = 25};
  wanted.body = waved_rig(wanted.site.cameras[0], kThesisRig, 0.02);
  try {
    calibrate_lens(capture_of(wanted), wanted.site.cameras, 0, kThesisRig);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("tilt"));
  }
}

TEST(Place, IsFoundFromARigAtAKnownPlaceAlsoUpsideDown) {
  for (const double roll_rad : {0.0, kPi}) {
    EmulatedCapture wanted{.site = true_site({{-1, 2.3, 4}}), .seconds = 2};
    Rigid3& pose = wanted.site.cameras[0].room_from_camera;
    pose.rotation = pose.rotation * Quat(Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()));
    const Grid grid{2, 2, 0.3, 0.3};
    Rigid3 room_from_rig{Quat(Eigen::AngleAxisd(-0.3, Vec3::UnitY())), {-0.2, 1.6, 2}};
    wanted.body = bare_leds(grid.leds_in_rig(), [&](Time) { return room_from_rig; });
    const PlaceResult place =
        calibrate_place(capture_of(wanted), wanted.site.cameras, 0, grid, room_from_rig);
    EXPECT_LT((place.room_from_camera.translation - pose.translation).norm(), 0.06);
    EXPECT_LT(place.room_from_camera.rotation.angularDistance(pose.rotation), radians(1.5));
  }
}

}  // namespace
}  // namespace vindu
