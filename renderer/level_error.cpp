#include "renderer/level_error.h"

#include <algorithm>
#include <cmath>

#include "renderer/import_dedupe.h"

namespace vindu {
namespace {

/// A colour that is off by so much, or a normal by so many radians, on triangles with edges of
/// half a pixel counts as an error of half a pixel; half as much on edges of a whole pixel; and so
/// on. A normal off by 0.25 changes the studio's light by about the same as that colour.
constexpr double kColourLoss = 64.0 / 255;
constexpr double kNormalLoss = 1;

/// Metres on the surface for each unit of texture coordinates.
float length_of_uv(const std::array<const Vertex*, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Eigen::Vector2f u = b->uv - a->uv, v = c->uv - a->uv;
  const float in_texture = std::abs(u.x() * v.y() - u.y() * v.x());
  const float in_space = (b->position_in_node - a->position_in_node)
                             .cross(c->position_in_node - a->position_in_node)
                             .norm();
  return in_texture > 0 ? std::sqrt(in_space / in_texture) : 0;
}

Eigen::Vector3f colour_of(const Vertex& vertex) {
  const auto& [red, green, blue, alpha] = vertex.colour;
  return Eigen::Vector3f(red, green, blue) / 255;
}

}  // namespace

std::vector<bool> vertices_of_shared_places(std::span<const Vertex> vertices) {
  std::vector<Eigen::Vector3f> places;
  Deduplicator<Eigen::Vector3f> deduplicator(places, vertices.size());
  std::vector<std::uint32_t> place_of;
  std::vector<int> count;
  for (const Vertex& vertex : vertices) {
    const std::uint32_t place =
        deduplicator.index_of(vertex.position_in_node + Eigen::Vector3f::Zero());
    if (place == count.size()) count.push_back(0);
    ++count[place];
    place_of.push_back(place);
  }
  std::vector<bool> shared;
  for (const std::uint32_t place : place_of) shared.push_back(count[place] > 1);
  return shared;
}

void LevelError::add(std::uint32_t index, const SurfacePatches::Nearest& nearest) {
  farthest_ = std::max(farthest_, nearest.distance);
  if (shared_place_[index]) return;
  const Vertex& vertex = vertices_[index];
  std::array<const Vertex*, 3> corners{};
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(), colour = Eigen::Vector3f::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vertex& corner = vertices_[nearest.corners[i]];
    corners[i] = &corner;
    uv += nearest.weights[i] * corner.uv;
    normal += nearest.weights[i] * corner.normal_in_node;
    colour += nearest.weights[i] * colour_of(corner);
  }
  slides_.push_back(length_of_uv(corners) * (uv - vertex.uv).norm());
  const float off_colour = (colour - colour_of(vertex)).cwiseAbs().maxCoeff();
  colour_squares_ += off_colour * off_colour;
  normal_squares_ += (normal.normalized() - vertex.normal_in_node).squaredNorm();
}

float LevelError::in_node(float mean_edge_in_node) const {
  if (slides_.empty()) return farthest_;
  std::vector<float> slides = slides_;
  const auto late = slides.begin() + static_cast<std::ptrdiff_t>(19 * slides.size() / 20);
  std::ranges::nth_element(slides, late);
  const auto count = static_cast<double>(slides.size());
  const double loss = std::max(std::sqrt(colour_squares_ / count) / kColourLoss,
                               std::sqrt(normal_squares_ / count) / kNormalLoss);
  return std::max({farthest_, *late, mean_edge_in_node * static_cast<float>(std::min(loss, 1.0))});
}

}  // namespace vindu
