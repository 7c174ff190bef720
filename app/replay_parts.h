// The parts of motion to photon that a recording knows: how old at the wall's ticks was what the
// eye rests on, and how long finding it takes here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"

namespace vindu::app {

class ReplayParts {
 public:
  /// A tick; `now` on the recording's clock, `solve` measured here and now.
  void add(Time now, const std::optional<PoseSample>& pose, Duration solve);

  /// For people.
  std::string table() const;

 private:
  std::vector<double> capture_ages_ms_, solves_ms_;
};

}  // namespace vindu::app
