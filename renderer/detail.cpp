#include "renderer/detail.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vindu {
namespace {

/// The eye as it stands before a tile; nothing to show where it does not.
void add_screen(const TileCorners& corners, const Vec3& eye, std::vector<ScreenPlane>& planes) {
  const Vec3 across = corners.lower_right_in_wall - corners.lower_left_in_wall;
  const Vec3 up = corners.upper_left_in_wall - corners.lower_left_in_wall;
  const Vec3 normal = across.cross(up).normalized();
  const double off_m = normal.dot(eye - corners.lower_left_in_wall);
  if (!(off_m > 0)) return;
  double steepest_m = 0;
  for (const Vec3& corner : {corners.lower_left_in_wall, corners.lower_right_in_wall,
                             corners.upper_left_in_wall, corners.upper_right_in_wall()})
    steepest_m = std::max(steepest_m, (corner - eye).squaredNorm() / off_m);
  const auto same = std::ranges::find_if(planes, [&](const ScreenPlane& plane) {
    return plane.normal_in_world.isApprox(normal, 1e-9) && std::abs(plane.eye_off_m - off_m) < 1e-6;
  });
  if (same == planes.end())
    planes.push_back({normal, off_m, steepest_m});
  else
    same->steepest_m = std::max(same->steepest_m, steepest_m);
}

double finest_pitch_m(const TileCorners& corners, double width_px, double height_px) {
  return std::min(corners.width_m() / width_px, corners.height_m() / height_px);
}

/// The largest distance of the box's corners from the eye's perpendicular to the plane. Squared.
double largest_aside_m2(const ScreenPlane& plane, const Vec3& eye, const Box3f& box) {
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 from_eye = box.corner(static_cast<Box3f::CornerType>(corner)).cast<double>() - eye;
    const double along = plane.normal_in_world.dot(from_eye);
    largest = std::max(largest, from_eye.squaredNorm() - along * along);
  }
  return largest;
}

}  // namespace

DetailNeed detail_need(const Wall& wall, const Vec3& eye_in_wall, double scale) {
  DetailNeed need{.pixel_m = std::numeric_limits<double>::infinity(), .planes = {}};
  for (const Tile& tile : wall.tiles) {
    need.pixel_m = std::min(
        need.pixel_m, finest_pitch_m(tile.corners, scale * tile.width_px, scale * tile.height_px));
    add_screen(tile.corners, eye_in_wall, need.planes);
  }
  return need;
}

DetailNeed detail_need(const TileCorners& screen, SizePx size, const Vec3& eye_in_world) {
  DetailNeed need{.pixel_m = finest_pitch_m(screen, size.width, size.height), .planes = {}};
  add_screen(screen, eye_in_world, need.planes);
  return need;
}

double largest_on_screen_m(const ScreenPlane& plane, const Vec3& eye_in_world, const Box3f& box,
                           double error_m) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  const double near_m = box.cast<double>().exteriorDistance(eye_in_world);
  const double by_tiles = near_m > 0 ? plane.steepest_m / near_m : kUnbounded;
  const Vec3 middle = box.center().cast<double>(), half = 0.5 * box.sizes().cast<double>();
  const Vec3& normal = plane.normal_in_world;
  const double depth_m = normal.dot(eye_in_world - middle) - normal.cwiseAbs().dot(half);
  if (depth_m <= 0) return error_m * by_tiles;
  const double aside_m2 = largest_aside_m2(plane, eye_in_world, box);
  const double by_place =
      plane.eye_off_m * std::sqrt(depth_m * depth_m + aside_m2) / (depth_m * depth_m);
  return error_m * std::min(by_tiles, by_place);
}

bool fine_enough(const DetailNeed& need, const Vec3& eye_in_world, const Box3f& box_in_world,
                 double error_m) {
  if (!(need.pixel_m > 0)) return false;
  return std::ranges::all_of(need.planes, [&](const ScreenPlane& plane) {
    return largest_on_screen_m(plane, eye_in_world, box_in_world, error_m) <=
           kLargestError_px * need.pixel_m;
  });
}

double largest_error_per_m(const DetailNeed& need) {
  double farthest_off_m = 0;
  for (const ScreenPlane& plane : need.planes)
    farthest_off_m = std::max(farthest_off_m, plane.eye_off_m);
  return farthest_off_m > 0 ? kLargestError_px * need.pixel_m / farthest_off_m : 0;
}

}  // namespace vindu
