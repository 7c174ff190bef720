// The clock seam. Times are points of CLOCK_MONOTONIC of the machine that took them (steady_clock
// on Linux). The manual clock makes a run repeatable: time moves only when somebody waits.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace vindu {

using Time = std::chrono::steady_clock::time_point;
using Duration = std::chrono::nanoseconds;

inline double seconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }
inline double milliseconds(Duration duration) { return 1e3 * seconds(duration); }
/// Of the clock that took it, as messages and records carry times.
inline std::int64_t nanoseconds(Time time) { return Duration(time.time_since_epoch()).count(); }
/// To the nearest nanosecond.
inline Duration from_seconds(double value_s) {
  return std::chrono::round<Duration>(std::chrono::duration<double>(value_s));
}

/// Thread-safe, except ManualClock, which is bound to one thread.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual Time now() const = 0;
  /// Returns at once when `time` has passed.
  virtual void sleep_until(Time time) = 0;
};

class MonotonicClock final : public Clock {
 public:
  Time now() const override { return std::chrono::steady_clock::now(); }
  void sleep_until(Time time) override;
};

/// Starts at time zero; waiting is the only thing that takes time.
class ManualClock final : public Clock {
 public:
  Time now() const override { return now_; }
  void sleep_until(Time time) override { now_ = std::max(now_, time); }

 private:
  Time now_{};
};

}  // namespace vindu
