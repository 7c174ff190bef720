// Work beside the frames that go on, in a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <stop_token>
#include <utility>

namespace vindu::app {

/// One piece of work at a time; bound to one thread. At the end of its scope the work is asked to
/// stop and waited for.
template <class Result>
class Background {
 public:
  Background() = default;
  ~Background() { stop(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Not while it is running.
  void start(std::function<Result(std::stop_token)> work) {
    stop_ = {};
    result_ = std::async(std::launch::async, std::move(work), stop_.get_token());
  }
  /// Asks for an early end; the work then throws, as a rule.
  void stop() { stop_.request_stop(); }
  bool running() const { return result_.valid(); }
  bool done() const {
    return running() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }
  /// Throws what the work threw; afterwards it is not running.
  Result take() { return result_.get(); }

 private:
  std::stop_source stop_;
  std::future<Result> result_;
};

}  // namespace vindu::app
