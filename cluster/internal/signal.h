// Wakes one thread that waits for topics; raised by any thread. Private to cluster.
#pragma once

#include <condition_variable>
#include <mutex>

#include "cluster/topics.h"

namespace vindu::internal {

class Signal {
 public:
  void raise(Topic topic) {
    {
      const std::scoped_lock lock(mutex_);
      raised_.add(topic);
    }
    changed_.notify_all();
  }
  void lower(Topic topic) {
    const std::scoped_lock lock(mutex_);
    raised_.remove(topic);
  }
  /// False at the deadline.
  bool wait(Topics topics, Time deadline) {
    std::unique_lock lock(mutex_);
    return changed_.wait_until(lock, deadline, [&] { return raised_.meets(topics); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Topics raised_;
};

}  // namespace vindu::internal
