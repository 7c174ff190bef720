#include "cluster/launch/restarts.h"

#include <algorithm>

namespace vindu {

std::optional<Duration> Restarts::after_death(Duration lived) {
  young_deaths_ = lived < policy_.young ? young_deaths_ + 1 : 1;
  if (young_deaths_ >= policy_.most_young_deaths) return std::nullopt;
  ++count_;
  Duration delay = policy_.first_delay;
  for (int i = 1; i < young_deaths_ && delay < policy_.longest_delay; ++i) delay *= 2;
  return std::min(delay, policy_.longest_delay);
}

}  // namespace vindu
