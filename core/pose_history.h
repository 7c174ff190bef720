// Poses over time, and an honest answer for any time: exact, interpolated, predicted or stale. The
// idea of a history that says how it knows is Monado's relation history.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <string_view>

#include "core/pose.h"

namespace vindu {

enum class PoseAnswer {
  exact,         ///< a sample was taken at this time
  interpolated,  ///< between two samples
  predicted,     ///< after the newest sample, within the prediction limit
  stale,         ///< farther away than that: the newest (or oldest) sample as it is
};

constexpr std::string_view name_of(PoseAnswer answer) {
  constexpr std::string_view names[] = {"exact", "interpolated", "predicted", "stale"};
  return names[static_cast<int>(answer)];
}

struct PoseAt {
  PoseSample sample;  ///< capture_time is the newest real sample's that the answer rests on
  PoseAnswer answer = PoseAnswer::stale;
};

struct PoseHistoryOptions {
  Duration kept = std::chrono::seconds(2);
  Duration prediction_limit =
      std::chrono::milliseconds(60);  ///< error grows with its square (Azuma & Bishop 1995)
};

/// Thread-safe: the tracker adds, the master asks.
class PoseHistory {
 public:
  explicit PoseHistory(PoseHistoryOptions options = {}) : options_(options) {}

  /// Samples may come late but are kept in order of capture time; one of the same time replaces the
  /// older one.
  void add(const PoseSample& sample);

  /// Empty only when nothing was ever added.
  std::optional<PoseAt> at(Time time) const;

 private:
  mutable std::mutex mutex_;
  PoseHistoryOptions options_;
  std::deque<PoseSample> samples_;  // in order of capture_time
};

}  // namespace vindu
