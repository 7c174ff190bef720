// The order statistics that benches print.
#pragma once

#include <algorithm>
#include <vector>

namespace vindu {

/// The value that `share` (0 to 1) of the others do not exceed; of at least one value.
inline double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace vindu
