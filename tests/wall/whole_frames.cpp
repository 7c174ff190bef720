#include "tests/wall/whole_frames.h"

#include <algorithm>

namespace vindu::testing {

void WholeFrames::add(const Swap& swap) {
  if (swap.locked < tiles_) return;
  const Time time{std::chrono::nanoseconds(swap.time_ns)};
  Seen& seen = seen_[{swap.epoch, swap.frame}];
  if (seen.tiles++ == 0) seen.swaps = {time, time};
  seen.swaps.first = std::min(seen.swaps.first, time);
  seen.swaps.last = std::max(seen.swaps.last, time);
  if (seen.tiles == tiles_) whole_.push_back(seen.swaps);
}

const std::vector<WholeFrame>& WholeFrames::in_order() {
  std::ranges::sort(whole_, {}, &WholeFrame::last);
  return whole_;
}

}  // namespace vindu::testing
