#include "renderer/tile_surface.h"

#include <Eigen/LU>

namespace vindu {

Vec2 TileSurface::px_at(const Vec2& point_m) const {
  return metres_from_px.leftCols<2>().inverse() * (point_m - metres_from_px.col(2));
}

TileSurface surface_of(const TileCorners& corners, SizePx size) {
  int dropped = 0;
  corners.normal_in_wall().cwiseAbs().maxCoeff(&dropped);
  TileSurface surface{.across = dropped == 0 ? 2 : 0, .up = dropped == 1 ? 2 : 1};
  const auto part = [&](const Vec3& in_wall) {
    return Vec2(in_wall[surface.across], in_wall[surface.up]);
  };
  const Vec3 right = corners.lower_right_in_wall - corners.lower_left_in_wall,
             up = corners.upper_left_in_wall - corners.lower_left_in_wall;
  surface.metres_from_px << part(right) / size.width, -part(up) / size.height,
      part(corners.upper_left_in_wall);
  return surface;
}

Vec2 extent_of(const Wall& wall, int axis) {
  Vec2 extent(1e300, -1e300);
  for (const Tile& tile : wall.tiles) {
    const TileCorners& corners = tile.corners;
    for (const Vec3& corner : {corners.lower_left_in_wall, corners.lower_right_in_wall,
                               corners.upper_left_in_wall, corners.upper_right_in_wall()}) {
      extent[0] = std::min(extent[0], corner[axis]);
      extent[1] = std::max(extent[1], corner[axis]);
    }
  }
  return extent;
}

}  // namespace vindu
