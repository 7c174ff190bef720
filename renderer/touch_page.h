// The page that a wall shows while somebody holds an LED to points of it, one after the other. It
// is a value, and what a tile shows of it follows from the page and the tile's corners alone: tiles
// of one process or of many agree, rings that lie across a seam meet there.
#pragma once

#include <string>
#include <vector>

#include "core/wall.h"
#include "renderer/image.h"

namespace vindu {

struct TouchPage {
  struct Point {
    Vec3 x_in_wall = Vec3::Zero();
    std::string tile{};  ///< the one that says what to do here
  };
  std::vector<Point> points{};  ///< in the order in which they are touched
  std::size_t done = 0;         ///< so many are
  double held = 0;              ///< 0 to 1: how long the LED has been at the next one
  std::string remark{};         ///< why what is seen does not count; or ""
  double ring_m = 0.1;          ///< radius of the mark about the next point

  bool operator==(const TouchPage&) const = default;
};

/// Where a point of the wall stands on a picture of this size that fills the tile: pixels from its
/// upper left, pixel i from i to i + 1. Of a point off the tile's plane: where its foot stands.
Vec2 pixel_of(const TileCorners& tile, const Vec3& x_in_wall, SizePx size);

/// What the tile shows, upright as it is seen; Surface's side mirrors and turns it as it is
/// mounted. Throws Error when the font is not there.
Image draw_touch_page(const TouchPage& page, const Tile& tile, SizePx size);

}  // namespace vindu
