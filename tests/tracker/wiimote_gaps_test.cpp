// What is a gap in a stream, why it was there, and which halves of the full format are one sample.
#include "tracker/wiimote/gaps.h"

#include <gtest/gtest.h>

#include "tracker/wiimote/halves.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Time moment(int ms) { return Time{} + seconds(1) + milliseconds(ms); }

std::uint64_t gaps_of(const GapCounts& counts) {
  std::uint64_t gaps = 0;
  for (const GapCount& count : counts) gaps += count.gaps;
  return gaps;
}

/// The gaps of two samples so far apart, of a stream of this period.
std::string gap_between(int ms, Duration period, bool explained) {
  GapCounter counter(period);
  counter.sample(moment(0));
  if (explained) counter.suspect(GapCause::camera, moment(0));
  counter.sample(moment(ms));
  return text_of(counter.counts(moment(ms)));
}

TEST(GapCounter, MeasuresByTheStreamsOwnPeriod) {
  constexpr Duration kTen = milliseconds(10), kTwenty = milliseconds(20);
  EXPECT_EQ(gap_between(20, kTen, true), "1 camera (20 ms)");
  EXPECT_EQ(gap_between(20, kTwenty, true), "none");
  EXPECT_EQ(gap_between(40, kTwenty, true), "1 camera (40 ms)");
  EXPECT_EQ(gap_between(40, kTen, false), "1 late (40 ms)");
  EXPECT_EQ(gap_between(40, kTwenty, false), "none");
  EXPECT_EQ(gap_between(70, kTwenty, false), "1 late (70 ms)");
}

TEST(GapCounter, CountsTheOpenGapAndTellsEachThatEndedOnce) {
  GapCounter counter(milliseconds(10));
  counter.expect(moment(0));
  EXPECT_EQ(gaps_of(counter.counts(moment(20))), 0u);
  EXPECT_EQ(text_of(counter.counts(moment(15000))), "1 late (15 s)");
  EXPECT_FALSE(counter.take_closed());
  counter.sample(moment(15000));
  const auto gap = counter.take_closed();
  ASSERT_TRUE(gap);
  EXPECT_EQ(text_of(*gap), "gap of 15 s: late");
  EXPECT_FALSE(counter.take_closed());
  counter.sample(moment(15050));
  EXPECT_EQ(text_of(counter.counts(moment(15050))), "2 late (longest 15 s, in all 15 s)");
}

/// The half of this sample, told from others by its acceleration.
HalfReport half(bool second, int sample) {
  return {.second = second, .acceleration_raw = sample, .slots = {}};
}

/// Half periods are 10 ms. Which sample's first and second half were joined, as 100 n + n.
class Halves {
 public:
  Halves& first(int sample, int ms) { return take(half(false, sample), ms); }
  Halves& second(int sample, int ms) { return take(half(true, sample), ms); }
  Halves& interrupted() { return joiner_.interrupt(), *this; }
  const std::vector<int>& joined() const { return joined_; }
  std::uint64_t lone() const { return joiner_.lone(); }

 private:
  Halves& take(const HalfReport& report, int ms) {
    if (const auto sample = joiner_.take(report, moment(ms)))
      joined_.push_back(100 * (*sample->acceleration_raw)[0] + (*sample->acceleration_raw)[1]);
    return *this;
  }

  HalfJoiner joiner_;
  std::vector<int> joined_;
};

using Joined = std::vector<int>;

TEST(HalfJoiner, JoinsTheHalvesOfEachSampleAlsoThroughABurst) {
  Halves halves;
  halves.first(1, 0).second(1, 10).first(2, 20).second(2, 47).first(3, 48).second(3, 50);
  EXPECT_EQ(halves.joined(), (Joined{101, 202, 303}));
  EXPECT_EQ(halves.lone(), 0u);
}

TEST(HalfJoiner, LeavesOutHalvesWhoseOtherIsLost) {
  Halves halves;
  halves.first(1, 0).first(2, 20).second(2, 30).second(3, 50).first(4, 60).second(4, 70);
  EXPECT_EQ(halves.joined(), (Joined{202, 404}));
  EXPECT_EQ(halves.lone(), 2u);
}

TEST(HalfJoiner, DoesNotJoinHalvesOfDifferentSamples) {
  for (const int later : {30, 50, 70}) {  // the seconds of the samples that follow
    Halves halves;
    halves.first(1, 0).second(2, later);
    EXPECT_EQ(halves.joined(), Joined{}) << later;
    EXPECT_EQ(halves.lone(), 2u) << later;
  }
}

TEST(HalfJoiner, LeavesOutHalvesThatCameInTheWrongOrder) {
  Halves halves;
  halves.first(1, 0).second(1, 10).second(2, 20).first(2, 30).first(3, 40).second(3, 50);
  EXPECT_EQ(halves.joined(), (Joined{101, 303}));
  EXPECT_EQ(halves.lone(), 2u);
}

TEST(HalfJoiner, BeginsAnewWhenTheStreamDoes) {
  Halves halves;
  halves.first(1, 0).interrupted().second(2, 10);
  EXPECT_EQ(halves.joined(), Joined{});
  EXPECT_EQ(halves.lone(), 2u);
}

}  // namespace
}  // namespace vindu
