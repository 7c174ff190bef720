// The upper median, of the few dozen to thousand values of a calibration.
#pragma once

#include <algorithm>
#include <vector>

namespace vindu {

/// `of_none` when there are no values.
inline double median(std::vector<double> values, double of_none = 0) {
  if (values.empty()) return of_none;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace vindu
