#include "tracker/wiimote/emulator_link.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vindu {
namespace {

// How long until the next event of a Poisson process.
Duration wait_of(Random& random, Duration mean) {
  assert(mean > Duration::zero());
  return from_seconds(-seconds(mean) * std::log(1 - random.uniform(0, 1)));
}

Duration between(Random& random, Duration shortest, Duration longest) {
  return from_seconds(random.uniform(seconds(shortest), seconds(longest)));
}

}  // namespace

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
    : options_(options),
      random_(seed),
      turns_(options.shared ? options.shared->seed : 0),
      pause_end_(options.shared ? options.shared->begin : Time::max()),
      planned_(options.shared.has_value()) {}

// Each of those on the adapter has a turn, in which the others pause. Of two, each pauses every
// `pause_every`.
void EmulatedLink::plan_turn_of_another() {
  do {
    pause_begin_ = pause_end_ + wait_of(turns_, options_.pause_every / 2 - mean_pause());
    pause_end_ = pause_begin_ + between(turns_, options_.pause_shortest, options_.pause_longest);
  } while (turn_++ % options_.shared->of == options_.shared->place);
}

// Pauses begin at random, but never within one another.
void EmulatedLink::plan_pause(Time after) {
  if (options_.shared) return plan_turn_of_another();
  pause_begin_ = after + wait_of(random_, options_.pause_every - mean_pause());
  pause_end_ = pause_begin_ + between(random_, options_.pause_shortest, options_.pause_longest);
}

std::optional<Time> EmulatedLink::carry(Time departure, bool may_be_lost) {
  Time arrival = departure + options_.delay + between(random_, Duration::zero(), options_.jitter);
  if (may_be_lost && options_.loss > 0 && random_.uniform(0, 1) < options_.loss)
    return std::nullopt;
  if (options_.pause_every > Duration::zero()) {
    if (!planned_) plan_pause(arrival);
    planned_ = true;
    while (arrival >= pause_end_) plan_pause(pause_end_);
    if (arrival >= pause_begin_) arrival = pause_end_;
  }
  if (last_arrival_ && arrival < *last_arrival_ + options_.burst_gap_longest) {
    const Duration gap = between(random_, options_.burst_gap_shortest, options_.burst_gap_longest);
    arrival = std::max(arrival, *last_arrival_ + gap);
  }
  last_arrival_ = arrival;
  return arrival;
}

}  // namespace vindu
