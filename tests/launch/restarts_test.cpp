// When a process is started again.
#include "cluster/launch/restarts.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using namespace std::chrono_literals;

TEST(Restarts, ComeLaterWithEveryYoungDeathAndThenNoMore) {
  Restarts restarts;
  EXPECT_EQ(restarts.after_death(1s), 200ms);
  EXPECT_EQ(restarts.after_death(1s), 400ms);
  EXPECT_EQ(restarts.after_death(1s), 800ms);
  EXPECT_EQ(restarts.after_death(1s), 1600ms);
  EXPECT_EQ(restarts.after_death(1s), std::nullopt);
  EXPECT_EQ(restarts.count(), 4);
}

TEST(Restarts, OfWhoLivesLongNeverEnd) {
  Restarts restarts;
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(restarts.after_death(10s), 200ms);
}

TEST(Restarts, StartAnewAfterALongLife) {
  Restarts restarts;
  for (int i = 0; i < 4; ++i) restarts.after_death(1s);
  EXPECT_EQ(restarts.after_death(1h), 200ms);
  EXPECT_EQ(restarts.after_death(1s), 400ms);
}

TEST(Restarts, NeverWaitLongerThanTheLongestDelay) {
  Restarts restarts({.longest_delay = 1s, .most_young_deaths = 100});
  std::optional<Duration> last;
  for (int i = 0; i < 99; ++i) last = restarts.after_death(0s);
  EXPECT_EQ(last, 1s);
}

}  // namespace
}  // namespace vindu
