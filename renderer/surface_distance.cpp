#include "renderer/surface_distance.h"

#include <algorithm>
#include <limits>

namespace vindu {
namespace {

bool is_degenerate(const std::array<Eigen::Vector3f, 3>& corners) {
  const Eigen::Vector3f a = corners[1] - corners[0], b = corners[2] - corners[0];
  return a.cross(b).squaredNorm() <= 1e-12f * a.squaredNorm() * b.squaredNorm();
}

}  // namespace

Eigen::Vector3f nearest_in_triangle(const Eigen::Vector3f& point,
                                    const std::array<Eigen::Vector3f, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Eigen::Vector3f ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float along = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - along, along};
  }
  const float sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

void SurfacePatches::add(std::vector<std::uint32_t> indices) {
  Patch patch{.indices = std::move(indices), .bounds = {}};
  for (const std::uint32_t index : patch.indices)
    patch.bounds.extend(vertices_[index].position_in_node);
  patches_.push_back(std::move(patch));
}

std::array<Eigen::Vector3f, 3> SurfacePatches::corners_at(const Patch& patch,
                                                          std::size_t first) const {
  const auto at = [&](std::size_t index) {
    return vertices_[patch.indices[index]].position_in_node;
  };
  return {at(first), at(first + 1), at(first + 2)};
}

void SurfacePatches::search(std::size_t index, const Eigen::Vector3f& point,
                            Nearest& nearest) const {
  const Patch& patch = patches_[index];
  for (std::size_t first = 0; first < patch.indices.size(); first += 3) {
    const auto corners = corners_at(patch, first);
    if (is_degenerate(corners)) continue;  // its neighbours have the same points
    const Eigen::Vector3f weights = nearest_in_triangle(point, corners);
    const float distance =
        (weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - point)
            .norm();
    if (distance < nearest.distance)
      nearest = {distance,
                 index,
                 {patch.indices[first], patch.indices[first + 1], patch.indices[first + 2]},
                 weights};
  }
}

SurfacePatches::Nearest SurfacePatches::nearest_to(const Eigen::Vector3f& point) const {
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t index = 0; index < patches_.size(); ++index)
    order.emplace_back(patches_[index].bounds.exteriorDistance(point), index);
  std::ranges::sort(order);
  Nearest nearest;
  nearest.distance = std::numeric_limits<float>::infinity();
  for (const auto& [distance, index] : order) {
    if (distance >= nearest.distance) break;
    search(index, point, nearest);
  }
  return nearest;
}

float SurfacePatches::mean_edge() const {
  double sum = 0;
  std::size_t edges = 0;
  for (const Patch& patch : patches_)
    for (std::size_t first = 0; first < patch.indices.size(); first += 3) {
      const auto [a, b, c] = corners_at(patch, first);
      sum += (b - a).norm() + (c - b).norm() + (a - c).norm();
      edges += 3;
    }
  return edges > 0 ? static_cast<float>(sum / static_cast<double>(edges)) : 0;
}

}  // namespace vindu
