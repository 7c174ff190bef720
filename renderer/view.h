// How a world is seen: the matrix that takes it to clip space, the eye, and how fine it must be.
// The world of a tile is the wall's frame; the world of a picture of the laboratory is the room's.
#pragma once

#include <optional>

#include "core/frustum.h"
#include "core/wall.h"
#include "renderer/detail.h"
#include "renderer/image.h"

namespace vindu {

struct View {
  Mat4 clip_from_world;
  Vec3 eye_in_world;
  DetailNeed detail{};  ///< of all that the eye sees at once, however many views show it
};

/// Empty when the eye is at or behind the tile's plane.
std::optional<View> tile_view(const TileCorners& corners, const Vec3& eye_in_wall);

/// A rectangle of a tile's pixels as a tile of its own: a window on a screen. Pixels count from the
/// tile's upper left.
TileCorners part_of_tile(const Tile& tile, const Vec2& upper_left_px, SizePx size);

struct Camera {
  Vec3 eye_in_world = Vec3::Zero();
  Vec3 target_in_world = -Vec3::UnitZ();
  double fov_y_rad = 0.8;
  double aspect = 16.0 / 9;
};

/// An ordinary symmetric view: through a screen of the given angle, 1 m before the eye, upright in
/// y.
View camera_view(const Camera& camera);

/// The camera that has the whole wall in view from an eye, looking at the middle of what it sees of
/// it; never wider than 120 degrees high or 140 degrees wide, so that a picture of it can be looked
/// at.
Camera camera_on_wall(const Wall& wall, const Vec3& eye_in_wall, double aspect);

/// World directions of the rays through the picture: direction = matrix * (x, y, 1) for x, y from
/// -1 to 1.
Mat3 direction_from_ndc(const View& view);

}  // namespace vindu
