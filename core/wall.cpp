#include "core/wall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/sha256.h"

namespace vindu {
namespace {

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Where a column stands: its lower edge's middle on the x-z plane and its direction from left to
/// right.
struct ColumnPlace {
  Vec3 middle_in_wall;
  Vec3 right_in_wall;
};

/// Columns of a curved wall are chords of one circle whose axis is vertical and lies on the
/// viewer's side. The middle of the wall stays at the origin. Pitch: column width and bezel.
ColumnPlace place_column(const WallGrid& grid, int column, double pitch_m) {
  const double offset = column - 0.5 * (grid.columns - 1);
  if (grid.curve_deg == 0 || grid.columns == 1) return {{offset * pitch_m, 0, 0}, Vec3::UnitX()};
  const double step_rad = radians(grid.curve_deg) / (grid.columns - 1);
  const double to_chord_m = 0.5 * pitch_m / std::tan(0.5 * step_rad);
  const double angle_rad = offset * step_rad;
  const double nearest_m =
      grid.columns % 2 == 1 ? to_chord_m : to_chord_m / std::cos(0.5 * step_rad);
  return {{to_chord_m * std::sin(angle_rad), 0, nearest_m - to_chord_m * std::cos(angle_rad)},
          {std::cos(angle_rad), 0, std::sin(angle_rad)}};
}

TileCorners grid_corners(const WallGrid& grid, int column, int row) {
  const double bezel_x_m = 1e-3 * grid.bezel_x_mm, bezel_y_m = 1e-3 * grid.bezel_y_mm;
  const double width_m = (grid.width_m - (grid.columns - 1) * bezel_x_m) / grid.columns;
  const double height_m = (grid.height_m - (grid.rows - 1) * bezel_y_m) / grid.rows;
  const ColumnPlace place = place_column(grid, column, width_m + bezel_x_m);
  const Vec3 bottom = Vec3::UnitY() * (-0.5 * grid.height_m + row * (height_m + bezel_y_m));
  const Vec3 lower_left = place.middle_in_wall - 0.5 * width_m * place.right_in_wall + bottom;
  return {lower_left, lower_left + width_m * place.right_in_wall,
          lower_left + height_m * Vec3::UnitY()};
}

Tile grid_tile(const WallGrid& grid, int column, int row) {
  return {.column = column,
          .row = row,
          .name = tile_name(column, row),
          .host = expand_host(grid.hosts, column, row),
          .width_px = grid.tile_width_px,
          .height_px = grid.tile_height_px,
          .corners = grid_corners(grid, column, row),
          .mount = grid.mount};
}

}  // namespace

Vec3 TileCorners::normal_in_wall() const {
  return (lower_right_in_wall - lower_left_in_wall)
      .cross(upper_left_in_wall - lower_left_in_wall)
      .normalized();
}

Rigid3 TileCorners::wall_from_screen() const {
  Mat3 axes;
  axes.col(0) = (lower_right_in_wall - lower_left_in_wall).normalized();
  axes.col(2) = normal_in_wall();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return Rigid3::from(axes, centre_in_wall());
}

const Tile* Wall::find(std::string_view name) const {
  const auto found = std::ranges::find(tiles, name, &Tile::name);
  return found == tiles.end() ? nullptr : &*found;
}

std::optional<WallPoint> point_of_picture(const Wall& wall, const Vec2& at_px) {
  if (!at_px.allFinite()) return std::nullopt;
  const WallGrid& grid = wall.grid;
  const Vec2 in_tiles(at_px.x() / grid.tile_width_px, at_px.y() / grid.tile_height_px);
  const int column = static_cast<int>(std::clamp(in_tiles.x(), 0.0, grid.columns - 1.0));
  const int from_top = static_cast<int>(std::clamp(in_tiles.y(), 0.0, grid.rows - 1.0));
  const Tile* const tile = wall.find(tile_name(column, grid.rows - 1 - from_top));
  if (!tile) return std::nullopt;
  const double right = std::clamp(in_tiles.x() - column, 0.0, 1.0);
  const double down = std::clamp(in_tiles.y() - from_top, 0.0, 1.0);
  const TileCorners& corners = tile->corners;
  return WallPoint{tile, corners.upper_left_in_wall +
                             right * (corners.lower_right_in_wall - corners.lower_left_in_wall) +
                             down * (corners.lower_left_in_wall - corners.upper_left_in_wall)};
}

std::string tile_name(int column, int row) {
  return "tile-" + std::to_string(column) + "-" + std::to_string(row);
}

std::string expand_host(std::string_view pattern, int column, int row) {
  std::string host(pattern);
  replace_all(host, "{x}", std::to_string(column));
  replace_all(host, "{y}", std::to_string(row));
  return host;
}

Wall expand_wall(const WallGrid& grid, const std::vector<TileOverride>& overrides,
                 const Rigid3& room_from_wall) {
  Wall wall{.grid = grid, .tiles = {}, .room_from_wall = room_from_wall};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      wall.tiles.push_back(grid_tile(grid, column, row));
  for (const TileOverride& change : overrides) {
    const auto tile = std::ranges::find(wall.tiles, change.name, &Tile::name);
    if (tile == wall.tiles.end()) continue;
    if (change.corners) tile->corners = *change.corners;
    if (change.host) tile->host = *change.host;
    if (change.monitor) tile->monitor = *change.monitor;
    if (change.mount) tile->mount = *change.mount;
  }
  return wall;
}

std::string fingerprint_of(const Wall& wall) {
  std::string text;
  for (const Tile& tile : wall.tiles) {
    text += fmt::format("{} {} {} {} {}", tile.name, tile.width_px, tile.height_px,
                        tile.mount.mirror, tile.mount.rotate_deg);
    for (const Vec3& corner : {tile.corners.lower_left_in_wall, tile.corners.lower_right_in_wall,
                               tile.corners.upper_left_in_wall})
      for (const double metres : corner) text += fmt::format(" {}", std::llround(1e6 * metres));
    text += "\n";
  }
  return sha256_of_text(text).substr(0, 16);
}

Wall single_screen(double width_m, double height_m, int width_px, int height_px) {
  WallGrid grid;
  grid.width_m = width_m;
  grid.height_m = height_m;
  grid.tile_width_px = width_px;
  grid.tile_height_px = height_px;
  return expand_wall(grid, {}, room_from_wall_at(kDefaultCentreHeight_m, 0));
}

Rigid3 room_from_wall_at(double centre_height_m, double tilt_deg) {
  return {Quat(Eigen::AngleAxisd(radians(tilt_deg), Vec3::UnitX())), {0, centre_height_m, 0}};
}

}  // namespace vindu
