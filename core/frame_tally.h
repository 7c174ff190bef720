// What the frames of the last seconds were like: mean parts, and how motion to photon and skew are
// spread. Of the whole wall or of one tile; alike where it is measured, sent and shown.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vector>

#include "core/frame_parts.h"

namespace vindu {

/// Nearest-rank quantiles.
struct Quantiles {
  double p50 = 0, p99 = 0, max = 0;
  bool operator==(const Quantiles&) const = default;
};

/// All zero for no values.
Quantiles quantiles_of(std::vector<double> values);

struct FrameSummary {
  std::size_t frames = 0;
  double frames_per_s = 0;
  std::array<double, kParts> mean_ms{};  ///< by Part; their sum is the mean of the whole
  bool tracked = false;                  ///< the newest frame: its parts begin with capture
  Quantiles motion_to_photon_ms{};
  Quantiles skew_ms{};  ///< wall: from the first tile's swap to the last's; tile: to its own

  double mean_motion_to_photon_ms() const;
  bool operator==(const FrameSummary&) const = default;
};

class FrameTally {
 public:
  explicit FrameTally(Duration window = std::chrono::seconds(5)) : window_(window) {}

  void add(Time now, const FrameParts& parts, Duration skew = {});
  /// Of the window before `now`.
  FrameSummary summary(Time now);

 private:
  struct Frame {
    Time time{};
    FrameParts parts{};
    Duration skew{};
  };

  void forget(Time now);

  Duration window_;
  std::deque<Frame> frames_;
};

}  // namespace vindu
