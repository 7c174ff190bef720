// A scene whose colours say where on it one looks: red and green rise and fall linearly along each
// surface, so that a difference of colours between two pictures is a displacement in pixels; blue
// names the surface.
#pragma once

#include "renderer/scene.h"

namespace vindu::test {

/// Red and green go from 0 to 255, or back, over `cell_m` (a divisor of 1 m). Surfaces before, at
/// and behind the screen plane, large enough for eyes at its edge; coordinates are wall's. An eye
/// close to the wall sees what lies behind it small and needs a coarser code.
Scene position_coded_scene(double cell_m);

}  // namespace vindu::test
