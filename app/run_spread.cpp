#include "app/run_spread.h"

#include <algorithm>

namespace vindu::app {

void RunSpread::add(double value) {
  constexpr std::size_t kMost = 1 << 14;
  largest_ = count_ == 0 ? value : std::max(largest_, value);
  if (count_++ % every_ != 0) return;
  if (kept_.size() == kMost) {
    for (std::size_t i = 0; i < kMost / 2; ++i) kept_[i] = kept_[2 * i];
    kept_.resize(kMost / 2);
    every_ *= 2;
  }
  kept_.push_back(value);
}

Quantiles RunSpread::quantiles() const {
  Quantiles spread = quantiles_of(kept_);
  spread.max = largest_;
  return spread;
}

}  // namespace vindu::app
