// The swap group against tables of functions such as drivers give; no hardware here has them.
#include "renderer/swap_group.h"

#include <gmock/gmock.h>

#include <thread>
#include <vector>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A driver that notes what it is asked.
struct Driver {
  unsigned groups = 1, barriers = 1;
  bool joins = true, binds = true;
  std::vector<std::string> asked{};
  std::vector<std::thread::id> threads{};

  SwapGroupCalls calls() {
    return {
        .query_max =
            [this](unsigned& most_groups, unsigned& most_barriers) {
              most_groups = groups;
              most_barriers = barriers;
              return true;
            },
        .join =
            [this](unsigned group) {
              asked.push_back("join " + std::to_string(group));
              threads.push_back(std::this_thread::get_id());
              return joins;
            },
        .bind =
            [this](unsigned group, unsigned barrier) {
              asked.push_back("bind " + std::to_string(group) + " to " + std::to_string(barrier));
              threads.push_back(std::this_thread::get_id());
              return binds;
            }};
  }
};

TEST(SwapGroup, JoinsThenBindsOnTheThreadThatAsks) {
  Driver driver;
  const SwapGroupState state = join_swap_group(driver.calls());
  EXPECT_TRUE(state.joined && state.bound);
  EXPECT_THAT(driver.asked, ElementsAre("join 1", "bind 1 to 1"));
  EXPECT_THAT(driver.threads, ::testing::Each(std::this_thread::get_id()));
}

TEST(SwapGroup, SaysThatTheDriverHasNone) {
  const SwapGroupState state = join_swap_group({});
  EXPECT_FALSE(state.joined || state.bound);
  EXPECT_THAT(state.text, HasSubstr("GLX_NV_swap_group"));
}

TEST(SwapGroup, AsksNothingOfACardThatHasNoGroups) {
  Driver driver{.groups = 0};
  EXPECT_FALSE(join_swap_group(driver.calls()).joined);
  EXPECT_THAT(driver.asked, IsEmpty());
}

TEST(SwapGroup, JoinsAloneWithoutASyncBoard) {
  Driver driver{.barriers = 0};
  const SwapGroupState state = join_swap_group(driver.calls());
  EXPECT_TRUE(state.joined);
  EXPECT_FALSE(state.bound);
  EXPECT_THAT(driver.asked, ElementsAre("join 1"));
  EXPECT_THAT(state.text, HasSubstr("no sync board"));
}

TEST(SwapGroup, SaysWhatTheDriverRefuses) {
  Driver window{.joins = false}, barrier{.binds = false};
  EXPECT_FALSE(join_swap_group(window.calls()).joined);
  EXPECT_THAT(window.asked, ElementsAre("join 1"));
  const SwapGroupState state = join_swap_group(barrier.calls());
  EXPECT_TRUE(state.joined);
  EXPECT_FALSE(state.bound);
}

}  // namespace
}  // namespace vindu
