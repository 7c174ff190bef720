// Frames that a whole wall has shown, from what its tiles say that they did.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "tests/wall/swaps.h"

namespace vindu::testing {

/// When the first and the last tile showed it.
struct WholeFrame {
  Time first{}, last{};
};

class WholeFrames {
 public:
  explicit WholeFrames(std::size_t tiles) : tiles_(tiles) {}

  /// One that was made while not all tiles were in the lock (which takes no tile that loads) counts
  /// for nothing.
  void add(const Swap& swap);
  /// In the order of the last swap's time.
  const std::vector<WholeFrame>& in_order();

 private:
  struct Seen {
    std::size_t tiles = 0;
    WholeFrame swaps;
  };

  std::size_t tiles_;
  std::map<std::pair<std::string, std::uint64_t>, Seen> seen_;  // by master and number
  std::vector<WholeFrame> whole_;
};

}  // namespace vindu::testing
