// The pattern eye: two drawings to one scale, from above (x to the right, the viewer below) and
// from the left (the viewer on the right of it, y up).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/frustum.h"
#include "renderer/diagram.h"
#include "renderer/pattern_pages.h"
#include "renderer/tile_surface.h"

namespace vindu {
namespace {

constexpr Rgba8 kRaster{48, 54, 64, 255};
constexpr Rgba8 kGlass{86, 180, 233, 70};

/// One of both drawings: which axes of wall lie to the right and down the page.
struct Elevation {
  Vec2 least_px, largest_px;  // its place on the page
  Vec3 right, down;           // unit vectors in wall
  Vec2 middle_m;              // what is shown in the middle of its place
  double px_a_m = 1;

  Vec2 px_of(const Vec3& x_in_wall) const {
    const Vec2 at_m(right.dot(x_in_wall), down.dot(x_in_wall));
    // An eye may be anywhere; nothing far outside the page is told apart.
    const Vec2 px = 0.5 * (least_px + largest_px) + px_a_m * (at_m - middle_m);
    return px.cwiseMax(Vec2(-1e5, -1e5)).cwiseMin(Vec2(1e5, 1e5));
  }
};

/// What both drawings have room for, in wall: the wall, and before it as far as it is wide.
struct Stage {
  Vec3 least, largest;
};

Stage stage_of(const Wall& wall) {
  Stage stage;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec2 extent = extent_of(wall, axis);
    stage.least[axis] = extent[0];
    stage.largest[axis] = extent[1];
  }
  const double width_m = stage.largest.x() - stage.least.x(),
               height_m = stage.largest.y() - stage.least.y(), size_m = std::max(width_m, height_m);
  stage.least -= Vec3(0.1 * size_m, 0.1 * size_m, 0.25 * size_m);
  stage.largest += Vec3(0.1 * size_m, 0.1 * size_m, 0.9 * size_m);
  return stage;
}

/// From above on the left, from the left on the right, below a strip for words.
std::array<Elevation, 2> elevations(const Stage& stage, SizePx size) {
  const double top = 0.17 * size.height, share = 0.5 * size.width, margin = size.width / 64.0;
  const Vec3 room_m = stage.largest - stage.least, middle = 0.5 * (stage.largest + stage.least);
  const double px_a_m = std::min({(share - 1.5 * margin) / std::max(room_m.x(), room_m.z()),
                                  (size.height - top - margin) / std::max(room_m.y(), room_m.z())});
  const Vec2 low(margin, top), high(share - 0.5 * margin, size.height - margin);
  const Vec2 across(share - 0.5 * margin, 0);
  return {{{low, high, Vec3::UnitX(), Vec3::UnitZ(), {middle.x(), middle.z()}, px_a_m},
           {low + across,
            high + across,
            Vec3::UnitZ(),
            -Vec3::UnitY(),
            {middle.z(), -middle.y()},
            px_a_m}}};
}

void draw_raster(Diagram& page, const Elevation& view, const Stage& stage, double step_m) {
  for (int axis = 0; axis < 3; ++axis)
    for (double at = step_m * std::ceil(stage.least[axis] / step_m); at <= stage.largest[axis];
         at += step_m) {
      Vec3 from = stage.least, to = stage.largest;
      from[axis] = to[axis] = at;
      const Vec2 from_px = view.px_of(from), to_px = view.px_of(to);
      if (from_px.x() == to_px.x() || from_px.y() == to_px.y())
        page.line(from_px, to_px, 1, kRaster);
    }
}

/// Corners of a tile, one after the other around it.
std::array<Vec3, 4> outline(const TileCorners& corners) {
  return {corners.lower_left_in_wall, corners.lower_right_in_wall, corners.upper_right_in_wall(),
          corners.upper_left_in_wall};
}

void draw_tile(Diagram& page, const Elevation& view, const TileCorners& corners, double width_px,
               Rgba8 colour) {
  const auto around = outline(corners);
  for (std::size_t i = 0; i < around.size(); ++i)
    page.line(view.px_of(around[i]), view.px_of(around[(i + 1) % around.size()]), width_px, colour);
}

/// The outermost rays of the eye to the tile and on behind it.
void draw_frustum(Diagram& page, const Elevation& view, const TileCorners& corners, const Vec3& eye,
                  double width_px) {
  const Vec2 eye_px = view.px_of(eye);
  const auto angle = [&](const Vec3& corner, const Vec2& middle) {
    const Vec2 way = view.px_of(corner) - eye_px;
    return std::atan2(middle.x() * way.y() - middle.y() * way.x(), middle.dot(way));
  };
  const Vec2 middle = view.px_of(corners.centre_in_wall()) - eye_px;
  const auto around = outline(corners);
  const auto [least, largest] =
      std::ranges::minmax_element(around, {}, [&](const Vec3& c) { return angle(c, middle); });
  const std::array<Vec2, 3> glass = {eye_px, view.px_of(*least), view.px_of(*largest)};
  page.polygon(glass, kGlass);
  for (const Vec3& corner : {*least, *largest})
    page.line(eye_px, eye_px + 3 * (view.px_of(corner) - eye_px), width_px, kSky);
}

std::string words_of_eye(const Vec3& eye) {
  return fmt::format("eye x {:.3f}  y {:.3f}  z {:.3f} m", eye.x(), eye.y(), eye.z());
}

std::string words_of_tile(const Tile& tile, const Vec3& eye) {
  const auto extents = frustum_extents(tile.corners, eye, 1);
  if (!extents) return tile.name + ": the eye is at or behind its plane, it is black";
  const auto angle_deg = [](double low, double high) {
    return (std::atan(high) - std::atan(low)) * 180 / kPi;
  };
  return fmt::format("{}: {:.3f} m before its plane, {:.1f} x {:.1f} degrees", tile.name,
                     distance_to_tile(tile.corners, eye),
                     angle_deg(extents->left_m, extents->right_m),
                     angle_deg(extents->bottom_m, extents->top_m));
}

}  // namespace

Image draw_eye(const FrameState& state, const Wall& wall, const Tile& tile, SizePx size) {
  Diagram page(size, kNight);
  const Stage stage = stage_of(wall);
  const Vec3 eye = state.eye_in_wall.array().isFinite().select(state.eye_in_wall, 0.0);
  const double line_px = std::max(1.0, size.height / 384.0);
  const double step_m =
      std::pow(10.0, std::floor(std::log10(0.5 * (stage.largest - stage.least).maxCoeff())));
  const TextStyle words{.height_px = size.height / 18.0, .colour = kNightWords};
  const TextStyle small{.height_px = size.height / 30.0, .colour = kNightWords};
  const char* captions[] = {"from above", "from the left"};
  for (int i = 0; const Elevation& view : elevations(stage, size)) {
    page.clip(view.least_px, view.largest_px);
    draw_raster(page, view, stage, step_m);
    for (const Tile& other : wall.tiles) draw_tile(page, view, other.corners, line_px, kNightWords);
    if (frustum_extents(tile.corners, eye, 1))
      draw_frustum(page, view, tile.corners, eye, 0.7 * line_px);
    draw_tile(page, view, tile.corners, 3 * line_px, kVermilion);
    page.disc(view.px_of(eye), 4 * line_px, kOrange);
    page.text({view.least_px.x(), view.largest_px.y() - 1.2 * small.height_px},
              fmt::format("{}, lines {:.4g} m apart", captions[i++], step_m), small);
  }
  page.text({size.width / 64.0, 0.02 * size.height}, words_of_eye(eye), words);
  page.text({size.width / 64.0, 0.02 * size.height + 1.25 * words.height_px},
            words_of_tile(tile, eye), small);
  return page.image();
}

}  // namespace vindu
