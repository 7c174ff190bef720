// The spread of a run's figures: exact while there are few, near it for millions, and never larger
// in memory.
#include "app/run_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vindu::app {
namespace {

TEST(RunSpread, IsThatOfAllValuesOfAShortRun) {
  RunSpread spread;
  EXPECT_TRUE(spread.empty());
  std::vector<double> values;
  for (int i = 0; i < 10'000; ++i) {
    values.push_back(std::fmod(i * 7.31, 100));
    spread.add(values.back());
  }
  EXPECT_FALSE(spread.empty());
  EXPECT_EQ(spread.quantiles(), quantiles_of(values));
}

TEST(RunSpread, IsNearThatOfALongRunAndKnowsItsLargest) {
  RunSpread spread;
  std::vector<double> values;
  for (int i = 0; i < 1'000'000; ++i) {
    values.push_back(i == 777'777 ? 1000 : std::fmod(i * 0.6180339887, 1) * (i < 500'000 ? 1 : 3));
    spread.add(values.back());
  }
  const Quantiles all = quantiles_of(values), kept = spread.quantiles();
  EXPECT_NEAR(kept.p50, all.p50, 0.02 * all.p50);
  EXPECT_NEAR(kept.p99, all.p99, 0.02 * all.p99);
  EXPECT_EQ(kept.max, 1000);
}

TEST(RunSpread, OfNegativeValuesHasNoLargestOfZero) {
  RunSpread spread;
  for (const double value : {-3.0, -2.0, -5.0}) spread.add(value);
  EXPECT_EQ(spread.quantiles().max, -2);
}

}  // namespace
}  // namespace vindu::app
