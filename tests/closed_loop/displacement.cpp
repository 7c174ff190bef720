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
  // Half a level of rounding must not read as more than half a pixel. The smaller singular
  // value of a 2x2 matrix: s^2 = (a - sqrt(a^2 - 4 det^2)) / 2, with a the sum of its squares.
  const float a = result.squaredNorm(), det = result.determinant();
  const float smallest_squared = 0.5f * (a - std::sqrt(std::max(a * a - 4 * det * det, 0.0f)));
  if (smallest_squared < 1) return std::nullopt;
  return result;
}

bool same_surface(const Image& tile, const Levels& reference, int x, int y) {
  return std::abs(static_cast<float>(tile.at(x, y)[2]) - reference.at(x, y).z()) < 1;
}

/// The pixels next to a tile's corners.
class CornerShifts {
 public:
  explicit CornerShifts(const Image& tile) : size_px_(tile.width_px, tile.height_px) {}

  void add(int x, int y, const Eigen::Vector2f& shift_px) {
    const Eigen::Vector2i reach = size_px_ / 8;
    const bool left = x < reach.x(), right = x >= size_px_.x() - reach.x();
    const bool upper = y < reach.y(), lower = y >= size_px_.y() - reach.y();
    if (!(left || right) || !(upper || lower)) return;
    const int corner = (upper ? upper_left : lower_left) + (right ? 1 : 0);
    sum_px_[corner] += shift_px.cast<double>();
    ++count_[corner];
  }
  std::array<std::optional<Eigen::Vector2f>, 4> means_px() const {
    std::array<std::optional<Eigen::Vector2f>, 4> result;
    for (int corner = 0; corner < 4; ++corner)
      if (count_[corner] >= kFewest)
        result[corner] = (sum_px_[corner] / count_[corner]).cast<float>();
    return result;
  }

 private:
  static constexpr int kFewest = 500;
  Eigen::Vector2i size_px_;
  std::array<Eigen::Vector2d, 4> sum_px_{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                         Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<int, 4> count_{};
};

}  // namespace

void Displacements::append(const Displacements& other) {
  length_px.insert(length_px.end(), other.length_px.begin(), other.length_px.end());
  readable += other.readable;
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
  CornerShifts corners(tile);
  for (int y = 1; y + 1 < tile.height_px; ++y)
    for (int x = 1; x + 1 < tile.width_px; ++x) {
      const auto slope = gradient(reference, x, y);
      if (!slope) continue;
      ++result.readable;
      if (!same_surface(tile, reference, x, y)) continue;
      const Rgba8& seen = tile.at(x, y);
      const Eigen::Vector2f difference(static_cast<float>(seen[0]) - reference.at(x, y).x(),
                                       static_cast<float>(seen[1]) - reference.at(x, y).y());
      const Eigen::Vector2f shift_px = slope->inverse() * difference;
      result.length_px.push_back(shift_px.norm());
      corners.add(x, y, shift_px);
    }
  result.corner_px = corners.means_px();
  return result;
}

::testing::AssertionResult shows_what_the_eye_sees(const Displacements& tile) {
  if (tile.readable_share() < 0.1)
    return ::testing::AssertionFailure()
           << "the reference can be read at " << tile.readable_share() << " of the pixels only";
  if (!(tile.agreeing_share() > 0.99))
    return ::testing::AssertionFailure()
           << "another surface is shown but at " << tile.agreeing_share() << " of the pixels";
  const double mean_px = tile.mean_px(), p99_px = tile.quantile_px(0.99);
  if (mean_px <= 0.5 && p99_px <= 1) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "displaced by " << mean_px << " px on average, by " << p99_px << " px at p99";
}

}  // namespace vindu::test
