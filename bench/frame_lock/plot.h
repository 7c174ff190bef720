// The bench's picture: skew of the swaps and cost of the barrier against the number of tiles, ours
// and the raw UDP lock's.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.h"

namespace vindu {

/// In us.
struct Spread {
  double p50 = 0, p99 = 0, max = 0;
};

struct LockSpreads {
  Spread skew_us, cost_us;
};

struct PlotPoint {
  int tiles = 1;
  LockSpreads bus, udp;
};

/// `points` by number of tiles. `words`: what machine, how many frames.
Image lock_plot(const std::vector<PlotPoint>& points, const std::string& words);

}  // namespace vindu
