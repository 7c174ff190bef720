#include "bench/frame_lock/figures.h"

#include <algorithm>

namespace vindu {

bool whole(const FrameMarks& frame) {
  return !frame.tiles.empty() && frame.locked == frame.tiles.size() &&
         std::ranges::all_of(frame.tiles, [](const TileMark& mark) {
           return mark.ready_ns != 0 && mark.swapped_ns != 0;
         });
}

std::int64_t last_swap_ns(const FrameMarks& frame) {
  return std::ranges::max_element(frame.tiles, {}, &TileMark::swapped_ns)->swapped_ns;
}

void LockFigures::add(const FrameMarks& frame) {
  ++frames;
  if (!whole(frame)) return;
  const std::int64_t first = std::ranges::min(frame.tiles, {}, &TileMark::swapped_ns).swapped_ns;
  const std::int64_t last = last_swap_ns(frame);
  const std::int64_t ready = std::ranges::max(frame.tiles, {}, &TileMark::ready_ns).ready_ns;
  skew_us.push_back(1e-3 * static_cast<double>(last - first));
  cost_us.push_back(1e-3 * static_cast<double>(last - ready));
  if (first < ready) ++early;
}

}  // namespace vindu
