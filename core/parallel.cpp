#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace vindu {
namespace {

class SharedWork {
 public:
  SharedWork(std::size_t count, const std::function<void(std::size_t)>& work)
      : count_(count), work_(work) {}

  /// Of one thread: one item after the other, until none is left.
  void take_part() {
    for (std::size_t i = next_++; i < count_; i = next_++) try {
        work_(i);
      } catch (...) {
        next_ = count_;
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
      }
  }
  /// After all threads have ended.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

void for_each_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work,
                          std::size_t most_threads) {
  SharedWork shared(count, work);
  const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1u);
  {
    std::vector<std::jthread> others;
    try {
      while (others.size() + 1 < std::min({cores, most_threads, count}))
        others.emplace_back([&] { shared.take_part(); });
    } catch (const std::system_error&) {
      // The machine gives no more threads: those that are there do it.
    }
    shared.take_part();
  }
  shared.rethrow();
}

}  // namespace vindu
