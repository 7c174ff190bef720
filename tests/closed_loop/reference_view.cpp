#include "tests/closed_loop/reference_view.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace vindu::test {
namespace {

constexpr int kReference_px = 2048;
constexpr double kReferenceNear_m = 0.02;

glm::dvec3 glm_from(const Vec3& value) { return {value.x(), value.y(), value.z()}; }

/// Lower left, lower right, upper right, upper left.
std::array<Vec3, 4> corners_of(const TileCorners& corners) {
  return {corners.lower_left_in_wall, corners.lower_right_in_wall, corners.upper_right_in_wall(),
          corners.upper_left_in_wall};
}

/// A square symmetric camera that looks at the middle of the corners' directions and just has them
/// all in view.
glm::dmat4 symmetric_camera(const std::array<Vec3, 4>& corners, const Vec3& eye) {
  Vec3 forward = Vec3::Zero();
  for (const Vec3& corner : corners) forward += (corner - eye).normalized();
  const glm::dmat4 view = glm::lookAt(glm_from(eye), glm_from(eye + forward), glm::dvec3(0, 1, 0));
  double widest = 0;
  for (const Vec3& corner : corners) {
    const glm::dvec4 seen = view * glm::dvec4(glm_from(corner), 1);
    widest = std::max({widest, std::abs(seen.x / seen.z), std::abs(seen.y / seen.z)});
  }
  return glm::infinitePerspective(2 * std::atan(1.01 * widest), 1.0, kReferenceNear_m) * view;
}

/// glm::infinitePerspective has z/w from -1 (near) to 1; the renderer's depth test wants 1 (near)
/// to 0.
View view_with(const glm::dmat4& clip_from_wall, const Vec3& eye) {
  View view{Mat4::Zero(), eye};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      view.clip_from_world(row, column) = clip_from_wall[column][row];
  view.clip_from_world.row(2) = 0.5 * (view.clip_from_world.row(3) - view.clip_from_world.row(2));
  return view;
}

/// Maps four points to four others: the eight unknowns of H with H(2, 2) = 1.
Mat3 homography(const std::array<Vec2, 4>& from, const std::array<Vec2, 4>& to) {
  Eigen::Matrix<double, 8, 8> equations;
  Eigen::Matrix<double, 8, 1> values;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double x = from[i].x(), y = from[i].y(), u = to[i].x(), v = to[i].y();
    equations.row(2 * i) << x, y, 1, 0, 0, 0, -u * x, -u * y;
    equations.row(2 * i + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
    values.segment<2>(2 * i) << u, v;
  }
  const Eigen::Matrix<double, 8, 1> h = equations.fullPivLu().solve(values);
  Mat3 result;
  result << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return result;
}

Eigen::Vector3f levels(const Rgba8& pixel) {
  return {static_cast<float>(pixel[0]), static_cast<float>(pixel[1]), static_cast<float>(pixel[2])};
}

/// Pixel centres are at half pixels.
Eigen::Vector3f bilinear(const Image& image, const Vec2& place) {
  const double x = std::clamp(place.x() - 0.5, 0.0, image.width_px - 1.001);
  const double y = std::clamp(place.y() - 0.5, 0.0, image.height_px - 1.001);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const Eigen::Vector3f upper =
      (1 - fx) * levels(image.at(left, top)) + fx * levels(image.at(left + 1, top));
  const Eigen::Vector3f lower =
      (1 - fx) * levels(image.at(left, top + 1)) + fx * levels(image.at(left + 1, top + 1));
  return (1 - fy) * upper + fy * lower;
}

}  // namespace

Levels reference_of_tile(const Tile& tile, const Vec3& eye_in_wall, const SceneRenderer& renderer,
                         const GpuScene& scene) {
  const std::array<Vec3, 4> corners = corners_of(tile.corners);
  const glm::dmat4 clip_from_wall = symmetric_camera(corners, eye_in_wall);
  Canvas canvas({kReference_px, kReference_px}, Look{renderer.style()});
  Picture picture(canvas.size(), renderer.style());
  const GpuScene* scenes[] = {&scene};
  canvas.begin();
  renderer.draw(view_with(clip_from_wall, eye_in_wall), scenes);
  canvas.resolve(picture);
  const Image seen = picture.read();

  const double w = tile.width_px, h = tile.height_px;
  const std::array<Vec2, 4> tile_px = {Vec2(0, h), Vec2(w, h), Vec2(w, 0), Vec2(0, 0)};
  std::array<Vec2, 4> seen_px;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec4 clip = clip_from_wall * glm::dvec4(glm_from(corners[i]), 1);
    seen_px[i] = 0.5 * kReference_px * Vec2(1 + clip.x / clip.w, 1 - clip.y / clip.w);
  }
  const Mat3 seen_from_tile = homography(tile_px, seen_px);
  Levels result{tile.width_px, tile.height_px, {}};
  result.pixels.reserve(static_cast<std::size_t>(tile.width_px) * tile.height_px);
  for (int y = 0; y < tile.height_px; ++y)
    for (int x = 0; x < tile.width_px; ++x)
      result.pixels.push_back(
          bilinear(seen, (seen_from_tile * Vec3(x + 0.5, y + 0.5, 1)).hnormalized()));
  return result;
}

}  // namespace vindu::test
