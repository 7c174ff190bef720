// What a calibration gets on a machine without cameras: report bytes of emulated Wiimotes, read by
// the driver under a manual clock, as fast as it goes; and the hidden truth that they come from.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "simulator/emulated_room.h"
#include "tracker/calibration/capture.h"

namespace vindu {

/// Reads all cameras for this long, from where the clock is. The room must have been made for
/// `clock` and as many cameras. `watching` is given what was seen so far ten times a second of that
/// clock; false: that is enough.
Capture watch(const EmulatedRoom& room, std::size_t cameras, ManualClock& clock, double seconds,
              const std::function<bool(const Capture& so_far)>& watching = {});

/// The room as it truly is, where the site is what people have measured: cameras stand some 5 cm
/// and 2 degrees off, lenses are those of single units (2 % of the focal length, 10 px of the
/// centre, 0.03 of k1), and each camera lags by up to 6 ms.
struct HiddenTruth {
  std::vector<CameraConfig> cameras;
  std::vector<Duration> late;
};
HiddenTruth hide_truth(const std::vector<CameraConfig>& cameras, std::uint64_t seed);

}  // namespace vindu
