// An 8-bit RGBA picture in memory, and its files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vindu {

struct SizePx {
  int width = 0;
  int height = 0;
  bool operator==(const SizePx&) const = default;
};

using Rgba8 = std::array<std::uint8_t, 4>;

/// Rows from the top, pixels from the left, no padding.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<Rgba8> pixels;

  static Image filled(int width_px, int height_px, Rgba8 colour) {
    return {width_px, height_px,
            std::vector<Rgba8>(static_cast<std::size_t>(width_px) * height_px, colour)};
  }
  bool empty() const { return pixels.empty(); }
  Rgba8& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
  const Rgba8& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
  bool operator==(const Image&) const = default;
};

/// Larger pictures are neither read nor decoded: 1 GiB in memory.
constexpr std::size_t kMaxImagePixels = std::size_t{1} << 28;

/// Opaque RGB; alpha is dropped. Throws Error when the file cannot be written.
void write_png(const Image& image, const std::string& file);

/// Throws Error when the file cannot be read.
Image read_png(const std::string& file);

/// PNG, JPEG, TGA, BMP, GIF, PSD or PNM bytes (stb_image); empty when they are none of these,
/// broken, larger than `max_pixels`, or claim more pixels than so few bytes can hold.
std::optional<Image> decode_image(std::span<const std::uint8_t> bytes,
                                  std::size_t max_pixels = kMaxImagePixels);

/// Copies `part` into `whole`, its upper left pixel at (x, y); what would fall outside is cut.
void paste(const Image& part, int x, int y, Image& whole);

}  // namespace vindu
