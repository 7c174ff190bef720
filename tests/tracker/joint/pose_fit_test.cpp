// The joint pose fit: its derivatives, its exactness against the bound, and what fewer dots leave.
#include "tracker/joint/pose_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <unsupported/Eigen/AutoDiff>

#include "tests/tracker/joint/scene.h"

namespace vindu {
namespace {

using namespace test;

TEST(RotationVector, is_undone_by_its_inverse_and_turns_as_eigen_does) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 vector(random.uniform(-1.8, 1.8), random.uniform(-1.8, 1.8),
                      random.uniform(-1.8, 1.8));
    const Quat rotation = rotation_of(vector);
    EXPECT_LT((vector_of(rotation) - vector).norm(), 1e-12);
    EXPECT_LT(rotation.angularDistance(Quat(Eigen::AngleAxisd(vector.norm(), vector.normalized()))),
              1e-7);
  }
  EXPECT_EQ(vector_of(rotation_of(Vec3::Zero())), Vec3::Zero());
}

TEST(RotationVector, changes_by_the_inverse_left_jacobian) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 vector(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5),
                      random.uniform(-1.5, 1.5));
    const Mat3 jacobian = inverse_left_jacobian(vector);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-6;
      const Vec3 step = kStep * Vec3::Unit(axis);
      const Vec3 slope = (vector_of(rotation_of(step) * rotation_of(vector)) -
                          vector_of(rotation_of(-step) * rotation_of(vector))) /
                         (2 * kStep);
      EXPECT_LT((slope - jacobian.col(axis)).norm(), 1e-8);
    }
  }
}

/// The undistorted pinhole of a Wiimote, for numbers that carry six derivatives.
using Scalar = Eigen::AutoDiffScalar<Eigen::Matrix<double, 6, 1>>;
using Vec3s = Eigen::Matrix<Scalar, 3, 1>;

Eigen::Matrix<Scalar, 2, 1> dot_by_autodiff(const CameraModel& camera, const Rigid3& head,
                                            const Vec3& led) {
  Vec3s shift, turn;
  for (int i = 0; i < 3; ++i) {
    shift(i) = Scalar(0, 6, i);
    turn(i) = Scalar(0, 6, 3 + i);
  }
  const Vec3 arm = head.rotation * led;
  const Vec3s arm_s = arm.cast<Scalar>();
  const Vec3s in_room = arm_s + turn.cross(arm_s) + head.translation.cast<Scalar>() + shift;
  const Rigid3& camera_from_room = camera.camera_from_room();
  const Vec3s x = camera_from_room.rotation.toRotationMatrix().cast<Scalar>() * in_room +
                  camera_from_room.translation.cast<Scalar>();
  const Intrinsics wiimote;
  return {x(0) / x(2) * wiimote.fx_px + wiimote.cx_px,
          Scalar(kWiimoteHeight_px - 1) - (x(1) / x(2) * wiimote.fy_px + wiimote.cy_px)};
}

TEST(DotOfLed, has_the_derivatives_of_automatic_differentiation) {
  const auto cameras = cameras_behind(3);
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 head = random_head(random);
    for (const CameraModel& camera : cameras)
      for (const Vec3& led : kFourLeds) {
        const auto dot = dot_of_led(camera, head, led);
        ASSERT_TRUE(dot);
        const auto expected = dot_by_autodiff(camera, head, led);
        for (int row = 0; row < 2; ++row) {
          EXPECT_NEAR(dot->raw_px(row), expected(row).value(), 1e-9);
          EXPECT_LT((dot->d_raw_d_pose.row(row).transpose() - expected(row).derivatives()).norm(),
                    1e-9);
        }
      }
  }
}

TEST(PoseFit, finds_the_head_from_dots_without_noise) {
  const auto cameras = cameras_behind(2);
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 head = random_head(random);
    const auto views = views_of(cameras, head, kThreeLeds, 0, random);
    const Rigid3 start = random_head(random);
    const auto fit = fit_pose(cameras, sightings_of(views, kThreeLeds, 0.5), start);
    ASSERT_TRUE(fit);
    EXPECT_LT((fit->room_from_head.translation - head.translation).norm(), 1e-6);
    EXPECT_LT(angle_deg(fit->room_from_head, head), 1e-3);
    EXPECT_LT(fit->rms_px, 1e-5);
  }
}

// Normalised error squared: its mean over many heads is the number of unknowns, 6, with a standard
// error of sqrt(12 / 2000) = 0.08.
TEST(PoseFit, errs_by_what_its_covariance_says) {
  const auto cameras = cameras_behind(2);
  Random random(5);
  double sum = 0;
  constexpr int kHeads = 2000;
  for (int i = 0; i < kHeads; ++i) {
    const Rigid3 head = random_head(random);
    const auto views = views_of(cameras, head, kFourLeds, 0.5, random);
    const auto fit =
        fit_pose(cameras, sightings_of(views, kFourLeds, 0.5), head, {}, {.huber_sigmas = 1e6});
    ASSERT_TRUE(fit);
    Eigen::Matrix<double, 6, 1> error;
    error << fit->room_from_head.translation - head.translation,
        vector_of(fit->room_from_head.rotation * head.rotation.conjugate());
    sum += error.dot(fit->information * error);
  }
  EXPECT_NEAR(sum / kHeads, 6, 0.4);
}

TEST(PoseFit, shrugs_off_one_false_dot) {
  const auto cameras = cameras_behind(2);
  Random random(6);
  const Rigid3 head = random_head(random);
  auto views = views_of(cameras, head, kFourLeds, 0.3, random);
  views[0].dots_px[1] += Vec2(25, -18);
  const auto sightings = sightings_of(views, kFourLeds, 0.5);
  const auto robust = fit_pose(cameras, sightings, head);
  const auto plain = fit_pose(cameras, sightings, head, {}, {.huber_sigmas = 1e6});
  ASSERT_TRUE(robust && plain);
  const auto error_m = [&](const PoseFit& fit) {
    return (fit.room_from_head.translation - head.translation).norm();
  };
  EXPECT_LT(error_m(*robust), 0.010);
  EXPECT_GT(error_m(*plain), 2 * error_m(*robust));
}

TEST(PoseFit, keeps_to_the_prior_where_dots_say_nothing) {
  const auto cameras = cameras_behind(1);
  const Rigid3 head{Quat::Identity(), {0, 1.65, 2}};
  PosePrior prior{.room_from_head = {Quat::Identity(), {0, 1.65, 2.2}}};
  prior.information.diagonal() << 25, 25, 25, 100, 100, 100;
  const std::vector<LedSighting> one = {
      {0, kThreeLeds[1], dot_of(cameras[0], head, kThreeLeds[1]), 0.5}};
  const auto fit = fit_pose(cameras, one, prior.room_from_head, prior);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->room_from_head.translation.z(), 2.2, 0.03);  // depth is the prior's
  EXPECT_LT((dot_of(cameras[0], fit->room_from_head, kThreeLeds[1]) - one[0].raw_px).norm(), 0.1);
  EXPECT_LT(angle_deg(fit->room_from_head, prior.room_from_head), 1);
}

TEST(PoseFit, is_none_without_dots_or_with_leds_behind_the_camera) {
  const auto cameras = cameras_behind(2);
  EXPECT_FALSE(fit_pose(cameras, {}, {}));
  const Rigid3 behind{Quat::Identity(), {0, 1.65, 9}};
  const std::vector<LedSighting> one = {{0, {0, 0, 0}, {500, 400}, 0.5}};
  EXPECT_FALSE(fit_pose(cameras, one, behind));
}

TEST(Level, falls_with_what_the_cameras_see) {
  const auto cameras = cameras_behind(2);
  const Rigid3 head{Quat::Identity(), {0, 1.65, 2}};
  const auto level_for = [&](std::vector<std::vector<std::size_t>> leds_of_cameras) {
    Mat6 information = Mat6::Zero();
    for (std::size_t camera = 0; camera < leds_of_cameras.size(); ++camera)
      for (const std::size_t led : leds_of_cameras[camera]) {
        const auto dot = dot_of_led(cameras[camera], head, kThreeLeds[led]);
        information += dot->d_raw_d_pose.transpose() * dot->d_raw_d_pose / 0.36;
      }
    return level_of(information);
  };
  EXPECT_EQ(level_for({{0, 1, 2}, {0, 1, 2}}), TrackingLevel::six_dof);
  EXPECT_EQ(level_for({{0, 1}, {1, 2}}), TrackingLevel::six_dof);  // the thesis' hybrid is enough
  EXPECT_EQ(level_for({{0, 1}, {0, 1}}), TrackingLevel::hybrid);
  EXPECT_EQ(level_for({{1}, {1}}), TrackingLevel::position);
  EXPECT_EQ(level_for({{1}}), TrackingLevel::bearing);
  EXPECT_EQ(level_for({}), TrackingLevel::lost);
}

}  // namespace
}  // namespace vindu
