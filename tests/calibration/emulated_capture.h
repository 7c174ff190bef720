// Captures as a calibration gets them: report bytes and arrival times of emulated Wiimotes that
// watch LEDs being waved. What is true stays with the test.
#pragma once

#include <vector>

#include "simulator/emulated_room.h"
#include "tracker/calibration/capture.h"

namespace vindu::testing {

struct EmulatedCapture {
  Site site;  ///< the true one
  LedBody body{};
  double seconds = 60;
  double noise_px = 0.6;
  std::uint64_t seed = 1;
  std::vector<Duration> late{};
  std::vector<Glint> glints{};
  LinkOptions link{};
};

/// Plays it through devices and driver, as fast as it can.
Capture capture_of(const EmulatedCapture& wanted);

/// Cameras around the middle of a walking area, each of them with a lens of its own; the wall
/// files' kind of priors does not know these.
Site true_site(const std::vector<Vec3>& positions_in_room);

/// LEDs on a line along x, waved through what those cameras see.
LedBody wand(std::vector<double> leds_m, std::uint64_t seed = 1, double tempo_hz = 0.07);

}  // namespace vindu::testing
