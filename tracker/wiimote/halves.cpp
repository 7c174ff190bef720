#include "tracker/wiimote/halves.h"

#include <utility>

namespace vindu {
namespace {

/// Bursts tear halves apart by up to 28 ms (thesis table 5.1); those of the next sample come 30 ms
/// after the first of this one.
constexpr Duration kTogether = std::chrono::milliseconds(28);

}  // namespace

std::optional<DataReport> HalfJoiner::take(const HalfReport& half, Time arrival) {
  if (!half.second || arrival - first_arrival_ > kTogether) interrupt();
  if (!half.second) {
    first_ = half;
    first_arrival_ = arrival;
    return std::nullopt;
  }
  if (const auto first = std::exchange(first_, std::nullopt)) return join(*first, half);
  ++lone_;
  return std::nullopt;
}

void HalfJoiner::interrupt() {
  if (std::exchange(first_, std::nullopt)) ++lone_;
}

}  // namespace vindu
