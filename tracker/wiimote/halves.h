// Joins the reports 0x3e and 0x3f, of which the full format needs one each for a sample. Neither
// says whose other half it is: they belong together when the second follows the first at once.
#pragma once

#include <cstdint>
#include <optional>

#include "core/clock.h"
#include "tracker/wiimote/report.h"

namespace vindu {

/// Times never go back.
class HalfJoiner {
 public:
  /// The sample that this half completes.
  std::optional<DataReport> take(const HalfReport& half, Time arrival);
  /// Halves that are still to come belong to another sample.
  void interrupt();
  /// Halves without the other.
  std::uint64_t lone() const { return lone_; }

 private:
  std::optional<HalfReport> first_;
  Time first_arrival_{};
  std::uint64_t lone_ = 0;
};

}  // namespace vindu
