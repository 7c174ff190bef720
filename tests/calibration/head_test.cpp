// A helmet's LEDs and eye from a capture, on report bytes of emulated Wiimotes.
#include "tracker/calibration/head.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/random.h"
#include "tests/calibration/emulated_capture.h"
#include "tracker/camera_model.h"

namespace vindu {
namespace {

using namespace testing;

/// Stands still for 3 s, facing the wall, then turns and walks.
BodyMotion still_then_moving(const Vec3& place_in_room) {
  WaveOptions wave;
  wave.seed = 3;
  wave.start = Time{std::chrono::seconds(3)};
  wave.room_from_rest.translation = place_in_room;
  wave.reach_m = {0.4, 0.1, 0.3};
  wave.turn_rad = {0.2, 0.4, 0.2};
  wave.tempo_hz = 0.1;
  const BodyMotion moving = waved(wave);
  return [moving, rest = wave.room_from_rest](Time time) {
    const double t = std::clamp((seconds(time.time_since_epoch()) - 3) / 2, 0.0, 1.0);
    return interpolate(rest, moving(time), t * t * (3 - 2 * t));
  };
}

TEST(Head, FindsTheLedsAndTheEye) {
  HeadConfig truth;
  truth.leds_in_head = {{-0.10, 0.01, -0.08}, {0, 0, 0}, {0.08, -0.02, -0.06}};
  truth.eye_in_head = {0.005, -0.11, -0.18};
  const Vec3 place(0.05, 1.68, 2.0);
  EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}), .seconds = 40};
  wanted.body = bare_leds(truth.leds_in_head, still_then_moving(place));
  HeadOptions options;
  options.eye_in_room = place + truth.eye_in_head;
  const HeadResult result = calibrate_head(capture_of(wanted), wanted.site.cameras,
                                           wanted.site.wall.room_from_wall, {}, options);
  ASSERT_EQ(result.head.leds_in_head.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((result.head.leds_in_head[i] - truth.leds_in_head[i]).norm(), 0.003) << i;
  EXPECT_LT((result.head.eye_in_head - truth.eye_in_head).norm(), 0.004);
  EXPECT_LT(result.rms_px, 1);
}

/// The wall file's helmet has its origin 60 mm below the rearmost LED.
TEST(Head, KeepsAnEyeThatIsNotMeasuredWhereItWasFromTheRearmostLed) {
  HeadConfig known;
  known.leds_in_head = {{-0.10, 0.07, -0.08}, {0, 0.06, 0}, {0.08, 0.04, -0.06}};
  known.eye_in_head = {0, -0.05, -0.18};
  EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}), .seconds = 40};
  wanted.body = bare_leds(known.leds_in_head, still_then_moving({0.05, 1.62, 2.0}));
  const HeadResult result = calibrate_head(capture_of(wanted), wanted.site.cameras,
                                           wanted.site.wall.room_from_wall, known, {});
  EXPECT_LT((result.head.eye_in_head - Vec3(0, -0.11, -0.18)).norm(), 1e-9);
  EXPECT_LT((result.head.leds_in_head[1]).norm(), 1e-9);
}

/// Dots of bare LEDs as two video cameras see them, in no order, 60 times a second.
Capture of_video_cameras(const std::vector<CameraConfig>& cameras, const std::vector<Vec3>& leds,
                         const BodyMotion& room_from_head) {
  Random random(1);
  Capture capture{.observations = {}, .up_in_camera = {{}, {}}};
  for (int k = 0; k < 40 * 60; ++k)
    for (int i = 0; i < 2; ++i) {
      const CameraModel camera(cameras[static_cast<std::size_t>(i)]);
      Observation seen{i, Time{} + from_seconds(k / 60.0 + 1e-3 * i), {}};
      const Rigid3 camera_from_head = camera.camera_from_room() * room_from_head(seen.arrival);
      for (std::size_t n = 0; n < leds.size(); ++n) {
        const Vec3& led = leds[(n * 3 + static_cast<std::size_t>(k)) % leds.size()];
        const Vec2 dot_px = *camera.project(camera_from_head * led);
        seen.dots.push_back({dot_px.x() + random.normal(0.3), dot_px.y() + random.normal(0.3), 20});
      }
      capture.observations.push_back(seen);
    }
  return capture;
}

std::vector<CameraConfig> two_video_cameras() {
  std::vector<CameraConfig> cameras = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}).cameras;
  for (CameraConfig& camera : cameras) {
    camera.source = CameraSource::video;
    camera.video.width_px = 1024, camera.video.height_px = 768;
  }
  return cameras;
}

TEST(Head, OfEightLedsIsMeasuredByVideoCameras) {
  const std::vector<CameraConfig> cameras = two_video_cameras();
  const std::vector<Vec3> truth = {
      {-0.10, 0.01, -0.08}, {-0.08, -0.06, -0.04}, {-0.04, 0.05, -0.03}, {-0.01, -0.04, -0.02},
      {0.01, 0.02, 0},      {0.05, -0.03, -0.03},  {0.08, 0.06, -0.06},  {0.11, -0.01, -0.09}};
  const Vec3 place(0.05, 1.68, 2.0);
  const Site site = true_site({});
  HeadOptions options{.leds = 8, .eye_in_room = place + Vec3(0, -0.11, -0.18)};
  const HeadResult result =
      calibrate_head(of_video_cameras(cameras, truth, still_then_moving(place)), cameras,
                     site.wall.room_from_wall, {}, options);
  ASSERT_EQ(result.head.leds_in_head.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_LT((result.head.leds_in_head[i] - (truth[i] - truth[4])).norm(), 0.003) << i;
  EXPECT_LT((result.head.eye_in_head - Vec3(0, -0.11, -0.18) + truth[4]).norm(), 0.004);
  EXPECT_LT(result.rms_px, 1);
}

/// For its first fifth of a second one camera sees a lamp in the place of an LED.
TEST(Head, IsMeasuredThoughTheFirstPicturesShowSomethingElse) {
  const std::vector<CameraConfig> cameras = two_video_cameras();
  const std::vector<Vec3> truth = {
      {-0.10, 0.01, -0.08}, {0, 0, 0}, {0.03, -0.06, -0.02}, {0.08, 0.02, -0.06}};
  Capture capture = of_video_cameras(cameras, truth, still_then_moving({0.05, 1.68, 2.0}));
  for (Observation& seen : capture.observations)
    if (seen.camera == 0 && seen.arrival < Time{} + from_seconds(0.2)) seen.dots[0].y_px += 60;
  const Site site = true_site({});
  HeadOptions options;
  options.leds = 4;
  const HeadResult result = calibrate_head(capture, cameras, site.wall.room_from_wall, {}, options);
  ASSERT_EQ(result.head.leds_in_head.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((result.head.leds_in_head[i] - truth[i]).norm(), 0.003) << i;
}

TEST(Head, OfMoreLedsThanTwoCamerasTellOfIsRefused) {
  const Site site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}});
  HeadOptions five;
  five.leds = 5;
  EXPECT_THAT([&] { calibrate_head({}, site.cameras, site.wall.room_from_wall, {}, five); },
              ::testing::ThrowsMessage<Error>(
                  ::testing::HasSubstr("no two cameras tell of more than 4 dots")));
}

TEST(Head, OfAWearerWhoDoesNotStandStillIsRefused) {
  EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}), .seconds = 20};
  WaveOptions wave;
  wave.room_from_rest.translation = {0, 1.68, 2.0};
  wave.reach_m = {0.4, 0.1, 0.3};
  wave.turn_rad = {0.2, 0.4, 0.2};
  wanted.body = bare_leds(HeadConfig{}.leds_in_head, waved(wave));
  EXPECT_THROW(calibrate_head(capture_of(wanted), wanted.site.cameras,
                              wanted.site.wall.room_from_wall, {}, {}),
               Error);
}

TEST(Head, OfFewerLedsThanItIsSaidToHaveIsRefusedWithTheirNumber) {
  EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}), .seconds = 20};
  wanted.body = bare_leds(HeadConfig{}.leds_in_head, still_then_moving({0, 1.68, 2.0}));
  const Capture capture = capture_of(wanted);
  HeadOptions four;
  four.leds = 4;
  EXPECT_THAT(
      [&] {
        calibrate_head(capture, wanted.site.cameras, wanted.site.wall.room_from_wall, {}, four);
      },
      ::testing::ThrowsMessage<Error>(
          ::testing::ContainsRegex("all 4 LEDs at 0 moments only; they saw 3 dots at .*--leds 3")));
}

}  // namespace
}  // namespace vindu
