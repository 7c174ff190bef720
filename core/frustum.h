// The off-axis frustum of a tile: R. Kooima, "Generalized Perspective Projection" (2009), from the
// tile's corners and the eye, in double precision, and the thesis' way of writing the same (eq. 3.2
// and 3.3). Depth is reversed and infinite: 1 at the near plane, 0 at infinity (glClipControl zero
// to one).
#pragma once

#include <optional>

#include "core/wall.h"

namespace vindu {

/// Extents on the plane at distance near, relative to the foot of the perpendicular from the eye;
/// metres.
struct FrustumExtents {
  double left_m = 0;
  double right_m = 0;
  double bottom_m = 0;
  double top_m = 0;
};

/// Distance from the eye to the tile's plane, positive in front of it; metres.
double distance_to_tile(const TileCorners& corners, const Vec3& eye_in_wall);

/// Kooima's l, r, b, t. Empty when the eye is at or behind the tile's plane (nearer than kNear_m),
/// or is no number.
std::optional<FrustumExtents> frustum_extents(const TileCorners& corners, const Vec3& eye_in_wall,
                                              double near_m);

/// clip = clip_from_wall * (x_in_wall, 1), with -w <= x, y <= w and depth z/w = near_m / (distance
/// along the normal). Exact for any three corners, also where measured ones are not quite at right
/// angles; equals Kooima's matrix where they are. With A = [right edge, up edge, lower left - eye]
/// and (a, b, g) = A^-1 (x - eye), the ray through x meets the tile at fractions (a/g, b/g) of its
/// edges, and g is 1 on the tile's plane. Empty as frustum_extents is.
std::optional<Mat4> clip_from_wall(const TileCorners& corners, const Vec3& eye_in_wall,
                                   double near_m = kNear_m);

/// Thesis eq. 3.2: a tile's l, r, b, t on the screen plane, for an eye on the axis of the wall.
/// Flat walls, no bezels.
FrustumExtents thesis_tile_extents(const WallGrid& grid, int column, int row);

/// The thesis' camera event (4.1.4): what the server of OSGDWL sends to every tile.
struct CameraEvent {
  Vec3 position_in_wall = Vec3::Zero();
  Quat rotation = Quat::Identity();  ///< of the wall, never of the head
  FrustumExtents relative;           ///< added by each tile to its own extents (eq. 3.3)
  double near_m = 0;
  double far_m = 0;  ///< infinity
  double distance_m = 0;
};

/// m_l = m_r = -e_x, m_b = m_t = -e_y, distance = e_z.
CameraEvent camera_event_from(const Vec3& eye_in_wall, double near_m = kNear_m);

/// Thesis eq. 3.3.
FrustumExtents add(const FrustumExtents& tile, const FrustumExtents& relative);

}  // namespace vindu
