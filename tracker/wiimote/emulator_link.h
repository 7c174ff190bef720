// The radio between emulated Wiimotes and this machine: when an input report that has left a device
// arrives, or that it never does. Nothing arrives early or out of order. With several Wiimotes on
// one adapter each waits while another is served, and then delivers in a burst: thesis 5.3.3 and
// Table 5.1.
#pragma once

#include <cstdint>
#include <optional>

#include "core/clock.h"
#include "core/random.h"

namespace vindu {

/// Which of the Wiimotes on one adapter this is. All of them have the same seed and beginning.
struct AdapterShare {
  int place = 0;  ///< from 0 on
  int of = 2;     ///< Wiimotes on the adapter
  std::uint64_t seed = 1;
  Time begin{};  ///< of the adapter's turns
};

struct LinkOptions {
  Duration delay = std::chrono::milliseconds(6);         ///< at least, towards this machine
  Duration jitter = std::chrono::microseconds(500);      ///< at most on top, uniform
  Duration output_delay = std::chrono::milliseconds(2);  ///< towards the device
  double loss = 0;  ///< share of data reports that the device drops; answers are repeated instead

  /// Every `pause_every` on average (zero: never) the adapter serves others, for a time between the
  /// shortest and the longest pause; what has queued up then comes at gaps between these two.
  Duration pause_every{};
  Duration pause_shortest = std::chrono::milliseconds(16);
  Duration pause_longest = std::chrono::milliseconds(22);
  Duration burst_gap_shortest = std::chrono::microseconds(550);
  Duration burst_gap_longest = std::chrono::microseconds(2250);
  /// The others that are served are emulated too: they have their turns while this one pauses.
  /// Without, it pauses for others that nobody sees.
  std::optional<AdapterShare> shared{};
};

/// As measured in the thesis: three pauses in the 142 ms of Table 5.1, and 10.73 ms from report to
/// report where one device alone has 10.25 ms.
LinkOptions two_on_one_adapter();

/// The same with 5 % of the data reports lost and 15 to 20 ms of delay: worse than anything that
/// was measured, to show what a tracker makes of it.
LinkOptions bad_link();

/// Bound to one thread.
class EmulatedLink {
 public:
  EmulatedLink(const LinkOptions& options, std::uint64_t seed);

  /// When a report arrives that left at `departure`; empty when it is lost. Departures never go
  /// back. `may_be_lost`: whether it is a data report.
  std::optional<Time> carry(Time departure, bool may_be_lost);

  Time reaches_device(Time written) const { return written + options_.output_delay; }

 private:
  void plan_pause(Time after);
  void plan_turn_of_another();
  Duration mean_pause() const { return (options_.pause_shortest + options_.pause_longest) / 2; }

  LinkOptions options_;
  Random random_;
  Random turns_;  // the same numbers for all that share the adapter
  int turn_ = 0;
  Time pause_begin_ = Time::max();
  Time pause_end_ = Time::max();
  bool planned_ = false;
  std::optional<Time> last_arrival_;
};

}  // namespace vindu
