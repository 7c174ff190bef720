// How a figure spread over a run of any length, in memory that does not grow with it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/frame_tally.h"

namespace vindu::app {

/// Keeps all values at first, then every second one of the run, every fourth, and so on; and the
/// largest of all.
class RunSpread {
 public:
  void add(double value);
  bool empty() const { return count_ == 0; }
  Quantiles quantiles() const;

 private:
  std::vector<double> kept_;
  std::uint64_t count_ = 0;
  std::uint64_t every_ = 1;
  double largest_ = 0;
};

}  // namespace vindu::app
