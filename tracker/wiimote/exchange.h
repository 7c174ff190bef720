// Commands that a Wiimote answers, one at a time: it loses those that reach it before the answer to
// the one before. A command without an answer is sent again. No input or output of its own.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "tracker/wiimote/commands.h"

namespace vindu {

struct Patience {
  Duration timeout = std::chrono::milliseconds(250);  ///< at most: replies take up to 200 (SDL)
  int tries = 4;
  bool go_on = false;  ///< without an answer, for devices that give none
};

enum class Progress {
  none,      ///< the report answered nothing that was asked
  step,      ///< it ended a step
  finished,  ///< it ended the last one
  refused,   ///< the step was answered by an error; all are dropped
  unequal,   ///< the memory is not what was expected; all are dropped
  deserted,  ///< no answer came after all tries; all are dropped
};

class Exchange {
 public:
  void begin(std::vector<Step> steps, const Patience& patience);
  void abandon() { steps_.clear(); }

  /// Offers a report that has come.
  Progress take(const Report& report, Time arrival);
  /// The command to write now, for the first time or again.
  std::optional<OutputReport> next_output(Time now);
  /// What became of the exchange for want of good answers, since the last call: none, finished
  /// (where it goes on without), refused or deserted.
  Progress take_timeout();
  /// Why, when it was refused or the memory unequal.
  const std::string& failure() const { return failure_; }
  /// Commands that were sent again.
  std::uint64_t repeated() const { return repeated_; }
  /// When next_output() may have something; Time::max() when idle.
  Time deadline() const;

 private:
  Progress take(const Acknowledgement& acknowledgement, Time arrival);
  Progress take(const MemoryReport& memory, Time arrival);
  Duration timeout() const;
  Progress answered(Time arrival);
  Progress end_step();
  Progress fail(Progress how, const std::string& why);
  Progress refuse();

  std::deque<Step> steps_;
  Patience patience_;
  Time sent_{}, next_try_{};
  Duration slowest_{};  // answer, of late
  int tries_ = 0;
  int refused_ = 0;  // the last try, with this error
  Progress timeout_ = Progress::none;
  std::string failure_;
  std::uint64_t repeated_ = 0;
};

}  // namespace vindu
