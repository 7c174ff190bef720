#include "core/frustum.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace vindu {
namespace {

/// False also for an eye that is no number or infinitely far away.
bool is_in_front(double distance_m) { return distance_m > kNear_m && std::isfinite(distance_m); }

}  // namespace

double distance_to_tile(const TileCorners& corners, const Vec3& eye_in_wall) {
  return corners.normal_in_wall().dot(eye_in_wall - corners.lower_left_in_wall);
}

std::optional<FrustumExtents> frustum_extents(const TileCorners& corners, const Vec3& eye_in_wall,
                                              double near_m) {
  const double distance_m = distance_to_tile(corners, eye_in_wall);
  if (!is_in_front(distance_m)) return std::nullopt;
  const Vec3 right = (corners.lower_right_in_wall - corners.lower_left_in_wall).normalized();
  const Vec3 up = corners.normal_in_wall().cross(right);
  const double scale = near_m / distance_m;
  return FrustumExtents{.left_m = scale * right.dot(corners.lower_left_in_wall - eye_in_wall),
                        .right_m = scale * right.dot(corners.lower_right_in_wall - eye_in_wall),
                        .bottom_m = scale * up.dot(corners.lower_left_in_wall - eye_in_wall),
                        .top_m = scale * up.dot(corners.upper_left_in_wall - eye_in_wall)};
}

std::optional<Mat4> clip_from_wall(const TileCorners& corners, const Vec3& eye_in_wall,
                                   double near_m) {
  const double distance_m = distance_to_tile(corners, eye_in_wall);
  if (!is_in_front(distance_m)) return std::nullopt;
  Mat3 edges;
  edges << corners.lower_right_in_wall - corners.lower_left_in_wall,
      corners.upper_left_in_wall - corners.lower_left_in_wall,
      corners.lower_left_in_wall - eye_in_wall;
  const Mat3 fractions = edges.inverse();
  const Eigen::RowVector3d depth = distance_m * fractions.row(2);
  Eigen::Matrix<double, 3, 3> rows;  // of x, y and w
  rows << distance_m * (2 * fractions.row(0) - fractions.row(2)),
      distance_m * (2 * fractions.row(1) - fractions.row(2)), depth;
  const Vec3 offsets = -rows * eye_in_wall;
  Mat4 clip = Mat4::Zero();
  clip.row(0) << rows.row(0), offsets.x();
  clip.row(1) << rows.row(1), offsets.y();
  clip(2, 3) = near_m;
  clip.row(3) << rows.row(2), offsets.z();
  return clip;
}

FrustumExtents thesis_tile_extents(const WallGrid& grid, int column, int row) {
  const auto edge = [](int index, int count, double size_m) {
    return (-1.0 + index * (2.0 / count)) * (size_m / 2);
  };
  return {.left_m = edge(column, grid.columns, grid.width_m),
          .right_m = edge(column + 1, grid.columns, grid.width_m),
          .bottom_m = edge(row, grid.rows, grid.height_m),
          .top_m = edge(row + 1, grid.rows, grid.height_m)};
}

CameraEvent camera_event_from(const Vec3& eye_in_wall, double near_m) {
  return {.position_in_wall = eye_in_wall,
          .rotation = Quat::Identity(),
          .relative = {-eye_in_wall.x(), -eye_in_wall.x(), -eye_in_wall.y(), -eye_in_wall.y()},
          .near_m = near_m,
          .far_m = std::numeric_limits<double>::infinity(),
          .distance_m = eye_in_wall.z()};
}

FrustumExtents add(const FrustumExtents& tile, const FrustumExtents& relative) {
  return {tile.left_m + relative.left_m, tile.right_m + relative.right_m,
          tile.bottom_m + relative.bottom_m, tile.top_m + relative.top_m};
}

}  // namespace vindu
