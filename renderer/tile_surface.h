// Where a tile's pixels are on the wall, for pictures that are drawn in metres of it: two of the
// wall's axes, those that the tile's plane is not across, as a function of the pixel.
#pragma once

#include "core/wall.h"
#include "renderer/image.h"

namespace vindu {

/// Pixels count from the upper left of the tile's picture; the first one's centre is (0.5, 0.5).
/// A side of a room shows z instead of x, a floor z instead of y.
struct TileSurface {
  int across = 0;  ///< which of wall's axes the pictures' first coordinate is: x or z
  int up = 1;      ///< and the second: y or z
  Eigen::Matrix<double, 2, 3> metres_from_px = Eigen::Matrix<double, 2, 3>::Zero();

  Vec2 metres_at(const Vec2& point_px) const { return metres_from_px * point_px.homogeneous(); }
  Vec2 px_at(const Vec2& point_m) const;
  /// Metres along `direction` of these coordinates in one pixel, where that is steepest.
  double metres_a_px(const Vec2& direction) const {
    return (direction.transpose() * metres_from_px.leftCols<2>()).norm();
  }
};

TileSurface surface_of(const TileCorners& corners, SizePx size);

/// The wall's corners along one of its axes: from the least to the largest, metres.
Vec2 extent_of(const Wall& wall, int axis);

}  // namespace vindu
