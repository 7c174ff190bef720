#include "renderer/view.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vindu {
namespace {

/// Unit vectors of a camera, in world.
struct Axes {
  Vec3 forward;
  Vec3 right;
  Vec3 up;
};

/// Looks towards -z where the target is the eye itself; straight up or down, the picture is as
/// somebody sees it who faces -z.
Axes axes_of(const Camera& camera) {
  const Vec3 ahead = camera.target_in_world - camera.eye_in_world;
  const Vec3 forward = ahead.norm() > 1e-9 ? Vec3(ahead.normalized()) : Vec3(-Vec3::UnitZ());
  const Vec3 across = forward.cross(Vec3::UnitY());
  const Vec3 right = across.norm() > 1e-9 ? Vec3(across.normalized()) : Vec3(Vec3::UnitX());
  return {forward, right, right.cross(forward)};
}

std::vector<Vec3> rays_to_corners(const Wall& wall, const Vec3& eye_in_wall) {
  std::vector<Vec3> rays;
  for (const Tile& tile : wall.tiles)
    for (const Vec3& corner : {tile.corners.lower_left_in_wall, tile.corners.lower_right_in_wall,
                               tile.corners.upper_left_in_wall, tile.corners.upper_right_in_wall()})
      rays.emplace_back(corner - eye_in_wall);
  return rays;
}

/// In the middle between the outermost rays, in azimuth about y and in elevation.
Vec3 middle_direction(const std::vector<Vec3>& rays) {
  const auto azimuth = [](const Vec3& ray) { return std::atan2(ray.x(), -ray.z()); };
  const auto elevation = [](const Vec3& ray) {
    return std::atan2(ray.y(), std::hypot(ray.x(), ray.z()));
  };
  const auto [left, right] = std::ranges::minmax(rays, {}, azimuth);
  const auto [low, high] = std::ranges::minmax(rays, {}, elevation);
  const double across = 0.5 * (azimuth(left) + azimuth(right));
  const double along = 0.5 * (elevation(low) + elevation(high));
  return {std::cos(along) * std::sin(across), std::sin(along), -std::cos(along) * std::cos(across)};
}

}  // namespace

std::optional<View> tile_view(const TileCorners& corners, const Vec3& eye_in_wall) {
  const auto clip = clip_from_wall(corners, eye_in_wall);
  if (!clip) return std::nullopt;
  return View{.clip_from_world = *clip, .eye_in_world = eye_in_wall};
}

TileCorners part_of_tile(const Tile& tile, const Vec2& upper_left_px, SizePx size) {
  const TileCorners& whole = tile.corners;
  const Vec3 across = (whole.lower_right_in_wall - whole.lower_left_in_wall) / tile.width_px;
  const Vec3 down = (whole.lower_left_in_wall - whole.upper_left_in_wall) / tile.height_px;
  const Vec3 upper_left =
      whole.upper_left_in_wall + upper_left_px.x() * across + upper_left_px.y() * down;
  const Vec3 lower_left = upper_left + size.height * down;
  return {lower_left, lower_left + size.width * across, upper_left};
}

View camera_view(const Camera& camera) {
  const Axes axes = axes_of(camera);
  const double half_height = std::tan(0.5 * camera.fov_y_rad);
  const Vec3 across = camera.aspect * half_height * axes.right, along = half_height * axes.up;
  const Vec3 middle = camera.eye_in_world + axes.forward;
  const TileCorners screen{middle - across - along, middle + across - along,
                           middle - across + along};
  return *tile_view(screen, camera.eye_in_world);
}

Camera camera_on_wall(const Wall& wall, const Vec3& eye_in_wall, double aspect) {
  const std::vector<Vec3> rays = rays_to_corners(wall, eye_in_wall);
  Camera camera{.eye_in_world = eye_in_wall,
                .target_in_world = eye_in_wall + middle_direction(rays),
                .aspect = aspect};
  const Axes axes = axes_of(camera);
  const double widest = std::min(std::tan(radians(60)), std::tan(radians(70)) / aspect);
  double half_height = 0;
  for (const Vec3& ray : rays) {
    const double depth = std::max(ray.dot(axes.forward), 1e-6);
    half_height = std::max({half_height, std::abs(ray.dot(axes.up)) / depth,
                            std::abs(ray.dot(axes.right)) / depth / aspect});
  }
  camera.fov_y_rad = 2 * std::atan(std::min(1.03 * half_height, widest));
  return camera;
}

Mat3 direction_from_ndc(const View& view) {
  // A point at depth w = 1 has clip coordinates (x, y, near, 1); its world place is linear in x and
  // y.
  const Mat4 world_from_clip = view.clip_from_world.inverse();
  const double near_m = view.clip_from_world(2, 3);
  Mat3 directions;
  directions.col(0) = world_from_clip.topLeftCorner<3, 1>();
  directions.col(1) = world_from_clip.block<3, 1>(0, 1);
  directions.col(2) = (world_from_clip * Vec4(0, 0, near_m, 1)).head<3>() - view.eye_in_world;
  return directions;
}

}  // namespace vindu
