#include "renderer/vertex_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>

namespace vindu {

void order_vertices_by_use(Scene& scene, std::span<const Mesh> meshes) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place_of(scene.vertices.size(), kUnused);
  std::vector<Vertex> ordered;
  std::vector<Influences> influences;
  ordered.reserve(scene.vertices.size());
  const auto use = [&](std::span<const std::uint32_t> indices) {
    for (const std::uint32_t index : indices) {
      if (place_of[index] != kUnused) continue;
      place_of[index] = static_cast<std::uint32_t>(ordered.size());
      ordered.push_back(scene.vertices[index]);
      if (!scene.influences.empty()) influences.push_back(scene.influences[index]);
    }
  };
  for (const Mesh& mesh : meshes)
    use(std::span(scene.indices).subspan(mesh.first_index, mesh.index_count));
  use(scene.indices);
  for (std::uint32_t& index : scene.indices) index = place_of[index];
  scene.vertices = std::move(ordered);
  scene.influences = std::move(influences);
}

void order_triangles_by_vertices(std::span<std::uint32_t> indices) {
  std::vector<std::uint32_t> used(indices.begin(), indices.end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<unsigned int> local;
  for (const std::uint32_t index : indices)
    local.push_back(
        static_cast<unsigned int>(std::ranges::lower_bound(used, index) - used.begin()));
  std::vector<unsigned int> ordered(local.size());
  meshopt_optimizeVertexCache(ordered.data(), local.data(), local.size(), used.size());
  std::ranges::transform(ordered, indices.begin(), [&](unsigned int at) { return used[at]; });
}

}  // namespace vindu
