// Where the bundle adjustment of the wand calibration begins, without any pose known before:
// essential matrices of camera pairs (Nistér 2004) by random sampling, the wand's length as scale,
// pairs chained over common views. Private to the wand calibration.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracker/calibration/wand_adjust.h"

namespace vindu {

/// Fills the cameras' poses (the first camera is the world), their lags to 15 ms, within +-130 ms
/// of each other, and the wand's poses, and turns views so that all of a moment begin with the same
/// LED; moments that fit no wand become unused. Lenses must be there. Throws Error that names the
/// camera which sees the wand too seldom together with others, or for which no place explains what
/// they saw.
void start_world(std::vector<WandMoment>& moments, const std::vector<std::string>& names,
                 std::uint64_t seed, WandWorld& world);

}  // namespace vindu
