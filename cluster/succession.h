// Which of the processes that speak for a tile is the tile: the one that was heard first last. One
// that was replaced and still speaks is a twin.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/clock.h"

namespace vindu {

class Succession {
 public:
  enum class Voice {
    own,        ///< of whom spoke before, or the first at all
    successor,  ///< in his place from now on
    twin,       ///< of one in whose place another is
  };

  /// `incarnation`: of the process, not 0.
  Voice hear(std::uint64_t incarnation, Time now) {
    if (current_ == 0) current_ = incarnation;
    if (incarnation == current_) {
      heard_ = now;
      return Voice::own;
    }
    const bool replaced = std::ranges::find(replaced_, incarnation) != replaced_.end();
    if (replaced && now - heard_ < kSilence) return Voice::twin;
    std::erase(replaced_, incarnation);
    if (replaced_.size() >= kRemembered) replaced_.erase(replaced_.begin());
    replaced_.push_back(std::exchange(current_, incarnation));
    heard_ = now;
    return Voice::successor;
  }

 private:
  /// Of the newest, after which one that it replaced may take its place again.
  static constexpr Duration kSilence = std::chrono::seconds(3);
  static constexpr std::size_t kRemembered = 8;

  std::uint64_t current_ = 0;
  Time heard_{};
  std::vector<std::uint64_t> replaced_;  // the oldest first
};

}  // namespace vindu
