// The wall: its tiles' corners in the frame wall (origin at the centre of the screen plane, +x
// right and +y up as the viewer sees it, +z towards the viewer; metres), expanded from a grid of a
// few numbers (thesis 3.5.1) with exceptions for single tiles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rigid3.h"

namespace vindu {

/// The three corners that fix a tile's picture: pixel columns run from lower left to lower right,
/// rows from upper left down to lower left.
struct TileCorners {
  Vec3 lower_left_in_wall = Vec3::Zero();
  Vec3 lower_right_in_wall = Vec3::Zero();
  Vec3 upper_left_in_wall = Vec3::Zero();

  Vec3 upper_right_in_wall() const {
    return lower_right_in_wall + upper_left_in_wall - lower_left_in_wall;
  }
  Vec3 centre_in_wall() const { return 0.5 * (lower_right_in_wall + upper_left_in_wall); }
  /// Unit vector out of the screen, towards the viewer.
  Vec3 normal_in_wall() const;
  /// The picture's own frame: origin at its centre, +x along its rows, +z towards the viewer.
  Rigid3 wall_from_screen() const;
  double width_m() const { return (lower_right_in_wall - lower_left_in_wall).norm(); }
  double height_m() const { return (upper_left_in_wall - lower_left_in_wall).norm(); }
};

/// How a projector or monitor has to be fed so that the viewer sees the picture upright: first
/// mirrored (a projector behind the screen), then turned clockwise.
struct TileMount {
  bool mirror = false;
  int rotate_deg = 0;  ///< 0, 90, 180 or 270

  bool operator==(const TileMount&) const = default;
};

struct Tile {
  int column = 0;  ///< from the left
  int row = 0;     ///< from the bottom
  std::string name;
  std::string host;
  std::string monitor{};  ///< of its host, by the output's name ("HDMI-1"); empty: the primary one
  int width_px = 0;
  int height_px = 0;
  TileCorners corners;
  TileMount mount;
};

/// The grid shorthand of wall.toml. The outer size counts pictures and the bezels between them, not
/// those around.
struct WallGrid {
  int columns = 1;
  int rows = 1;
  double width_m = 0;
  double height_m = 0;
  int tile_width_px = 0;
  int tile_height_px = 0;
  double bezel_x_mm = 0;  ///< gap between the pictures of neighbouring columns
  double bezel_y_mm = 0;
  double curve_deg = 0;  ///< angle between the outer columns' normals; columns are flat, the wall
                         ///< bends around the viewer
  std::string hosts = "tile-{x}-{y}";
  TileMount mount;

  bool operator==(const WallGrid&) const = default;
};

/// What a [[tile]] table says otherwise of one tile.
struct TileOverride {
  std::string name;
  std::optional<TileCorners> corners;
  std::optional<std::string> host;
  std::optional<std::string> monitor{};
  std::optional<TileMount> mount;
};

struct Wall {
  WallGrid grid;
  std::vector<Tile> tiles;  ///< row by row from the lower left
  Rigid3 room_from_wall;    ///< height and tilt

  const Tile* find(std::string_view name) const;
  /// The whole picture, without the bezels: all columns side by side, all rows.
  Vec2 picture_px() const {
    return {grid.columns * grid.tile_width_px, grid.rows * grid.tile_height_px};
  }
  /// One pixel's size for everything that decides quality, the same on all tiles.
  double pixel_pitch_m() const { return grid.width_m / (grid.columns * grid.tile_width_px); }
};

/// A point of the screen, and the tile that it lies on.
struct WallPoint {
  const Tile* tile = nullptr;
  Vec3 in_wall = Vec3::Zero();
};

/// Where a point of the wall's picture is: pixels from its upper left corner, x to the right, y
/// down, as touch systems count (TUIO). What lies beside the picture counts as its edge. Empty
/// where the wall has no such tile, or for what is not finite. Of `wall`'s tiles.
std::optional<WallPoint> point_of_picture(const Wall& wall, const Vec2& at_px);

/// Near plane of every tile: a constant of the wall, so that depth agrees at the seams.
constexpr double kNear_m = 0.01;

std::string tile_name(int column, int row);

/// "tile-{x}-{y}" with the numbers put in.
std::string expand_host(std::string_view pattern, int column, int row);

/// All tiles of the grid, then the exceptions. Expects validated values (core/site reads and checks
/// them).
Wall expand_wall(const WallGrid& grid, const std::vector<TileOverride>& overrides,
                 const Rigid3& room_from_wall);

/// Of what the tiles show together: their names, pixels, mounts, and corners in whole micrometres.
/// 16 hexadecimal digits.
std::string fingerprint_of(const Wall& wall);

/// A wall of one tile: one screen of the given size.
Wall single_screen(double width_m, double height_m, int width_px, int height_px);

/// Height of the wall's centre above the floor and its tilt: positive leans the upper edge towards
/// the viewer.
Rigid3 room_from_wall_at(double centre_height_m, double tilt_deg);

constexpr double kDefaultCentreHeight_m = 1.55;

}  // namespace vindu
