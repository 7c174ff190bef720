// How far the clock of one host is ahead of another's, and how fast they drift apart, from messages
// that go both ways with every frame (the four times of NTP, RFC 5905 section 8). For figures
// alone: nothing that has to be right depends on it.
#pragma once

#include <deque>
#include <optional>

#include "core/clock.h"

namespace vindu {

/// There and back: sent and received by either end's own clock.
struct RoundTrip {
  Time sent_here{};
  Time received_there{};
  Time sent_there{};
  Time received_here{};
};

struct OffsetEstimate {
  Duration offset{};       ///< there minus here
  Duration uncertainty{};  ///< the offset cannot be further off, but for the drift since
  double drift_ppm = 0;    ///< how much faster the clock there runs; 0 while not known
};

class ClockOffset {
 public:
  /// Those that make no sense (answered before they arrived) are left out.
  void add(const RoundTrip& trip);

  /// At a time of the clock here. The offset is that of the quickest round trips; the drift, their
  /// slope over the last minutes. Empty before the first.
  std::optional<OffsetEstimate> at(Time here) const;

 private:
  struct Sample {
    Time here{};
    Duration offset{};
    Duration half_delay{};
  };

  std::optional<Sample> best_;   // of the running period
  std::deque<Sample> quickest_;  // one of each period
};

/// Another host's times on this one's clock, from messages that come one way alone: by the least
/// difference between receiving and sending of the last ones. It is too late by what the fastest of
/// them took, some 0.1 ms in a wall's network, and alike on all hosts.
class OneWayOffset {
 public:
  void add(Time sent_there, Time received_here);
  /// Empty before the first message.
  std::optional<Time> here(Time there) const;

 private:
  static constexpr std::size_t kKept = 240;  // some seconds
  std::deque<Duration> differences_;
};

}  // namespace vindu
