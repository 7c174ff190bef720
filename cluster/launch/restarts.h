// When a process that died is started again: at once, ever later while it keeps dying young, and
// not at all after too many of those; and when one hangs. systemd does the same on hosts
// (host_plan.h).
#pragma once

#include <optional>

#include "core/clock.h"

namespace vindu {

struct RestartPolicy {
  /// Who does not say that it lives is ended after this time.
  Duration patience = std::chrono::seconds(10);
  Duration first_patience = std::chrono::seconds(60);  ///< after its start
  Duration first_delay = std::chrono::milliseconds(200);
  Duration longest_delay = std::chrono::seconds(5);
  Duration young = std::chrono::seconds(10);  ///< who lives longer starts anew
  int most_young_deaths = 5;                  ///< in a row
};

/// Of one process. Bound to no thread.
class Restarts {
 public:
  explicit Restarts(const RestartPolicy& policy = {}) : policy_(policy) {}

  /// How long after its death it is to be started; empty: no more.
  std::optional<Duration> after_death(Duration lived);
  int count() const { return count_; }

 private:
  RestartPolicy policy_;
  int young_deaths_ = 0;
  int count_ = 0;
};

}  // namespace vindu
