// How long `vindu launch` takes to a wall that shows whole frames, with everything that a wall
// does: process start, OpenGL, the model, discovery, the lock.
#pragma once

#include <optional>
#include <string>

namespace vindu {

/// From the start of `program launch` with 28 local tiles, drawing without a display at a tenth of
/// their size, to the first frame that is released with all of them in the lock. Empty: not within
/// a minute.
std::optional<double> launch_s(const std::string& program);

}  // namespace vindu
