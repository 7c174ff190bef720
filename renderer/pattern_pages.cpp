#include "renderer/pattern_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/diagram.h"
#include "renderer/tile_surface.h"

namespace vindu {
namespace {

constexpr Rgba8 kName{255, 255, 255, 255};
constexpr std::array<Rgba8, 2> kGrounds{{kNight, {44, 50, 60, 255}}};

/// As high as asked, or as fits the width.
TextStyle fitted(const std::string& words, TextStyle style, double width_px) {
  const double asked_px = text_width_px(words, style);
  if (asked_px > width_px) style.height_px *= width_px / asked_px;
  return style;
}

/// From the picture's upper middle: where the wall's up is on this tile.
void draw_up(Diagram& page, const Vec2& middle_px, const Vec2& up, double length_px) {
  const Vec2 aside(-up.y(), up.x()), tip = middle_px + 0.5 * length_px * up,
                                     neck = tip - 0.4 * length_px * up;
  const std::array<Vec2, 3> head = {tip, neck + 0.3 * length_px * aside,
                                    neck - 0.3 * length_px * aside};
  page.line(neck, neck - 0.6 * length_px * up, 0.16 * length_px, kSky);
  page.polygon(head, kSky);
  const double text_px = 0.3 * length_px;
  page.text(middle_px + Vec2(0.5 * length_px, -0.5 * text_px), "up",
            {.height_px = text_px, .colour = kSky});
}

void draw_lower_left(Diagram& page, SizePx size) {
  const double arm_px = size.height / 6.0, width_px = size.height / 48.0;
  page.rectangle({0, size.height - arm_px}, {width_px, size.height}, kVermilion);
  page.rectangle({0, size.height - width_px}, {arm_px, size.height}, kVermilion);
  const TextStyle style{.height_px = size.height / 20.0, .colour = kVermilion};
  page.text({2 * width_px, size.height - width_px - 1.3 * style.height_px}, "lower left", style);
}

std::array<std::string, 4> lines_of(const Tile& tile) {
  return {"host " + tile.host + (tile.monitor.empty() ? "" : ", " + tile.monitor),
          fmt::format("{} x {} px, {:.3f} x {:.3f} m", tile.width_px, tile.height_px,
                      tile.corners.width_m(), tile.corners.height_m()),
          fmt::format("column {} from the left, row {} from the bottom", tile.column, tile.row),
          "mount: " + text_of(tile.mount)};
}

void draw_frame(Diagram& page, SizePx size, double width_px, Rgba8 colour) {
  const Vec2 whole(size.width, size.height);
  page.rectangle({0, 0}, {whole.x(), width_px}, colour);
  page.rectangle({0, whole.y() - width_px}, whole, colour);
  page.rectangle({0, 0}, {width_px, whole.y()}, colour);
  page.rectangle({whole.x() - width_px, 0}, whole, colour);
}

/// As bright as the eye takes it, 0 to 255 (BT.601).
double luma(const Rgba8& colour) {
  return 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2];
}

/// A row of sixteen levels, each named: on coarse steps clearly, on fine ones so that it does not
/// dazzle.
void draw_steps(Image& image, int row, const std::array<bool, 3>& primaries, int first_level,
                int step) {
  constexpr int kRows = 6, kSteps = 16;
  const int top = row * image.height_px / kRows, bottom = (row + 1) * image.height_px / kRows;
  TextStyle style{.height_px = std::min(image.width_px / 40.0, (bottom - top) / 4.0)};
  for (int i = 0; i < kSteps; ++i) {
    const int left = i * image.width_px / kSteps, right = (i + 1) * image.width_px / kSteps;
    const int level = first_level + i * step;
    Rgba8 colour{0, 0, 0, 255};
    for (std::size_t part = 0; part < 3; ++part)
      if (primaries[part]) colour[part] = static_cast<std::uint8_t>(level);
    for (int y = top; y < bottom; ++y)
      std::fill_n(image.pixels.begin() + std::ptrdiff_t{y} * image.width_px + left, right - left,
                  colour);
    if (style.height_px < 6) continue;
    const bool dark = luma(colour) < 128;
    const std::uint8_t grey = step > 1 ? (dark ? 255 : 0) : (dark ? 90 : 165);
    style.colour = {grey, grey, grey, 255};
    const std::string name = std::to_string(level);
    draw_text(image, (left + right - text_width_px(name, style)) / 2,
              bottom - static_cast<int>(1.5 * style.height_px), name, style);
  }
}

}  // namespace

std::string text_of(const TileMount& mount) {
  const std::string turn = fmt::format("turned {} degrees clockwise", mount.rotate_deg);
  if (mount.rotate_deg == 0) return mount.mirror ? "mirrored" : "as it is";
  return mount.mirror ? "mirrored, " + turn : turn;
}

Image draw_names(const Tile& tile, SizePx size) {
  Diagram page(size, kGrounds[static_cast<std::size_t>(tile.column + tile.row) % 2]);
  const double height = size.height, middle = 0.5 * size.width, room = 0.92 * size.width;
  draw_frame(page, size, std::max(1.0, std::round(height / 384)), kNightWords);
  const TileSurface surface = surface_of(tile.corners, size);
  const Vec2 up = surface.metres_from_px.leftCols<2>().inverse() * Vec2(0, 1);
  draw_up(page, {middle, 0.15 * height}, up.normalized(), 0.2 * height);
  draw_lower_left(page, size);
  const TextStyle name =
      fitted(tile.name, {.height_px = 0.26 * height, .colour = kName, .bold = true}, room);
  page.text({middle, 0.39 * height - 0.5 * name.height_px}, tile.name, name,
            Diagram::Align::middle);
  double top = 0.53 * height;
  for (const std::string& line : lines_of(tile)) {
    page.text({middle, top}, line,
              fitted(line, {.height_px = 0.07 * height, .colour = kNightWords}, room),
              Diagram::Align::middle);
    top += 0.085 * height;
  }
  return page.image();
}

Image draw_ramps(SizePx size) {
  constexpr std::array<bool, 3> kGrey{true, true, true}, kRed{true, false, false},
      kGreen{false, true, false}, kBlueOnly{false, false, true};
  Image image = Image::filled(size.width, size.height, {0, 0, 0, 255});
  int row = 0;
  for (const auto& primaries : {kGrey, kRed, kGreen, kBlueOnly})
    draw_steps(image, row++, primaries, 0, 17);
  draw_steps(image, row++, kGrey, 0, 1);
  draw_steps(image, row, kGrey, 240, 1);
  return image;
}

}  // namespace vindu
