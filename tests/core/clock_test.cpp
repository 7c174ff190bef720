// The clock seam and the conversions of durations.
#include "core/clock.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TEST(Clock, ManualTimeMovesOnlyWhenSomebodyWaits) {
  ManualClock clock;
  EXPECT_EQ(clock.now(), Time{});

  clock.sleep_until(Time{} + milliseconds(16));

  EXPECT_EQ(clock.now(), Time{} + milliseconds(16));
  EXPECT_EQ(clock.now(), Time{} + milliseconds(16));
}

}  // namespace
}  // namespace vindu
