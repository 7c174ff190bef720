// What a tile shows of the page of points that are touched (core/touch_page.h).
#pragma once

#include "core/touch_page.h"
#include "core/wall.h"
#include "renderer/image.h"

namespace vindu {

/// Where a point of the wall stands on a picture of this size that fills the tile: pixels from its
/// upper left, pixel i from i to i + 1. Of a point off the tile's plane: where its foot stands.
Vec2 pixel_of(const TileCorners& tile, const Vec3& x_in_wall, SizePx size);

/// What the tile shows, upright as it is seen; Surface's side mirrors and turns it as it is
/// mounted. Throws Error when the font is not there.
Image draw_touch_page(const TouchPage& page, const Tile& tile, SizePx size);

}  // namespace vindu
