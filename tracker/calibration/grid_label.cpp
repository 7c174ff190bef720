#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>

#include "tracker/calibration/grid.h"

namespace vindu {
namespace {

double area2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

using Corners = std::array<std::size_t, 4>;

/// The four dots that enclose the largest area, clockwise as seen in the picture (y down).
std::optional<Corners> outer_corners(const std::vector<Vec2>& dots) {
  double most = 0;
  std::optional<Corners> best;
  for (std::size_t a = 0; a < dots.size(); ++a)
    for (std::size_t b = 0; b < dots.size(); ++b)
      for (std::size_t c = a + 1; c < dots.size(); ++c)
        for (std::size_t d = 0; d < dots.size(); ++d) {
          if (area2(dots[a], dots[b], dots[c]) <= 0 || area2(dots[a], dots[c], dots[d]) <= 0 ||
              area2(dots[b], dots[c], dots[d]) <= 0 || area2(dots[b], dots[d], dots[a]) <= 0)
            continue;
          const double area = area2(dots[a], dots[b], dots[c]) + area2(dots[a], dots[c], dots[d]);
          if (area > most) most = area, best = Corners{a, b, c, d};
        }
  return best;
}

std::optional<std::vector<std::size_t>> label_from(const std::vector<Vec2>& dots, const Grid& grid,
                                                   const Corners& corners) {
  const auto leds = grid.leds_in_rig();
  const auto columns = static_cast<std::size_t>(grid.columns);
  const std::size_t first[] = {0, columns - 1, leds.size() - 1, leds.size() - columns};
  std::vector<cv::Point2d> on_rig, in_image;
  for (std::size_t i = 0; i < 4; ++i) {
    on_rig.emplace_back(leds[first[i]].x(), leds[first[i]].y());
    in_image.emplace_back(dots[corners[i]].x(), dots[corners[i]].y());
  }
  const cv::Mat map = cv::findHomography(on_rig, in_image);
  if (map.empty()) return std::nullopt;
  Mat3 homography;
  for (int i = 0; i < 9; ++i) homography(i / 3, i % 3) = map.at<double>(i / 3, i % 3);
  const double near_px =
      0.2 * std::sqrt(std::abs(area2(dots[corners[0]], dots[corners[1]], dots[corners[2]]))) /
      std::max(grid.columns, grid.rows);
  std::vector<std::size_t> labels;
  for (const Vec3& led : leds) {
    const Vec2 there = (homography * Vec3(led.x(), led.y(), 1)).hnormalized();
    const auto dot = std::ranges::min_element(
        dots, {}, [&](const Vec2& candidate) { return (candidate - there).norm(); });
    const auto index = static_cast<std::size_t>(dot - dots.begin());
    if ((*dot - there).norm() > near_px || std::ranges::find(labels, index) != labels.end())
      return std::nullopt;
    labels.push_back(index);
  }
  return labels;
}

}  // namespace

std::vector<Vec3> Grid::leds_in_rig() const {
  std::vector<Vec3> leds;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      leds.emplace_back((column - 0.5 * (columns - 1)) * across_m, (0.5 * (rows - 1) - row) * up_m,
                        0);
  return leds;
}

std::optional<std::vector<std::size_t>> label_grid(const std::vector<Vec2>& dots_px,
                                                   const Grid& grid, const Vec2& up_in_image) {
  const int dots = grid.columns * grid.rows;
  if (std::ssize(dots_px) != dots) return std::nullopt;
  auto corners = outer_corners(dots_px);
  if (!corners) return std::nullopt;
  std::optional<std::vector<std::size_t>> best;
  double most_up = -1e300;
  for (int turn = 0; turn < 4; ++turn) {
    const Vec2 upwards = dots_px[(*corners)[0]] + dots_px[(*corners)[1]] - dots_px[(*corners)[2]] -
                         dots_px[(*corners)[3]];
    const auto labels = label_from(dots_px, grid, *corners);
    if (labels && upwards.normalized().dot(up_in_image) > most_up) {
      most_up = upwards.normalized().dot(up_in_image);
      best = labels;
    }
    std::rotate(corners->begin(), corners->begin() + 1, corners->end());
  }
  return best;
}

}  // namespace vindu
