// Work that cores share: all of it is done, once, and what fails is heard of.
#include "core/parallel.h"

#include <gmock/gmock.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace vindu {
namespace {

TEST(Parallel, DoesEachItemOnce) {
  std::vector<int> done(1000);
  for_each_in_parallel(done.size(), [&](std::size_t i) { ++done[i]; });
  EXPECT_THAT(done, ::testing::Each(1));
}

TEST(Parallel, DoesNothingWhereThereIsNothing) {
  for_each_in_parallel(0, [](std::size_t) { FAIL(); });
}

TEST(Parallel, UsesNoMoreThreadsThanAllowed) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  const auto work = [&](std::size_t) {
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  };
  for_each_in_parallel(500, work, 1);
  EXPECT_THAT(threads, ::testing::ElementsAre(std::this_thread::get_id()));
  for_each_in_parallel(500, work, 3);
  EXPECT_LE(threads.size(), 3u);
}

TEST(Parallel, StopsAtAnExceptionAndThrowsIt) {
  std::atomic<int> begun = 0;
  const auto work = [&](std::size_t i) {
    ++begun;
    if (i == 20) throw std::runtime_error("the twentieth");
  };
  EXPECT_THAT([&] { for_each_in_parallel(1'000'000, work); },
              ::testing::ThrowsMessage<std::runtime_error>("the twentieth"));
  EXPECT_LT(begun, 1'000'000);
}

}  // namespace
}  // namespace vindu
