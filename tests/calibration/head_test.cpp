// A helmet's LEDs and eye from a capture, on report bytes of emulated Wiimotes.
#include "tracker/calibration/head.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/calibration/emulated_capture.h"

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
