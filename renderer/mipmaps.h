// The smaller copies of a texture that stand for it from far away.
#pragma once

#include <vector>

#include "renderer/image.h"

namespace vindu {

/// Of a picture and all its smaller ones, down to a single pixel.
std::size_t mipmap_pixels(SizePx size);

/// The picture, then each smaller one, made of the one before by averaging. Where it holds colours
/// these are averaged as light, by how opaque they are: what shows through a hole does not tint its
/// rim.
std::vector<Rgba8> mipmaps_of(const Image& image, bool srgb);

/// The next smaller one.
constexpr SizePx half_of(SizePx size) {
  return {size.width > 1 ? size.width / 2 : 1, size.height > 1 ? size.height / 2 : 1};
}

}  // namespace vindu
