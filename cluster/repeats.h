// When to say again what may not have been heard. Soon the first time, for one packet that was
// lost; then ever more seldom: who does not answer may have more to hear than it can already.
#pragma once

#include <algorithm>

#include "core/clock.h"

namespace vindu {

class Repeats {
 public:
  /// Something new was said.
  void said(Time now) { said_again(now, kFirst); }
  /// The same was said again.
  void said_again(Time now) { said_again(now, std::min(2 * pause_, kLongest)); }
  Time due() const { return due_; }

 private:
  /// A message that is not heard costs this long.
  static constexpr Duration kFirst = std::chrono::milliseconds(4);
  static constexpr Duration kLongest = std::chrono::milliseconds(16);

  void said_again(Time now, Duration pause) {
    pause_ = pause;
    due_ = now + pause;
  }

  Duration pause_ = kFirst;
  Time due_{};
};

}  // namespace vindu
