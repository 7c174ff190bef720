// The radio link of emulated Wiimotes, against the figures of the thesis' 5.3.
#include "tracker/wiimote/emulator_link.h"

#include <gmock/gmock.h>

#include <algorithm>
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

LinkOptions two_without_loss() {
  LinkOptions options = two_on_one_adapter();
  options.loss = 0;
  return options;
}

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

LinkOptions sharing(int place, int of) {
  LinkOptions options = two_without_loss();
  options.shared = AdapterShare{.place = place, .of = of, .seed = 7, .begin = Time{}};
  return options;
}

/// When it was served again after each pause.
std::vector<Time> served_again(const LinkOptions& options, std::uint64_t seed) {
  EmulatedLink link(options, seed);
  std::vector<Time> ends;
  Time last = link.carry(Time{}, true).value();
  for (int i = 1; i < 5000; ++i) {
    const Time arrival = link.carry(Time{i * kPeriod}, true).value();
    if (arrival - last > milliseconds(15)) ends.push_back(arrival);
    last = arrival;
  }
  return ends;
}

/// Whether there is one of the others between any two.
bool alternate(const std::vector<Time>& ends, const std::vector<Time>& others) {
  for (std::size_t i = 1; i < ends.size() && ends[i] < others.back(); ++i)
    if (std::ranges::upper_bound(others, ends[i]) - std::ranges::upper_bound(others, ends[i - 1]) !=
        1)
      return false;
  return ends.size() > 500;
}

TEST(EmulatedLink, of_two_on_one_adapter_pauses_while_the_other_is_served) {
  const auto first = served_again(sharing(0, 2), 1), second = served_again(sharing(1, 2), 2);
  EXPECT_TRUE(alternate(first, second));
  EXPECT_TRUE(alternate(second, first));
  EXPECT_FALSE(alternate(served_again(two_without_loss(), 1), served_again(two_without_loss(), 2)))
      << "links that know nothing of each other";
}

TEST(EmulatedLink, of_two_on_one_adapter_has_the_bursts_of_table_5_1_in_turn_too) {
  const Arrivals run = run_of(sharing(0, 2), 20000);
  EXPECT_NEAR(run.mean_ms, 10.25, 0.01);
  EXPECT_NEAR(share_between(run, 11.5, 100), 3.0 / 14, 0.08);
  EXPECT_NEAR(share_between(run, 0, 2.3), 4.0 / 14, 0.12);
}

TEST(EmulatedLink, of_three_on_one_adapter_waits_longer_than_of_two) {
  EXPECT_GT(share_between(run_of(sharing(0, 3), 20000), 11.5, 100),
            share_between(run_of(sharing(0, 2), 20000), 11.5, 100));
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
