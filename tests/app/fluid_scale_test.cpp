// How many pixels vindu simulate draws on a machine of unknown speed.
#include "app/fluid_scale.h"

#include <gmock/gmock.h>

#include <vector>

namespace vindu::app {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Le;

constexpr double kBudget_s = 0.010;

/// A machine on which a frame of all pixels takes `pixels_s`, and its triangles `triangles_s`.
auto machine(double triangles_s, double pixels_s) {
  return [=](double scale) { return triangles_s + pixels_s * scale * scale; };
}

TEST(FluidScale, SpendsTheBudgetOnPixels) {
  for (const double pixels_s : {0.05, 0.5, 2.0}) {
    const auto slow = machine(0.002, pixels_s);
    EXPECT_THAT(slow(fluid_scale(slow, kBudget_s)), DoubleNear(kBudget_s, 1e-9));
  }
}

TEST(FluidScale, IsOneOnAFastMachine) {
  EXPECT_EQ(fluid_scale(machine(0.001, 0.002), kBudget_s), 1);
}

TEST(FluidScale, IsTheLeastWhereNotEvenThatFits) {
  EXPECT_THAT(fluid_scale(machine(0, 100), kBudget_s), Le(0.05));
}

TEST(FluidScale, GivesPixelsAFifthOfWhatTooManyTrianglesTake) {
  const auto heavy = machine(0.100, 0.2);
  EXPECT_THAT(heavy(fluid_scale(heavy, kBudget_s)), DoubleNear(0.120, 0.001));
}

TEST(FluidScale, NeverTriesMoreThanFourTimesThePixelsThatFitted) {
  std::vector<double> tried;
  fluid_scale(
      [&](double scale) {
        tried.push_back(scale);
        return machine(0, 0.5)(scale);
      },
      kBudget_s);
  EXPECT_THAT(tried,
              ElementsAre(DoubleNear(0.04, 1e-9), DoubleNear(0.08, 1e-9), DoubleNear(0.16, 1e-9)));
}

// Something else ran meanwhile: the smallest picture took longer than larger ones.
TEST(FluidScale, IsNotLedAstrayByAHiccup) {
  for (const double hiccup_at : {0.04, 0.08, 0.16}) {
    const auto slow = machine(0.002, 0.5);
    const auto disturbed = [&](double scale) {
      return slow(scale) + (std::abs(scale - hiccup_at) < 1e-9 ? 0.300 : 0);
    };
    EXPECT_THAT(slow(fluid_scale(disturbed, kBudget_s)), Le(kBudget_s + 1e-9)) << hiccup_at;
  }
}

}  // namespace
}  // namespace vindu::app
