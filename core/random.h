// Random numbers that are the same on every machine: the standard fixes the engine, but not what
// its distributions make of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "core/rigid3.h"

namespace vindu {

/// Bound to one thread.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  /// Of mean 0 (Box and Muller 1958, one of the pair).
  double normal(double sigma) {
    const double u = 1 - uniform(0, 1), v = uniform(0, 1);
    return sigma * std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vindu
