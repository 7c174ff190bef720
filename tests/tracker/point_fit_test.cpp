// The motion that lays points upon others, and the turn that lays a direction upon another.
#include "tracker/point_fit.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"
#include "tests/core/matchers.h"
#include "tests/core/random_walls.h"

namespace vindu {
namespace {

using testing::IsNearPoint;
using testing::Random;

TEST(PointFit, FindsTheRotationAndTranslation) {
  const Rigid3 a_from_b{Quat(Eigen::AngleAxisd(2.0, Vec3(1, -2, 0.5).normalized())), {1, 2, 3}};
  const std::vector<Vec3> in_b = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  std::vector<Vec3> in_a;
  for (const Vec3& x : in_b) in_a.push_back(a_from_b * x);
  const PointFit fit = fit_points(in_a, in_b);
  EXPECT_LT((fit.rotation - a_from_b.rotation.toRotationMatrix()).norm(), 1e-12);
  EXPECT_LT(fit.rms, 1e-12);
  EXPECT_NEAR(fit.rotation.determinant(), 1, 1e-12);
}

TEST(PointFit, OfNoisyPointsIsTheBestOfThem) {
  const std::vector<Vec3> in_b = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const std::vector<Vec3> in_a = {{0, 0, 0.02}, {1, 0.01, 0}, {-0.01, 2, 0}, {0.02, 0, 3}};
  const PointFit fit = fit_points(in_a, in_b);
  const auto rms = [&](const Mat3& rotation, const Vec3& translation) {
    double sum2 = 0;
    for (std::size_t i = 0; i < in_a.size(); ++i)
      sum2 += (rotation * in_b[i] + translation - in_a[i]).squaredNorm();
    return std::sqrt(sum2 / 4);
  };
  EXPECT_NEAR(fit.rms, rms(fit.rotation, fit.translation), 1e-12);
  for (int axis = 0; axis < 3; ++axis)
    for (const double aside : {-1e-3, 1e-3}) {
      const Mat3 turn(Eigen::AngleAxisd(aside, Vec3::Unit(axis)));
      EXPECT_GT(rms(turn * fit.rotation, fit.translation), fit.rms);
      EXPECT_GT(rms(fit.rotation, fit.translation + aside * Vec3::Unit(axis)), fit.rms);
    }
}

TEST(PointFit, ReflectsWhenAskedAlone) {
  const std::vector<Vec3> in_b = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  std::vector<Vec3> mirrored;
  for (const Vec3& x : in_b) mirrored.emplace_back(-x.x(), x.y(), x.z());
  EXPECT_LT(fit_points(mirrored, in_b, true).rms, 1e-12);
  EXPECT_NEAR(fit_points(mirrored, in_b, true).rotation.determinant(), -1, 1e-12);
  EXPECT_GT(fit_points(mirrored, in_b).rms, 0.1);
  EXPECT_NEAR(fit_points(mirrored, in_b).rotation.determinant(), 1, 1e-12);
}

TEST(ExpectedError, IsThatOfPointsThatMoveByFitsOfNoisyPoints) {
  vindu::Random noise(8);
  const std::vector<Vec3> fitted = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0.5, 0}};
  for (const Vec3& point : {Vec3(1, 0.5, 0), Vec3(0, 2, 4), Vec3(-3, 0, 1)}) {
    constexpr int kFits = 4000;
    double off2 = 0, left2 = 0;
    for (int i = 0; i < kFits; ++i) {
      std::vector<Vec3> noisy = fitted;
      for (Vec3& each : noisy)
        each += Vec3(noise.normal(0.01), noise.normal(0.01), noise.normal(0.01));
      const PointFit fit = fit_points(fitted, noisy);
      off2 += (fit.rotation * point + fit.translation - point).squaredNorm() / kFits;
      left2 += fit.rms * fit.rms / kFits;
    }
    EXPECT_NEAR(expected_error(fitted, std::sqrt(left2), point), std::sqrt(off2),
                0.03 * std::sqrt(off2));
  }
}

TEST(LeastTurn, EndsWhereItShouldAndTurnsAboutNothingElse) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Vec3 from = random.vector(2), to = random.vector(2);
    const Quat turn = least_turn(from, to);
    EXPECT_THAT(turn * from.normalized(), IsNearPoint(to.normalized(), 1e-12));
    const Vec3 axis = from.cross(to);
    EXPECT_THAT(turn * axis, IsNearPoint(axis, 1e-12));
  }
}

TEST(LeastTurn, BetweenOppositesIsHalfATurn) {
  Random random(7);
  for (const double nearly : {0.0, 1e-15, 1e-9, 1e-7}) {
    const Vec3 from = random.vector(2);
    const Vec3 to = -from + nearly * from.unitOrthogonal();
    EXPECT_THAT(least_turn(from, to) * from.normalized(), IsNearPoint(to.normalized(), 1e-5));
    EXPECT_NEAR(least_turn(from, to).norm(), 1, 1e-12);
  }
}

TEST(LeastTurn, BetweenOneDirectionAndItselfIsNone) {
  EXPECT_THAT(least_turn(Vec3::UnitX(), 3 * Vec3::UnitX()) * Vec3::UnitY(),
              IsNearPoint(Vec3::UnitY(), 1e-15));
}

}  // namespace
}  // namespace vindu
