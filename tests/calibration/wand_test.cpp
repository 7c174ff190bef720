// The wand calibration on report bytes of emulated Wiimotes: as exact as the dots allow, and a
// clear refusal of what cannot be calibrated.
#include "tracker/calibration/wand.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/random.h"
#include "tests/calibration/emulated_capture.h"
#include "tracker/calibration/wand_adjust.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace testing;

const std::vector<Vec3> kTwo = {{-1, 2.3, 5}, {1, 2.3, 5}};
const std::vector<double> kThreeLeds = {0, 0.15, 0.5};
constexpr double kNoise_px = 0.6;

Rigid3 first_from(const Rigid3& first, const Rigid3& other) { return inverse(first) * other; }

/// How far a camera's place is from the truth, both seen from the first camera.
double off_mm(const WandResult& result, const Site& site, std::size_t camera) {
  const Rigid3 found =
      first_from(result.cameras[0].room_from_camera, result.cameras[camera].room_from_camera);
  const Rigid3 truth =
      first_from(site.cameras[0].room_from_camera, site.cameras[camera].room_from_camera);
  return 1e3 * (found.translation - truth.translation).norm();
}

WandResult calibrate(const EmulatedCapture& wanted, WandOptions options = {}) {
  return calibrate_wand(capture_of(wanted), wanted.site.cameras, options);
}

std::string refusal(const Capture& capture, const Site& site, const WandOptions& options = {}) {
  try {
    calibrate_wand(capture, site.cameras, options);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

/// This share of all dots stands elsewhere.
void displace(double share, Capture& capture) {
  Random random(99);
  for (Observation& observation : capture.observations)
    for (Dot& dot : observation.dots)
      if (random.uniform(0, 1) < share) {
        dot.x_px = std::clamp(dot.x_px + random.uniform(-150, 150), 0.0, 1023.0);
        dot.y_px = std::clamp(dot.y_px + random.uniform(-150, 150), 0.0, 767.0);
      }
}

/// The Jacobian's bound at the truth, for as many moments of this wave.
double bound_mm(const Site& site, const BodyMotion& motion, const std::vector<double>& leds_m,
                int moments) {
  WandWorld world;
  for (const CameraConfig& camera : site.cameras) {
    AdjustedCamera adjusted;
    adjusted.world_from_camera =
        first_from(site.cameras[0].room_from_camera, camera.room_from_camera);
    adjusted.prior = lens_prior(camera);
    adjusted.lens = lens_of(camera.intrinsics);
    adjusted.sigma_px = std::sqrt(kNoise_px * kNoise_px + 1.0 / 12);
    world.cameras.push_back(adjusted);
  }
  for (const double led : leds_m) world.leds_m.push_back(led - 0.5 * leds_m.back());
  const Rigid3 world_from_room = inverse(site.cameras[0].room_from_camera);
  std::vector<WandMoment> all;
  for (double t_s = 0.3; t_s < 60; t_s += 0.02) {
    const Rigid3 world_from_wand = world_from_room * motion(Time{from_seconds(t_s)});
    WandPose pose;
    pose << world_from_wand.translation, world_from_wand.rotation * Vec3::UnitX();
    WandMoment moment{.t_s = t_s, .views = {}};
    for (int i = 0; i < static_cast<int>(site.cameras.size()); ++i) {
      WandView view{.camera = i, .t_s = t_s, .dots_px = {}, .speed_px_s = {}, .used = {}};
      const CameraModel model(site.cameras[static_cast<std::size_t>(i)]);
      for (const double led : world.leds_m) {
        const auto raw_px = model.project(model.camera_from_room() *
                                          (motion(Time{from_seconds(t_s)}) * Vec3(led, 0, 0)));
        if (!raw_px || raw_px->minCoeff() < 0 || raw_px->x() > 1023 || raw_px->y() > 767) continue;
        view.dots_px.push_back(image_from_raw(CameraSource::emulated, *raw_px));
        const Vec3 later = motion(Time{from_seconds(t_s + 0.01)}) * Vec3(led, 0, 0);
        view.speed_px_s.emplace_back(
            100 * (image_from_raw(CameraSource::emulated,
                                  *model.project(model.camera_from_room() * later)) -
                   view.dots_px.back()));
        view.used.push_back(true);
      }
      if (view.dots_px.size() == leds_m.size()) moment.views.push_back(view);
    }
    if (moment.views.size() < 2) continue;
    all.push_back(moment);
    world.poses.push_back(pose);
  }
  std::vector<WandMoment> chosen;
  std::vector<WandPose> poses;
  for (std::size_t i = 0; i < static_cast<std::size_t>(moments); ++i) {
    chosen.push_back(all[i * all.size() / static_cast<std::size_t>(moments)]);
    poses.push_back(world.poses[i * all.size() / static_cast<std::size_t>(moments)]);
  }
  world.poses = poses;
  return 1e3 * sigmas_of(chosen, world, SigmaBy::noise)[1].position_m.norm();
}

TEST(Wand, OfFiveHundredPosesIsAsExactAsTheDotsAllow) {
  const Site site = true_site(kTwo);
  double sum2_mm = 0, length_mm = 0, rms_ratio = 0;
  constexpr int kRuns = 6;
  double bound2_mm = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const LedBody body = wand(kThreeLeds, seed);
    WandOptions options;
    options.max_poses = 500;
    const WandResult result =
        calibrate({.site = site, .body = body, .noise_px = kNoise_px, .seed = seed}, options);
    const double bound = bound_mm(site, body.room_from_body, kThreeLeds, 500);
    const double off = off_mm(result, site, 1);
    sum2_mm += off * off / kRuns;
    bound2_mm += bound * bound / kRuns;
    length_mm += result.length_mean_mm / kRuns;
    rms_ratio += result.length_rms_mm / result.predicted_length_rms_mm / kRuns;
  }
  EXPECT_LT(std::sqrt(sum2_mm), 1.3 * std::sqrt(bound2_mm));
  EXPECT_LT(std::abs(length_mm), 0.5);
  EXPECT_LT(rms_ratio, 1.2);
}

TEST(Wand, LevelsTheRoomByGravityAndTurnsItByTheOtherCamerasPlaces) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds)};
  auto said = wanted.site.cameras;
  for (CameraConfig& camera : said) {  // looked up roughly
    camera.intrinsics = {};
    camera.room_from_camera.rotation = camera.room_from_camera.rotation *
                                       Quat(Eigen::AngleAxisd(0.1, Vec3(1, 2, -1).normalized()));
  }
  const WandResult result = calibrate_wand(capture_of(wanted), said, {});
  EXPECT_TRUE(result.level);
  for (std::size_t i = 0; i < 2; ++i) {
    const Rigid3& truth = wanted.site.cameras[i].room_from_camera;
    EXPECT_LT((result.cameras[i].room_from_camera.translation - truth.translation).norm(), 0.03);
    EXPECT_LT(result.cameras[i].room_from_camera.rotation.angularDistance(truth.rotation),
              radians(1));
  }
}

TEST(Wand, FindsLensesLagsAndPlacesOfFourCamerasWithinTheirSigmas) {
  const EmulatedCapture wanted{
      .site = true_site({{-1.5, 2.3, 5}, {1.5, 2.3, 5}, {-1.2, 2.4, -0.5}, {2.5, 1.2, 3.5}}),
      .body = wand(kThreeLeds),
      .late = {{}, std::chrono::milliseconds(23), {}, std::chrono::milliseconds(-8)}};
  const WandResult result = calibrate(wanted);
  const double lag_ms[] = {0, 23, 0, -8};
  for (std::size_t i = 0; i < 4; ++i) {
    const WandCamera& found = result.cameras[i];
    const Intrinsics& truth = wanted.site.cameras[i].intrinsics;
    EXPECT_LT(std::abs(found.intrinsics.fx_px - truth.fx_px), 4 * found.focal_sigma_px);
    EXPECT_LT(std::abs(found.intrinsics.cx_px - truth.cx_px), 4 * found.centre_sigma_px.x());
    EXPECT_LT(std::abs(found.intrinsics.cy_px - truth.cy_px), 4 * found.centre_sigma_px.y());
    EXPECT_LT(std::abs(found.intrinsics.distortion[0] - truth.distortion[0]), 4 * found.k1_sigma);
    EXPECT_LT(off_mm(result, wanted.site, i), 1 + 3 * found.position_sigma_mm.norm());
    EXPECT_LT(std::abs(found.lag_ms - lag_ms[i]), 1);
    EXPECT_LT(found.rms_px, 0.75);
  }
}

TEST(Wand, OfTwoLedsWillDo) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand({0, 0.5})};
  WandOptions options;
  options.leds_m = {0, 0.5};
  const WandResult result = calibrate(wanted, options);
  EXPECT_LT(off_mm(result, wanted.site, 1), 20);
  EXPECT_LT(std::abs(result.length_mean_mm), 1);
}

TEST(Wand, BearsOneDotInTenElsewhere) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds)};
  Capture capture = capture_of(wanted);
  displace(0.1, capture);
  const WandResult result = calibrate_wand(capture, wanted.site.cameras, {});
  EXPECT_LT(off_mm(result, wanted.site, 1), 25);
  EXPECT_LT(result.cameras[1].rms_px, 0.9);
}

TEST(Wand, BearsACameraThatHangsUpsideDown) {
  EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds)};
  Rigid3& pose = wanted.site.cameras[1].room_from_camera;
  pose.rotation = pose.rotation * Quat(Eigen::AngleAxisd(kPi, Vec3::UnitZ()));
  EXPECT_LT(off_mm(calibrate(wanted), wanted.site, 1), 20);
}

TEST(Wand, BearsLampsThatStandStill) {
  EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds)};
  wanted.glints = {{{0.3, 2.0, 1.0}, 3.0}};
  EXPECT_LT(off_mm(calibrate(wanted), wanted.site, 1), 20);
}

TEST(Wand, WavedBrisklySeesThroughTheBurstsOfALink) {
  const Site site = true_site(kTwo);
  double place2_mm = 0, lag2_ms = 0;
  constexpr int kRuns = 3;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const EmulatedCapture wanted{.site = site,
                                 .body = wand(kThreeLeds, seed, 0.14),
                                 .seed = seed,
                                 .late = {{}, std::chrono::milliseconds(5)},
                                 .link = two_on_one_adapter()};
    const WandResult result = calibrate(wanted);
    place2_mm += std::pow(off_mm(result, site, 1), 2) / kRuns;
    lag2_ms += std::pow(result.cameras[1].lag_ms - 5, 2) / kRuns;
  }
  EXPECT_LT(std::sqrt(place2_mm), 8);   // by arrivals: 10
  EXPECT_LT(std::sqrt(lag2_ms), 0.35);  // by arrivals: 0.66
}

TEST(Wand, WithItsMiddleLedElsewhereIsRefusedWithItsTruePlace) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand({0, 0.2, 0.5})};
  EXPECT_THAT(refusal(capture_of(wanted), wanted.site),
              AllOf(HasSubstr("middle LED"), HasSubstr("40.")));
}

TEST(Wand, OfAnotherLengthIsRefusedBecauseTheRoomWouldBeOfAnotherSize) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand({0, 0.21, 0.7})};
  WandOptions options;
  EXPECT_THAT(refusal(capture_of(wanted), wanted.site, options),
              AllOf(HasSubstr("wand"), ContainsRegex("0\\.7[12] times as far apart")));
}

TEST(Wand, SaidToBeATenthLongerIsDoubtedBecauseTheRoomWouldBeOfAnotherSize) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds)};
  EXPECT_THAT(calibrate(wanted).remarks, Not(Contains(HasSubstr("as far apart"))));
  EXPECT_THAT(calibrate(wanted, {.leds_m = {0, 0.165, 0.55}}).remarks,
              Contains(HasSubstr("stand 1.10 times as far apart as the wall file says")));
}

/// The second camera is turned halfway through.
Capture with_bump(Capture capture, double by_px) {
  const Time half = capture.observations[capture.observations.size() / 2].arrival;
  for (Observation& seen : capture.observations)
    for (Dot& dot : seen.dots)
      if (seen.camera == 1 && seen.arrival > half) dot.x_px = std::min(dot.x_px + by_px, 1023.0);
  return capture;
}

TEST(Wand, WavedWhileACameraMovedMuchIsRefusedAndSaysSo) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds)};
  EXPECT_THAT(refusal(with_bump(capture_of(wanted), 40), wanted.site),
              HasSubstr("if a camera moved meanwhile"));
}

TEST(Wand, WavedWhileACameraMovedIsDoubtedAndKnowsHowFarOffItMayBe) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds), .noise_px = 0.3};
  const Capture capture = capture_of(wanted);
  const WandResult still = calibrate_wand(capture, wanted.site.cameras, {});
  const WandResult moved = calibrate_wand(with_bump(capture, 10), wanted.site.cameras, {});
  EXPECT_THAT(still.remarks, Not(Contains(HasSubstr("scatters"))));
  EXPECT_THAT(moved.remarks, Contains(HasSubstr("if a camera moved meanwhile")));
  for (std::size_t i = 0; i < 2; ++i) {
    const Intrinsics& truth = wanted.site.cameras[i].intrinsics;
    const WandCamera& found = moved.cameras[i];
    EXPECT_LT(std::abs(found.intrinsics.fx_px - truth.fx_px), 3 * found.focal_sigma_px) << i;
    EXPECT_LT(std::abs(found.intrinsics.cx_px - truth.cx_px), 3 * found.centre_sigma_px.x()) << i;
    EXPECT_LT(std::abs(found.intrinsics.cy_px - truth.cy_px), 3 * found.centre_sigma_px.y()) << i;
    EXPECT_GT(found.focal_sigma_px, 2 * still.cameras[i].focal_sigma_px) << i;
  }
}

TEST(Wand, WavedInOneCornerIsRefused) {
  EmulatedCapture wanted{.site = true_site(kTwo)};
  WaveOptions wave;
  wave.room_from_rest.translation = {0.1, 1.7, 2.0};
  wave.reach_m = {0.05, 0.05, 0.05};
  wave.turn_rad = {0, 0.2, 0.2};
  wanted.body = bare_leds({{-0.25, 0, 0}, {-0.1, 0, 0}, {0.25, 0, 0}}, waved(wave));
  EXPECT_THAT(refusal(capture_of(wanted), wanted.site),
              AllOf(HasSubstr("% of its picture only"), HasSubstr("wave")));
}

TEST(Wand, WavedForAMomentOnlyIsRefused) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand(kThreeLeds), .seconds = 1.5};
  EXPECT_THAT(refusal(capture_of(wanted), wanted.site), HasSubstr("longer"));
}

TEST(Wand, NeverSeenTogetherIsRefusedWithTheCamerasName) {
  EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}, {0, 2.3, 5.5}}),
                         .body = wand(kThreeLeds)};
  Capture capture = capture_of(wanted);
  // The third camera was switched on when the others were off.
  for (Observation& observation : capture.observations)
    if (observation.camera == 2) observation.arrival += std::chrono::minutes(5);
  EXPECT_THAT(refusal(capture, wanted.site), AllOf(HasSubstr("camera-2"), HasSubstr("together")));
}

TEST(Wand, AmongManyFalseDotsIsRefused) {
  const EmulatedCapture wanted{.site = true_site(kTwo), .body = wand({0, 0.5})};
  Capture capture = capture_of(wanted);
  displace(0.6, capture);
  WandOptions options;
  options.leds_m = {0, 0.5};
  EXPECT_NE(refusal(capture, wanted.site, options), "");
}

TEST(Wand, WithItsMiddleLedHalfwayIsRefused) {
  WandOptions options;
  options.leds_m = {0, 0.25, 0.5};
  EXPECT_THAT(refusal({}, true_site(kTwo), options), HasSubstr("halfway"));
}

}  // namespace
}  // namespace vindu
