// The patterns of lines, drawn from where the tile's pixels are on the wall: what belongs together
// meets over every seam, behind bezels, on curved and crooked walls. Upright, as the viewer sees
// them.
#pragma once

#include "core/wall.h"
#include "renderer/image.h"

namespace vindu {

/// Of the grid's fine lines, one for the whole wall; bold ones are five of them apart. 0.1 m on a
/// wall of 0.5 to 10 m.
double grid_step_m(const Wall& wall);

/// The wall's grid in metres, circles about its middle, a circle in the tile, the tile's outermost
/// pixels and its middle.
Image draw_grid(const Wall& wall, const Tile& tile, SizePx size);

/// Thin lines at 45 degrees, and broad ones that climb by 1 in 12: where a tile is off by a pixel
/// across them, they jump by twelve at the seam.
Image draw_seams(const Wall& wall, const Tile& tile, SizePx size);

}  // namespace vindu
