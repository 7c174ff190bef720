// The bound of what cameras can know of a head: against the scatter of a fit to noisy dots, the
// figures of the literature, and the levels of tracking.
#include "tracker/coverage.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/random.h"

namespace vindu {
namespace {

const HeadConfig kFourLeds = {
    .leds_in_head = {{-0.09, 0, 0}, {0.09, 0.02, 0}, {0.02, 0.09, -0.04}, {0, -0.03, 0.07}},
    .eye_in_head = {0, -0.06, -0.08}};
const HeadConfig kThreeLeds = {
    .leds_in_head = {{-0.09, 0, 0}, {0.09, 0.02, 0}, {0.02, 0.09, -0.04}},
    .eye_in_head = {0, -0.06, -0.08}};

DotNoise all_seen(double sigma_px = rounded_noise_px(kDotNoise_px)) {
  return [sigma_px](std::size_t, const Vec3&) { return std::optional(sigma_px); };
}

CameraConfig camera_at(const Vec3& position_in_room, const Vec3& target_in_room) {
  CameraConfig camera;
  camera.intrinsics.fx_px = camera.intrinsics.fy_px = 1320;
  camera.room_from_camera = look_at(position_in_room, target_in_room);
  return camera;
}

/// Two cameras beside each other, behind a head at the origin.
std::vector<CameraConfig> pair(double distance_m, double baseline_m) {
  return {camera_at({-baseline_m / 2, 0, distance_m}, {0, 0, 0}),
          camera_at({baseline_m / 2, 0, distance_m}, {0, 0, 0})};
}

PoseBound bound(const std::vector<CameraConfig>& cameras, const HeadConfig& head,
                const DotNoise& noise, const Rigid3& room_from_head) {
  return survey(cameras, head, noise, std::span(&room_from_head, 1)).front();
}

// A fit that shares nothing with the bound: Gauss-Newton with numerical derivatives, of six
// numbers: the head's place (m) and its rotation vector (rad), both from the true pose.
using Six = Eigen::Matrix<double, 6, 1>;

Rigid3 moved(const Rigid3& pose, const Six& by) {
  const double angle_rad = by.tail<3>().norm();
  const Quat turn = angle_rad > 0 ? Quat(Eigen::AngleAxisd(angle_rad, by.tail<3>() / angle_rad))
                                  : Quat::Identity();
  return {(turn * pose.rotation).normalized(), pose.translation + by.head<3>()};
}

Eigen::VectorXd dots_of(const std::vector<CameraModel>& cameras, const HeadConfig& head,
                        const Rigid3& room_from_head) {
  Eigen::VectorXd dots(2 * cameras.size() * head.leds_in_head.size());
  Eigen::Index at = 0;
  for (const CameraModel& camera : cameras)
    for (const Vec3& led : head.leds_in_head) {
      dots.segment<2>(at) = *camera.project(camera.camera_from_room() * (room_from_head * led));
      at += 2;
    }
  return dots;
}

Rigid3 fit(const std::vector<CameraModel>& cameras, const HeadConfig& head,
           const Eigen::VectorXd& seen, Rigid3 pose) {
  for (int step = 0; step < 6; ++step) {
    Eigen::MatrixXd jacobian(seen.size(), 6);
    for (int i = 0; i < 6; ++i) {
      const Six aside = 1e-5 * Six::Unit(i);
      jacobian.col(i) = (dots_of(cameras, head, moved(pose, aside)) -
                         dots_of(cameras, head, moved(pose, -aside))) /
                        2e-5;
    }
    const Eigen::VectorXd error = seen - dots_of(cameras, head, pose);
    pose = moved(pose, jacobian.colPivHouseholderQr().solve(error));
  }
  return pose;
}

struct Scatter {
  double eye_m = 0;
  double depth_m = 0;
  double rotation_rad = 0;
};

Scatter scatter(const std::vector<CameraConfig>& configs, const HeadConfig& head,
                const Rigid3& truth, double sigma_px) {
  constexpr int kFits = 600;
  const std::vector<CameraModel> cameras(configs.begin(), configs.end());
  const Eigen::VectorXd exact = dots_of(cameras, head, truth);
  Random random(7);
  Scatter sum;
  for (int i = 0; i < kFits; ++i) {
    Eigen::VectorXd noisy = exact;
    for (double& value : noisy) value += random.normal(sigma_px);
    const Rigid3 found = fit(cameras, head, noisy, truth);
    const Vec3 eye_error = found * head.eye_in_head - truth * head.eye_in_head;
    const double angle_rad = found.rotation.angularDistance(truth.rotation);
    sum.eye_m += eye_error.squaredNorm() / kFits;
    sum.depth_m += eye_error.z() * eye_error.z() / kFits;
    sum.rotation_rad += angle_rad * angle_rad / kFits;
  }
  return {std::sqrt(sum.eye_m), std::sqrt(sum.depth_m), std::sqrt(sum.rotation_rad)};
}

void expect_bound_is_the_scatter(const std::vector<CameraConfig>& cameras, const HeadConfig& head,
                                 const Rigid3& pose) {
  constexpr double kSigma_px = 0.5;
  const PoseBound found = bound(cameras, head, all_seen(kSigma_px), pose);
  const Scatter expected = scatter(cameras, head, pose, kSigma_px);
  EXPECT_EQ(found.level, TrackingLevel::six_dof);
  EXPECT_NEAR(found.eye_m / expected.eye_m, 1, 0.08);
  EXPECT_NEAR(found.depth_m / expected.depth_m, 1, 0.1);
  EXPECT_NEAR(found.rotation_rad / expected.rotation_rad, 1, 0.08);
}

TEST(Coverage, BoundIsTheScatterOfALeastSquaresFitWithTwoCamerasAndFourLeds) {
  expect_bound_is_the_scatter(pair(3, 2), kFourLeds, head_at({0, 0, 0}, radians(15), kFourLeds));
}

TEST(Coverage, BoundIsTheScatterOfALeastSquaresFitWithThreeLedsAside) {
  expect_bound_is_the_scatter(pair(4, 1), kThreeLeds,
                              head_at({0.3, 0.1, 0.2}, radians(-25), kThreeLeds));
}

TEST(Coverage, BoundIsTheScatterOfALeastSquaresFitThroughABendingLens) {
  std::vector<CameraConfig> cameras = pair(2, 1);
  for (CameraConfig& camera : cameras)
    camera.intrinsics.distortion = {-0.2, 0.05, 0.002, -0.001, 0};
  expect_bound_is_the_scatter(cameras, kFourLeds, head_at({0.2, 0.1, 0}, 0, kFourLeds));
}

// Simulated fits of others, averaged over a region; their layouts have about this size, with the
// eye 8 to 10 cm from the LEDs. How the error splits into lateral and depth hangs on where.
TEST(Coverage, BoundAgreesWithSimulatedFitsToSimilarHelmets) {
  HeadConfig four = kFourLeds, three = kThreeLeds;
  four.eye_in_head = three.eye_in_head = {0, -0.09, 0};
  struct Case {
    double distance_m, baseline_m;
    HeadConfig head;
    double eye_mm, lateral_mm, depth_mm, rotation_deg;
  };
  for (const Case& c :
       {Case{2, 2, four, 1.5, 0.8, 1.2, 0.71}, Case{3, 1, three, 4.6, 1.8, 4.2, 2.01},
        Case{3, 2, three, 3.5, 1.7, 3.0, 1.75}, Case{3, 2, four, 2.4, 1.1, 2.1, 1.00},
        Case{5, 2, four, 4.9, 1.8, 4.6, 1.63}}) {
    const PoseBound found =
        bound(pair(c.distance_m, c.baseline_m), c.head, all_seen(), head_at({0, 0, 0}, 0, c.head));
    std::printf(
        "%.0f m, baseline %.0f m, %zu LEDs: %.1f (%.1f / %.1f) mm, %.2f deg; theirs %.1f "
        "(%.1f / %.1f) mm, %.2f deg\n",
        c.distance_m, c.baseline_m, c.head.leds_in_head.size(), 1e3 * found.eye_m,
        1e3 * found.lateral_m, 1e3 * found.depth_m, degrees(found.rotation_rad), c.eye_mm,
        c.lateral_mm, c.depth_mm, c.rotation_deg);
    EXPECT_NEAR(1e3 * found.eye_m / c.eye_mm, 1, 0.12);
    EXPECT_NEAR(1e3 * found.lateral_m / c.lateral_mm, 1, 0.4);
    EXPECT_NEAR(1e3 * found.depth_m / c.depth_mm, 1, 0.25);
    EXPECT_NEAR(degrees(found.rotation_rad) / c.rotation_deg, 1, 0.12);
  }
}

TEST(Coverage, FourCamerasHalveTheSquareOfTheErrorOfTwo) {
  std::vector<CameraConfig> cameras = pair(3, 2);
  const Rigid3 pose = head_at({0, 0, 0}, 0, kFourLeds);
  const double two_m = bound(cameras, kFourLeds, all_seen(), pose).eye_m;
  cameras.insert(cameras.end(), {cameras[0], cameras[1]});
  EXPECT_NEAR(two_m / bound(cameras, kFourLeds, all_seen(), pose).eye_m, std::sqrt(2), 1e-9);
}

// One camera that sees all, and a second that sees the LEDs of a mask.
PoseBound with_second_seeing(std::uint32_t mask, const HeadConfig& head,
                             std::uint32_t first = 0xf) {
  const DotNoise noise = [=](std::size_t led, const Vec3& viewer_in_head) {
    const std::uint32_t seen = viewer_in_head.x() < 0 ? first : mask;
    return seen >> led & 1 ? std::optional(0.5) : std::nullopt;
  };
  return bound(pair(3, 2), head, noise, head_at({0, 0, 0}, 0, head));
}

// One dot in each of two cameras, of two LEDs, fixes one angle beside the place.
TEST(Coverage, LevelIsThatOfTheTracker) {
  EXPECT_EQ(with_second_seeing(0b111, kThreeLeds).level, TrackingLevel::six_dof);
  EXPECT_EQ(with_second_seeing(0b001, kThreeLeds).level, TrackingLevel::six_dof);
  EXPECT_EQ(with_second_seeing(0b001, kThreeLeds, 0b011).level, TrackingLevel::hybrid);
  EXPECT_EQ(with_second_seeing(0b011, kThreeLeds, 0b011).level, TrackingLevel::hybrid);
  EXPECT_EQ(with_second_seeing(0b001, kThreeLeds, 0b001).level, TrackingLevel::position);
  EXPECT_EQ(with_second_seeing(0b010, kThreeLeds, 0b001).level, TrackingLevel::hybrid);
  EXPECT_EQ(with_second_seeing(0b000, kThreeLeds).level, TrackingLevel::hybrid);
  EXPECT_EQ(with_second_seeing(0b000, kThreeLeds, 0b001).level, TrackingLevel::bearing);
  EXPECT_EQ(with_second_seeing(0b000, kFourLeds).level, TrackingLevel::six_dof);
  EXPECT_EQ(with_second_seeing(0b000, kFourLeds, 0).level, TrackingLevel::lost);
}

TEST(Coverage, EachFurtherDotLowersTheBound) {
  double before_m = 0.1;
  for (const std::uint32_t mask : {0b000u, 0b001u, 0b011u, 0b111u, 0b1111u}) {
    const double eye_m = with_second_seeing(mask, kFourLeds).eye_m;
    EXPECT_LT(eye_m, before_m);
    before_m = eye_m;
  }
}

TEST(Coverage, LedsOnALineLeaveTheirAxisToMemory) {
  const HeadConfig line = {.leds_in_head = {{-0.09, 0, 0}, {0, 0, 0}, {0.05, 0, 0}, {0.09, 0, 0}},
                           .eye_in_head = {0, -0.1, -0.1}};
  const PoseBound found = bound(pair(3, 2), line, all_seen(), head_at({0, 0, 0}, 0, line));
  EXPECT_EQ(found.level, TrackingLevel::hybrid);
  EXPECT_GT(found.rotation_rad, 0.9 * kRememberedRotation_rad);
  EXPECT_LT(found.rotation_rad, 1.2 * kRememberedRotation_rad);
}

TEST(Coverage, NothingIsKnownOutsideThePicture) {
  const PoseBound found =
      bound(pair(3, 2), kFourLeds, all_seen(), head_at({5, 0, 0}, 0, kFourLeds));
  EXPECT_EQ(found.level, TrackingLevel::lost);
  EXPECT_FALSE(std::isfinite(found.eye_m));
}

TEST(Coverage, AWiimoteHasFourDotsAndAVideoCameraMore) {
  HeadConfig six = kFourLeds;
  six.leds_in_head.insert(six.leds_in_head.end(), {{0.05, -0.05, 0}, {-0.05, 0.05, 0}});
  CameraConfig camera = pair(3, 2).front();
  const Rigid3 pose = head_at({0, 0, 0}, 0, six);
  EXPECT_EQ(Onlooker(camera).look(six, pose, all_seen()).dots, 4);
  camera.source = CameraSource::video;
  camera.video.width_px = 1024, camera.video.height_px = 768;
  EXPECT_EQ(Onlooker(camera).look(six, pose, all_seen()).dots, 6);
}

TEST(Coverage, HeadStandsWithItsEyeAtThePlaceAndTurnsLeft) {
  const Rigid3 pose = head_at({1, 2, 3}, radians(90), kFourLeds);
  EXPECT_LT((pose * kFourLeds.eye_in_head - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * -Vec3::UnitZ() - Vec3(-1, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace vindu
