// Offset and drift of another host's clock, from round trips through a network that delays.
#include "cluster/clock_offset.h"

#include <gtest/gtest.h>

#include <random>

namespace vindu {
namespace {

Time at(double time_s) { return Time(from_seconds(time_s)); }

/// Sixty trips a second; the clock there is ahead and runs faster, each way takes its own time.
class Host {
 public:
  Host(double offset_s, double drift_ppm) : offset_s_(offset_s), drift_ppm_(drift_ppm) {}

  double offset_s(double here_s) const { return offset_s_ + 1e-6 * drift_ppm_ * here_s; }
  RoundTrip trip(double here_s) {
    std::exponential_distribution<double> delay_s(1 / 300e-6);
    const double received_s = here_s + 50e-6 + delay_s(random_);
    const double answered_s = received_s + 0.01;
    const double back_s = answered_s + 50e-6 + delay_s(random_);
    return {at(here_s), at(received_s + offset_s(received_s)),
            at(answered_s + offset_s(answered_s)), at(back_s)};
  }

 private:
  double offset_s_, drift_ppm_;
  std::mt19937_64 random_{7};
};

TEST(ClockOffset, IsUnknownBeforeTheFirstTrip) { EXPECT_FALSE(ClockOffset().at(at(1))); }

TEST(ClockOffset, IsNeverFurtherOffThanItSays) {
  Host host(12.5, 0);
  ClockOffset clock;
  for (int i = 0; i < 600; ++i) {
    const double now_s = i / 60.0;
    clock.add(host.trip(now_s));
    const auto estimate = clock.at(at(now_s));
    ASSERT_TRUE(estimate);
    EXPECT_LE(std::abs(seconds(estimate->offset) - host.offset_s(now_s)),
              seconds(estimate->uncertainty) + 1e-9);
  }
  EXPECT_LT(seconds(clock.at(at(10))->uncertainty), 200e-6);
}

TEST(ClockOffset, FollowsADriftingClock) {
  Host host(-3, 40);
  ClockOffset clock;
  for (int i = 0; i < 60 * 120; ++i) clock.add(host.trip(i / 60.0));
  const auto estimate = clock.at(at(120));
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->drift_ppm, 40, 1);
  EXPECT_NEAR(seconds(estimate->offset), host.offset_s(120), 50e-6);
}

TEST(ClockOffset, LeavesOutWhatMakesNoSense) {
  ClockOffset clock;
  clock.add({at(1), at(5), at(4), at(2)});      // answered before it arrived
  clock.add({at(1), at(5), at(5.5), at(1.2)});  // away for less than it was held
  EXPECT_FALSE(clock.at(at(2)));
}

}  // namespace
}  // namespace vindu
