// The patterns that are pages of a tile's own: who it is, steps of brightness, and where the eye
// is. Upright, as the viewer sees them.
#pragma once

#include "core/frame_state.h"
#include "core/wall.h"
#include "renderer/image.h"

namespace vindu {

/// "mirrored, turned 90 degrees clockwise", "as it is": how the projector or monitor is fed.
std::string text_of(const TileMount& mount);

/// Who the tile is, which way the wall's up is, and which corner is its lower left.
Image draw_names(const Tile& tile, SizePx size);

/// Sixteen levels of grey, red, green and blue, then the sixteen nearest to black and to white.
Image draw_ramps(SizePx size);

/// The wall and the eye from above and from the left, with the tile's frustum; the eye's place in
/// words. `wall`: with all its tiles.
Image draw_eye(const FrameState& state, const Wall& wall, const Tile& tile, SizePx size);

}  // namespace vindu
