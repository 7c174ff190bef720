// Heads that move by rule, for trials of the tracker: how fast is known, and the sharpest moments
// are there by design.
#pragma once

#include <cstdint>

#include "simulator/led_body.h"

namespace vindu {

struct MotionPeaks {
  double move_m_s = 0;
  double turn_rad_s = 0;
};

/// At rest somewhere about the usual place.
BodyMotion resting(std::uint64_t seed);

/// From stop to stop about the usual place, at rest for 0.3 to 0.8 s at each; each way is of
/// minimum jerk (Flash & Hogan 1985) with one of the peaks, so that it starts and ends sharply: a
/// head that moves 0.3 m at 0.57 m/s accelerates by 2 m/s^2. Repeats after some minutes.
BodyMotion starting_and_stopping(const MotionPeaks& peaks, std::uint64_t seed);

}  // namespace vindu
