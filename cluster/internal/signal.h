// Wakes one thread that waits for topics; raised by any thread. Private to cluster.
#pragma once

#include <condition_variable>
#include <mutex>

#include "cluster/topics.h"

namespace vindu::internal {

class Signal {
 public:
  void raise(Topic topic) {
    bool awaited = false;
    {
      const std::scoped_lock lock(mutex_);
      raised_.add(topic);
      awaited = awaited_.has(topic);
    }
    if (awaited) changed_.notify_one();  // nobody is woken for what he does not wait for
  }
  void lower(Topic topic) {
    const std::scoped_lock lock(mutex_);
    raised_.remove(topic);
  }
  /// False at the deadline.
  bool wait(Topics topics, Time deadline) {
    std::unique_lock lock(mutex_);
    awaited_ = topics;
    const bool raised = changed_.wait_until(lock, deadline, [&] { return raised_.meets(topics); });
    awaited_ = {};
    return raised;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Topics raised_;
  Topics awaited_;
};

}  // namespace vindu::internal
