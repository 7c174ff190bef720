#include "renderer/simplify.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <limits>

#include "renderer/import_dedupe.h"

namespace vindu {
namespace {

/// What must be equal for two vertices to be one while edges collapse.
struct Place {
  std::array<float, 3> position_in_node;
  std::array<float, 2> uv;
  std::array<float, 2> uv_1;
  std::array<float, 4> tangent_in_node;
  Rgba8 colour;
};

Place place_of(const Vertex& vertex) {
  const Eigen::Vector3f p = vertex.position_in_node + Eigen::Vector3f::Zero();  // no -0.0
  const Eigen::Vector3f& t = vertex.tangent_in_node;
  return {{p.x(), p.y(), p.z()},
          {vertex.uv.x(), vertex.uv.y()},
          {vertex.uv_1.x(), vertex.uv_1.y()},
          {t.x(), t.y(), t.z(), vertex.bitangent_sign},
          vertex.colour};
}

/// A piece's vertices with those of one place joined.
struct Welded {
  std::vector<Place> places;
  std::vector<std::vector<std::uint32_t>> vertices_at;  // of each place
  std::vector<unsigned int> indices;                    // of places
};

Welded weld(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices) {
  Welded welded;
  welded.indices.reserve(indices.size());
  Deduplicator<Place> places(welded.places, indices.size());
  for (const std::uint32_t index : indices) {
    const std::uint32_t place = places.index_of(place_of(vertices[index]));
    welded.indices.push_back(place);
    if (place == welded.vertices_at.size()) welded.vertices_at.emplace_back();
    std::vector<std::uint32_t>& at = welded.vertices_at[place];
    if (std::find(at.begin(), at.end(), index) == at.end()) at.push_back(index);
  }
  return welded;
}

Eigen::Vector3f face_normal(std::span<const Place> places, std::span<const unsigned int> corners) {
  const auto at = [&](std::size_t corner) {
    return Eigen::Vector3f(places[corners[corner]].position_in_node.data());
  };
  return (at(1) - at(0)).cross(at(2) - at(0));
}

/// 1, or -1 where the normals of a file lie against the winding of its triangles.
float winding_of(const Welded& welded, std::span<const Vertex> vertices,
                 std::span<const std::uint32_t> indices) {
  double agreement = 0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Eigen::Vector3f normal =
        face_normal(welded.places, std::span(welded.indices).subspan(i, 3));
    for (std::size_t corner = i; corner < i + 3; ++corner)
      agreement += normal.dot(vertices[indices[corner]].normal_in_node);
  }
  return agreement < 0 ? -1.0f : 1.0f;
}

std::uint32_t best_of(std::span<const std::uint32_t> candidates, std::span<const Vertex> vertices,
                      const Eigen::Vector3f& normal) {
  return *std::ranges::max_element(candidates, {}, [&](std::uint32_t candidate) {
    return vertices[candidate].normal_in_node.dot(normal);
  });
}

}  // namespace

std::vector<std::uint32_t> simplified(std::span<const Vertex> vertices,
                                      std::span<const std::uint32_t> indices, std::size_t target) {
  const Welded welded = weld(vertices, indices);
  std::vector<unsigned int> fewer(indices.size());
  constexpr float kAnyError = std::numeric_limits<float>::max();
  fewer.resize(meshopt_simplify(fewer.data(), welded.indices.data(), welded.indices.size(),
                                welded.places.front().position_in_node.data(), welded.places.size(),
                                sizeof(Place), 3 * target, kAnyError, meshopt_SimplifyLockBorder,
                                nullptr));
  const float winding = winding_of(welded, vertices, indices);
  std::vector<std::uint32_t> result;
  result.reserve(fewer.size());
  for (std::size_t i = 0; i < fewer.size(); i += 3) {
    const auto corners = std::span(fewer).subspan(i, 3);
    const Eigen::Vector3f normal = winding * face_normal(welded.places, corners);
    for (const unsigned int place : corners)
      result.push_back(best_of(welded.vertices_at[place], vertices, normal));
  }
  return result;
}

}  // namespace vindu
