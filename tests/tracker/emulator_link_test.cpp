// The radio link of emulated Wiimotes, against the figures of the thesis' 5.3.
#include "tracker/wiimote/emulator_link.h"

#include <gmock/gmock.h>

#include <numeric>
#include <vector>

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr Duration kPeriod = std::chrono::microseconds(10250);  // of one Wiimote alone

struct Arrivals {
  std::vector<double> gaps_ms;
  double mean_ms = 0;
  int lost = 0;
};

Arrivals run_of(const LinkOptions& options, int reports) {
  EmulatedLink link(options, 1);
  Arrivals run;
  Time departure{}, first{}, last{};
  for (int i = 0; i < reports; ++i, departure += kPeriod) {
    const auto arrival = link.carry(departure, true);
    if (!arrival) ++run.lost;
    if (!arrival) continue;
    EXPECT_GE(*arrival, departure + options.delay);
    if (last == Time{}) first = *arrival;
    if (last != Time{}) run.gaps_ms.push_back(vindu::milliseconds(*arrival - last));
    EXPECT_GT(*arrival, last);
    last = *arrival;
  }
  run.mean_ms = vindu::milliseconds(last - first) / static_cast<double>(run.gaps_ms.size());
  return run;
}

auto share_between(const Arrivals& run, double low_ms, double high_ms) {
  const auto count = std::ranges::count_if(
      run.gaps_ms, [&](double gap) { return gap >= low_ms && gap < high_ms; });
  return static_cast<double>(count) / static_cast<double>(run.gaps_ms.size());
}

TEST(EmulatedLink, one_device_alone_arrives_evenly_and_whole) {
  const Arrivals run = run_of({}, 20000);
  EXPECT_EQ(run.lost, 0);
  EXPECT_NEAR(run.mean_ms, 10.25, 0.001);
  EXPECT_EQ(share_between(run, 9.7, 10.8), 1);
}

TEST(EmulatedLink, two_on_one_adapter_have_the_mean_that_the_thesis_measured) {
  const Arrivals run = run_of(two_on_one_adapter(), 20000);
  EXPECT_NEAR(run.mean_ms, 10.73, 0.25);  // 10.73 +- 0.25, 10.76 +- 0.23
}

TEST(EmulatedLink, two_on_one_adapter_come_in_bursts_as_in_table_5_1) {
  const Arrivals run = run_of(two_on_one_adapter(), 20000);
  // Of its 14 gaps three are of 21 to 28 ms, four of 0.6 to 2.2 ms, and one is of 5 ms.
  EXPECT_NEAR(share_between(run, 11.5, 100), 3.0 / 14, 0.08);
  EXPECT_NEAR(share_between(run, 0, 2.3), 4.0 / 14, 0.12);
  EXPECT_GT(share_between(run, 9.5, 11), 0.3);
  EXPECT_EQ(share_between(run, 0, 0.5), 0);
}

TEST(EmulatedLink, of_the_bad_kind_bursts_and_loses_one_report_in_twenty) {
  const Arrivals run = run_of(bad_link(), 20000);
  EXPECT_NEAR(run.lost, 1000, 120);
  EXPECT_GT(share_between(run, 15, 100), 0.1);
}

TEST(EmulatedLink, loses_the_given_share_of_data_reports_and_no_answers) {
  LinkOptions options;
  options.loss = 0.05;
  EXPECT_NEAR(run_of(options, 20000).lost, 1000, 120);
  options.loss = 1;
  EmulatedLink link(options, 1);
  EXPECT_FALSE(link.carry(Time{}, true));
  EXPECT_TRUE(link.carry(Time{milliseconds(1)}, false));
}

TEST(EmulatedLink, repeats_itself_with_one_seed) {
  const Arrivals first = run_of(two_on_one_adapter(), 500),
                 again = run_of(two_on_one_adapter(), 500);
  EXPECT_EQ(first.gaps_ms, again.gaps_ms);
}

}  // namespace
}  // namespace vindu
