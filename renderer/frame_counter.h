// The frame counter: a number drawn into a tile's picture, large enough to be read from its pixels
// again. What a tile shows is proven by its pixels, not by what it believes.
#pragma once

#include <cstdint>
#include <optional>

#include "renderer/canvas.h"

namespace vindu {

/// Eight digits, white on black, for a tile of that size: the last eight of larger numbers. Empty
/// where the tile is too small (under 40 x 9 pixels).
Image frame_counter(std::uint64_t number, SizePx tile);

/// The number that stands in the lower left of a tile's picture; empty where none does.
std::optional<std::uint64_t> read_frame_counter(const Image& tile);

/// Draws it into the lower left of a part of the picture.
void draw_frame_counter(std::uint64_t number, const RectPx& tile, Picture& picture);

}  // namespace vindu
