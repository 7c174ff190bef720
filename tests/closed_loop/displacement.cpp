#include "tests/closed_loop/displacement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace vindu::test {
namespace {

/// d(red, green) / d(x, y) by central differences, where the code is linear over the neighbourhood.
std::optional<Eigen::Matrix2f> gradient(const Levels& image, int x, int y) {
  const Eigen::Vector3f& here = image.at(x, y);
  const Eigen::Vector3f &left = image.at(x - 1, y), &right = image.at(x + 1, y);
  const Eigen::Vector3f &above = image.at(x, y - 1), &below = image.at(x, y + 1);
  for (const Eigen::Vector3f& neighbour : {left, right, above, below})
    if (std::abs(neighbour.z() - here.z()) > 0.5f) return std::nullopt;  // another surface
  const Eigen::Vector2f bend_x = (left + right - 2 * here).head<2>(),
                        bend_y = (above + below - 2 * here).head<2>();
  if (std::max(bend_x.cwiseAbs().maxCoeff(), bend_y.cwiseAbs().maxCoeff()) > 2.5f)
    return std::nullopt;
  Eigen::Matrix2f result;
  result << 0.5f * (right - left).head<2>(), 0.5f * (below - above).head<2>();
  // Half a level of rounding must not read as more than a third of a pixel. The smaller singular
  // value of a 2x2 matrix: s^2 = (a - sqrt(a^2 - 4 det^2)) / 2, with a the sum of its squares.
  const float a = result.squaredNorm(), det = result.determinant();
  const float smallest_squared = 0.5f * (a - std::sqrt(std::max(a * a - 4 * det * det, 0.0f)));
  if (smallest_squared < 1.5f * 1.5f) return std::nullopt;
  return result;
}

bool same_surface(const Image& tile, const Levels& reference, int x, int y) {
  return std::abs(static_cast<float>(tile.at(x, y)[2]) - reference.at(x, y).z()) < 1;
}

}  // namespace

void Displacements::append(const Displacements& other) {
  length_px.insert(length_px.end(), other.length_px.begin(), other.length_px.end());
  pixels += other.pixels;
}

double Displacements::mean_px() const {
  return std::accumulate(length_px.begin(), length_px.end(), 0.0) /
         static_cast<double>(length_px.size());
}

double Displacements::quantile_px(double share) const {
  std::vector<float> sorted = length_px;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::ranges::nth_element(sorted, sorted.begin() + rank);
  return sorted[static_cast<std::size_t>(rank)];
}

Displacements displacements(const Image& tile, const Levels& reference) {
  Displacements result;
  result.pixels = tile.pixels.size();
  for (int y = 1; y + 1 < tile.height_px; ++y)
    for (int x = 1; x + 1 < tile.width_px; ++x) {
      if (!same_surface(tile, reference, x, y)) continue;
      const auto slope = gradient(reference, x, y);
      if (!slope) continue;
      const Rgba8& seen = tile.at(x, y);
      const Eigen::Vector2f difference(static_cast<float>(seen[0]) - reference.at(x, y).x(),
                                       static_cast<float>(seen[1]) - reference.at(x, y).y());
      result.length_px.push_back((slope->inverse() * difference).norm());
    }
  return result;
}

}  // namespace vindu::test
