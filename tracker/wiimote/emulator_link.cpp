#include "tracker/wiimote/emulator_link.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vindu {

LinkOptions two_on_one_adapter() {
  LinkOptions options;
  options.loss = 1 - 10.25 / 10.73;
  options.pause_every = std::chrono::milliseconds(47);
  return options;
}

LinkOptions bad_link() {
  LinkOptions options = two_on_one_adapter();
  options.loss = 0.05;
  options.delay = std::chrono::milliseconds(15);
  options.jitter = std::chrono::milliseconds(5);
  return options;
}

EmulatedLink::EmulatedLink(const LinkOptions& options, std::uint64_t seed)
    : options_(options), random_(seed) {}

Duration EmulatedLink::between(Duration shortest, Duration longest) {
  return from_seconds(random_.uniform(seconds(shortest), seconds(longest)));
}

// Pauses begin at random (a Poisson process), but never within one another.
void EmulatedLink::plan_pause(Time after) {
  const Duration pause = (options_.pause_shortest + options_.pause_longest) / 2;
  const double mean_s = seconds(options_.pause_every - pause);
  assert(mean_s > 0);
  pause_begin_ = after + from_seconds(-mean_s * std::log(1 - random_.uniform(0, 1)));
  pause_end_ = pause_begin_ + between(options_.pause_shortest, options_.pause_longest);
}

std::optional<Time> EmulatedLink::carry(Time departure, bool may_be_lost) {
  Time arrival = departure + options_.delay + between(Duration::zero(), options_.jitter);
  if (may_be_lost && options_.loss > 0 && random_.uniform(0, 1) < options_.loss)
    return std::nullopt;
  if (options_.pause_every > Duration::zero()) {
    if (!planned_) plan_pause(arrival);
    planned_ = true;
    while (arrival >= pause_end_) plan_pause(pause_end_);
    if (arrival >= pause_begin_) arrival = pause_end_;
  }
  if (last_arrival_ && arrival < *last_arrival_ + options_.burst_gap_longest) {
    const Duration gap = between(options_.burst_gap_shortest, options_.burst_gap_longest);
    arrival = std::max(arrival, *last_arrival_ + gap);
  }
  last_arrival_ = arrival;
  return arrival;
}

}  // namespace vindu
