// Ctrl-C, and the other signals that end a program well, as something to wait for: commands that
// run until they are stopped clean up behind them.
#pragma once

#include <csignal>
#include <ctime>

#include "core/clock.h"

namespace vindu::app {

/// To be made before any thread is started: those inherit that the signals are held back.
class StopSignals {
 public:
  StopSignals() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~StopSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Whether one came within this time.
  bool came_within(Duration time) const {
    const auto whole = std::chrono::floor<std::chrono::seconds>(time);
    const timespec limit{whole.count(), (time - whole).count()};
    return sigtimedwait(&signals_, nullptr, &limit) > 0;
  }

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

}  // namespace vindu::app
