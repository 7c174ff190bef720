// Which of the helmet's clusters a camera gets a dot of, and how exact, as the emulated Wiimote has
// it: for plans of cameras that nobody has mounted yet.
#pragma once

#include "simulator/helmet.h"
#include "tracker/coverage.h"

namespace vindu {

/// A dot is seen where the cluster shines that way, the head does not stand between, and enough
/// light arrives for a Wiimote at its usual sensitivity; from far away its place is only that of
/// the sensor's pixel, 8 units wide. `sigma0_px` is its noise before rounding.
DotNoise helmet_dot_noise(const HeadConfig& head, double sigma0_px = kDotNoise_px);

}  // namespace vindu
