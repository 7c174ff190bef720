// The clock seam and the conversions of durations.
#include "core/clock.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

using std::chrono::nanoseconds;
using Ms = std::chrono::milliseconds;

TEST(ManualClock, MovesOnlyWhenSomebodyWaits) {
  ManualClock clock;
  EXPECT_EQ(clock.now(), Time{});

  clock.sleep_until(Time{} + Ms(16));

  EXPECT_EQ(clock.now(), Time{} + Ms(16));
  EXPECT_EQ(clock.now(), Time{} + Ms(16));
}

TEST(ManualClock, NeverGoesBack) {
  ManualClock clock;
  clock.sleep_until(Time{} + Ms(16));

  clock.sleep_until(Time{} + Ms(5));

  EXPECT_EQ(clock.now(), Time{} + Ms(16));
}

TEST(MonotonicClock, WaitsAtLeastUntilTheTimeAndNotForOneThatHasPassed) {
  MonotonicClock clock;
  const Time start = clock.now();

  clock.sleep_until(start - std::chrono::hours(1));
  clock.sleep_until(start + Ms(2));

  EXPECT_GE(clock.now(), start + Ms(2));
}

TEST(Duration, OfSecondsIsTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(1.0 / 60), nanoseconds(16'666'667));
  EXPECT_EQ(from_seconds(-1.0 / 60), nanoseconds(-16'666'667));
  EXPECT_EQ(from_seconds(0.29), nanoseconds(290'000'000));
}

TEST(Duration, SurvivesTheWayToSecondsAndBack) {
  for (const std::int64_t count : {0LL, 1LL, -1LL, 999'999'999LL, 86'400'000'000'001LL})
    EXPECT_EQ(from_seconds(seconds(nanoseconds(count))), nanoseconds(count));
}

TEST(Duration, ReadsAsSecondsOrMilliseconds) {
  EXPECT_DOUBLE_EQ(seconds(Ms(1500)), 1.5);
  EXPECT_DOUBLE_EQ(milliseconds(nanoseconds(2'500'000)), 2.5);
}

}  // namespace
}  // namespace vindu
