#include "renderer/partition.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace vindu {
namespace {

void split(std::span<Placed> items, std::size_t largest, std::vector<std::span<Placed>>& parts) {
  if (items.size() <= largest) {
    parts.push_back(items);
    return;
  }
  Eigen::AlignedBox3f box;
  for (const Placed& placed : items) box.extend(placed.middle);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::ranges::stable_sort(items, {}, [axis](const Placed& placed) { return placed.middle[axis]; });
  const std::size_t half = items.size() / 2;
  split(items.first(half), largest, parts);
  split(items.subspan(half), largest, parts);
}

}  // namespace

std::vector<std::span<Placed>> compact_parts(std::span<Placed> items, std::size_t largest) {
  std::vector<std::span<Placed>> parts;
  split(items, largest, parts);
  return parts;
}

}  // namespace vindu
