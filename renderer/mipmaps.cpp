#include "renderer/mipmaps.h"

#include <stb/stb_image_resize.h>

#include <algorithm>
#include <new>

namespace vindu {
namespace {

std::size_t pixels_of(SizePx size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

void halve(const Rgba8* from, SizePx size, Rgba8* to, bool srgb) {
  const SizePx half = half_of(size);
  const int alpha = srgb ? 3 : STBIR_ALPHA_CHANNEL_NONE;
  const int done =
      stbir_resize_uint8_generic(from->data(), size.width, size.height, 0, to->data(), half.width,
                                 half.height, 0, 4, alpha, 0, STBIR_EDGE_CLAMP, STBIR_FILTER_BOX,
                                 srgb ? STBIR_COLORSPACE_SRGB : STBIR_COLORSPACE_LINEAR, nullptr);
  if (!done) throw std::bad_alloc();
}

}  // namespace

std::size_t mipmap_pixels(SizePx size) {
  std::size_t pixels = pixels_of(size);
  while (size.width > 1 || size.height > 1) {
    size = half_of(size);
    pixels += pixels_of(size);
  }
  return pixels;
}

std::vector<Rgba8> mipmaps_of(const Image& image, bool srgb) {
  SizePx size = {image.width_px, image.height_px};
  std::vector<Rgba8> pixels(mipmap_pixels(size));
  std::ranges::copy(image.pixels, pixels.begin());
  Rgba8* from = pixels.data();
  while (size.width > 1 || size.height > 1) {
    Rgba8* const to = from + pixels_of(size);
    halve(from, size, to, srgb);
    size = half_of(size);
    from = to;
  }
  return pixels;
}

}  // namespace vindu
