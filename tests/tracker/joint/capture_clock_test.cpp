// Times of capture from arrivals alone, on the emulated radio link, against the true ones.
#include "tracker/joint/capture_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tracker/wiimote/emulator_link.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

struct Stamped {
  double error_s = 0;
  double sigma_s = 0;
  double late_s = 0;  ///< what the arrival is later than the earliest one
};

/// `seconds` of reports that leave a device each period, the first three without.
std::vector<Stamped> stamped(const LinkOptions& link_options, double period_s, double length_s,
                             std::uint64_t seed, CaptureClock& clock) {
  EmulatedLink link(link_options, seed);
  std::vector<Stamped> all;
  for (int k = 0; k * period_s < length_s; ++k) {
    const Time captured{from_seconds(k * period_s + 0.0031)};
    const auto arrival = link.carry(captured, true);
    if (!arrival) continue;
    const CaptureTime time = clock.capture_of(*arrival);
    if (k * period_s < 3) continue;
    all.push_back({seconds(time.time - captured), seconds(time.sigma),
                   seconds(*arrival - captured - link_options.delay)});
  }
  return all;
}

double rms_ms(const std::vector<Stamped>& all, double Stamped::*part) {
  double sum = 0;
  for (const Stamped& one : all) sum += std::pow(1e3 * one.*part, 2);
  return std::sqrt(sum / static_cast<double>(all.size()));
}

TEST(CaptureClock, is_exact_where_reports_come_at_once) {
  CaptureClock clock(milliseconds(6));
  const auto all = stamped({}, 0.010, 20, 1, clock);
  EXPECT_LT(rms_ms(all, &Stamped::error_s), 0.05);
  EXPECT_NEAR(1e3 * seconds(clock.period()), 10, 0.005);
}

TEST(CaptureClock, sees_through_the_bursts_of_two_wiimotes_on_one_adapter) {
  LinkOptions link = two_on_one_adapter();
  link.loss = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CaptureClock clock(milliseconds(6));
    const auto all = stamped(link, 0.010, 60, seed, clock);
    EXPECT_GT(rms_ms(all, &Stamped::late_s), 5);
    EXPECT_LT(rms_ms(all, &Stamped::error_s), 0.6) << "seed " << seed;
  }
}

TEST(CaptureClock, says_how_unsure_it_is_where_reports_are_lost_in_bursts) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CaptureClock clock(milliseconds(6));
    const auto all = stamped(two_on_one_adapter(), 0.010, 60, seed, clock);
    EXPECT_LT(rms_ms(all, &Stamped::error_s), 0.5 * rms_ms(all, &Stamped::late_s));
    double normalised = 0;
    for (const Stamped& one : all)
      normalised += std::pow(one.error_s / one.sigma_s, 2) / static_cast<double>(all.size());
    EXPECT_LT(normalised, 3) << "seed " << seed;
  }
}

TEST(CaptureClock, follows_losses_on_a_link_without_bursts) {
  LinkOptions link;
  link.loss = 0.05;
  CaptureClock clock(milliseconds(6));
  const auto all = stamped(link, 0.010, 60, 2, clock);
  const auto wrong = std::ranges::count_if(all, [](const Stamped& one) {
    return std::abs(one.error_s) > 2e-3 && std::abs(one.error_s) > 4 * one.sigma_s;
  });
  EXPECT_LT(static_cast<double>(wrong), 0.002 * static_cast<double>(all.size()));
}

TEST(CaptureClock, finds_the_lattice_again_after_a_silence) {
  CaptureClock clock(milliseconds(6));
  EmulatedLink link({}, 3);
  double worst_s = 0;
  for (int k = 0; k < 3000; ++k) {
    // Half-way the device is away for two seconds and comes back out of step.
    const double captured_s = k * 0.010 + (k < 1500 ? 0 : 2.0043);
    const auto arrival = link.carry(Time{from_seconds(captured_s)}, true);
    const CaptureTime time = clock.capture_of(*arrival);
    if (k > 300 && (k < 1500 || k > 1600))
      worst_s = std::max(worst_s, std::abs(seconds(time.time.time_since_epoch()) - captured_s));
  }
  EXPECT_LT(worst_s, 1e-3);
}

TEST(CaptureClock, gives_arrivals_where_there_is_no_lattice) {
  CaptureClock clock(milliseconds(6));
  Random random(4);
  Time arrival{};
  for (int k = 0; k < 2000; ++k) {
    arrival += from_seconds(random.uniform(0.0005, 0.030));
    const CaptureTime time = clock.capture_of(arrival);
    EXPECT_LE(time.time, arrival - milliseconds(6));
    EXPECT_GT(time.time, arrival - milliseconds(70));
    EXPECT_GT(time.sigma, Duration::zero());
  }
}

}  // namespace
}  // namespace vindu
