#include "renderer/pattern_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "renderer/diagram.h"
#include "renderer/tile_surface.h"

namespace vindu {
namespace {

constexpr Rgba8 kBlack{0, 0, 0, 255};
constexpr Rgba8 kWhite{255, 255, 255, 255};
constexpr Rgba8 kGrey{96, 96, 96, 255};
constexpr Rgba8 kGreen{0, 255, 0, 255};

/// Share of a pixel's width that a line covers whose middle is so far from the pixel's.
double line_cover(double distance_px, double width_px) {
  return std::clamp(0.5 * width_px + 0.5 - std::abs(distance_px), 0.0, 1.0);
}

/// How far a value is from the nearest multiple of the step. Of every pixel: std::round is a call.
double off_step(double value, double step) {
  const double steps = value / step;
  return value -
         step * static_cast<double>(static_cast<std::int64_t>(steps + (steps < 0 ? -0.5 : 0.5)));
}

/// Parallel lines: where `across` (a unit vector) times the coordinates is a multiple of the step;
/// the one at 0 alone where there is no step.
struct Lines {
  Vec2 across;
  double step_m;
  double width_px;
  Rgba8 colour;
};

void draw_lines(Image& image, const TileSurface& surface, const Lines& lines) {
  const Eigen::RowVector3d value = lines.across.transpose() * surface.metres_from_px;
  const double px_m = surface.metres_a_px(lines.across);
  if (!(px_m > 0)) return;  // the tile lies along the lines
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const double at_m = value[0] * (x + 0.5) + value[1] * (y + 0.5) + value[2];
      const double off_m = lines.step_m > 0 ? off_step(at_m, lines.step_m) : at_m;
      const double cover = line_cover(off_m / px_m, lines.width_px);
      if (cover > 0) blend(image.at(x, y), lines.colour, cover);
    }
}

/// About the wall's middle, one circle a step.
void draw_circles(Image& image, const TileSurface& surface, double step_m, double width_px) {
  const double near_m = (0.5 * width_px + 0.5) * surface.metres_from_px.leftCols<2>().norm();
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const Vec2 at_m = surface.metres_at({x + 0.5, y + 0.5});
      const double radius_m = at_m.norm();
      if (radius_m < 0.5 * step_m) continue;
      const double off_m = off_step(radius_m, step_m);
      if (std::abs(off_m) > near_m) continue;
      const double off_px = off_m / surface.metres_a_px(at_m / radius_m);
      blend(image.at(x, y), kSky, line_cover(off_px, width_px));
    }
}

/// As round as the tile's pixels make it, in the tile's own plane.
void draw_tile_circle(Image& image, const TileCorners& corners, double width_px) {
  const Vec2 px_m(corners.width_m() / image.width_px, corners.height_m() / image.height_px);
  const Vec2 middle_px(0.5 * image.width_px, 0.5 * image.height_px);
  const double radius_m = 0.45 * std::min(corners.width_m(), corners.height_m());
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const Vec2 at_m = (Vec2(x + 0.5, y + 0.5) - middle_px).cwiseProduct(px_m);
      const double distance_m = at_m.norm();
      if (std::abs(distance_m - radius_m) > (0.5 * width_px + 0.5) * px_m.norm()) continue;
      const double off_px = (distance_m - radius_m) / at_m.cwiseProduct(px_m).norm() * distance_m;
      blend(image.at(x, y), kYellow, line_cover(off_px, width_px));
    }
}

/// The outermost pixels, and a cross over the middle one, or over the middle two or four.
void draw_border(Image& image) {
  const int right = image.width_px - 1, bottom = image.height_px - 1;
  for (int x = 0; x <= right; ++x) image.at(x, 0) = image.at(x, bottom) = kGreen;
  for (int y = 0; y <= bottom; ++y) image.at(0, y) = image.at(right, y) = kGreen;
  const int arm_px = std::min(right, bottom) / 12;
  for (int off = -arm_px; off <= arm_px; ++off)
    for (const int x : {right / 2, (right + 1) / 2})
      for (const int y : {bottom / 2, (bottom + 1) / 2})
        image.at(x + off, y) = image.at(x, y + off) = kGreen;
}

/// The coordinates of the bold lines' crossings on this tile, beside them.
void label_crossings(Image& image, const TileSurface& surface, double step_m) {
  const TextStyle style{.height_px = std::min(image.height_px / 32.0, 28.0), .colour = kWhite};
  if (style.height_px < 7) return;
  Vec2 least(1e300, 1e300), largest(-1e300, -1e300);
  for (const Vec2& corner : {Vec2(0, 0), Vec2(image.width_px, 0), Vec2(0, image.height_px),
                             Vec2(image.width_px, image.height_px)}) {
    least = least.cwiseMin(surface.metres_at(corner));
    largest = largest.cwiseMax(surface.metres_at(corner));
  }
  constexpr int kMost = 64;  // a side; a tile far larger than the others has no room for more
  const Vec2 first = (least / step_m).array().ceil(), last = (largest / step_m).array().floor();
  if ((last - first).maxCoeff() > kMost) return;
  for (double up = first.y(); up <= last.y(); ++up)
    for (double across = first.x(); across <= last.x(); ++across) {
      const Vec2 px = surface.px_at(step_m * Vec2(across, up));
      draw_text(image, static_cast<int>(px.x()) + 5, static_cast<int>(px.y()) + 3,
                fmt::format("{} {:.4g}, {} {:.4g}", "xyz"[surface.across], step_m * across,
                            "xyz"[surface.up], step_m * up),
                style);
    }
}

/// Thin lines that are still seen on a tile of many pixels.
double thin_px(SizePx size) { return std::max(1.0, std::round(size.height / 1000.0)); }

}  // namespace

double grid_step_m(const Wall& wall) {
  const double height_m = std::min(wall.grid.width_m, wall.grid.height_m);
  double step_m = 0.1;
  while (height_m > 100 * step_m) step_m *= 10;
  while (height_m < 5 * step_m) step_m /= 10;
  return step_m;
}

Image draw_grid(const Wall& wall, const Tile& tile, SizePx size) {
  Image image = Image::filled(size.width, size.height, kBlack);
  const TileSurface surface = surface_of(tile.corners, size);
  const double fine_m = grid_step_m(wall), bold_m = 5 * fine_m, thin = thin_px(size);
  for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1)})
    if (fine_m > 4 * thin * surface.metres_a_px(axis))
      draw_lines(image, surface, {axis, fine_m, thin, kGrey});
  for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1)})
    draw_lines(image, surface, {axis, bold_m, 2 * thin, kWhite});
  draw_circles(image, surface, bold_m, 2 * thin);
  draw_tile_circle(image, tile.corners, 2 * thin);
  for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1)})
    draw_lines(image, surface, {axis, 0, 2 * thin, kVermilion});
  label_crossings(image, surface, bold_m);
  draw_border(image);
  return image;
}

Image draw_seams(const Wall& wall, const Tile& tile, SizePx size) {
  constexpr double kClimb = 1.0 / 12;
  Image image = Image::filled(size.width, size.height, kBlack);
  const TileSurface surface = surface_of(tile.corners, size);
  const double row_m = wall.grid.height_m / wall.grid.rows;
  const double thin = thin_px(size);
  const Vec2 level = Vec2(-kClimb, 1).normalized(), steep = Vec2(1, kClimb).normalized();
  for (const Lines& lines :
       {Lines{level, row_m / 2, 9 * thin, kSky}, Lines{steep, row_m / 2, 9 * thin, kOrange}})
    draw_lines(image, surface, lines);
  for (const Vec2& across : {Vec2(1, 1), Vec2(1, -1)})
    draw_lines(image, surface, {across.normalized(), row_m / 4, thin, kWhite});
  return image;
}

}  // namespace vindu
