#include "renderer/frame_counter.h"

#include <algorithm>
#include <array>

namespace vindu {
namespace {

constexpr int kDigits = 8, kGlyphColumns = 3, kGlyphRows = 5;
constexpr int kWide = kDigits * (kGlyphColumns + 1) + 1,
              kHigh = kGlyphRows + 2;  // cells, with a margin
constexpr Rgba8 kDark{0, 0, 0, 255}, kLight{255, 255, 255, 255};

/// Fifteen cells a digit, from the upper left row by row.
constexpr std::array<std::array<const char*, kGlyphRows>, 10> kGlyphs = {{
    {"###", "# #", "# #", "# #", "###"},
    {" # ", "## ", " # ", " # ", "###"},
    {"###", "  #", "###", "#  ", "###"},
    {"###", "  #", "###", "  #", "###"},
    {"# #", "# #", "###", "  #", "  #"},
    {"###", "#  ", "###", "  #", "###"},
    {"###", "#  ", "###", "# #", "###"},
    {"###", "  #", " # ", " # ", " # "},
    {"###", "# #", "###", "# #", "###"},
    {"###", "# #", "###", "  #", "###"},
}};

/// Pixels along the side of a cell; 0 where the tile has no room.
int cell_px(SizePx tile) { return std::min({tile.width / (kWide + 3), tile.height / kHigh, 12}); }

bool lit(const Image& tile, int digit, int column, int row, int cell) {
  const int x = (digit * (kGlyphColumns + 1) + 1 + column) * cell + cell / 2;
  const int y = tile.height_px - kHigh * cell + (row + 1) * cell + cell / 2;
  return tile.at(x, y)[1] > 127;
}

std::optional<int> read_digit(const Image& tile, int digit, int cell) {
  for (std::size_t value = 0; value < kGlyphs.size(); ++value) {
    bool same = true;
    for (int row = 0; row < kGlyphRows && same; ++row)
      for (int column = 0; column < kGlyphColumns && same; ++column)
        same = lit(tile, digit, column, row, cell) ==
               (kGlyphs[value][static_cast<std::size_t>(row)][column] == '#');
    if (same) return static_cast<int>(value);
  }
  return std::nullopt;
}

}  // namespace

Image frame_counter(std::uint64_t number, SizePx tile) {
  const int cell = cell_px(tile);
  Image image = Image::filled(kWide * cell, kHigh * cell, kDark);
  for (int digit = kDigits - 1; digit >= 0; --digit, number /= 10)
    for (int y = 0; y < kGlyphRows * cell; ++y)
      for (int x = 0; x < kGlyphColumns * cell; ++x)
        if (kGlyphs[number % 10][static_cast<std::size_t>(y / cell)][x / cell] == '#')
          image.at((digit * (kGlyphColumns + 1) + 1) * cell + x, cell + y) = kLight;
  return image;
}

std::optional<std::uint64_t> read_frame_counter(const Image& tile) {
  const int cell = cell_px({tile.width_px, tile.height_px});
  if (cell == 0) return std::nullopt;
  std::uint64_t number = 0;
  for (int digit = 0; digit < kDigits; ++digit) {
    const auto value = read_digit(tile, digit, cell);
    if (!value) return std::nullopt;
    number = 10 * number + static_cast<std::uint64_t>(*value);
  }
  return number;
}

void draw_frame_counter(std::uint64_t number, const RectPx& tile, Picture& picture) {
  const Image image = frame_counter(number, tile.size);
  if (!image.empty()) picture.write(image, tile.x, tile.y);
}

}  // namespace vindu
