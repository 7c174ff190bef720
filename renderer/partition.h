// Things in space put into compact groups of limited size.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace vindu {

struct Placed {
  Eigen::Vector3f middle;
  std::uint32_t item = 0;
};

/// Halves the items across the longest side of the box around their middles, at the median, and the
/// halves again, until each has at most `largest` (a k-d tree: J. Bentley, 1975): compact, so that
/// few lie on any border. Puts the items into the order of the parts.
std::vector<std::span<Placed>> compact_parts(std::span<Placed> items, std::size_t largest);

}  // namespace vindu
