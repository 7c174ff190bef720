#include "renderer/chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace vindu {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Placed {
  Triangle corners;
  Eigen::Vector3f middle;
};

/// Halves the triangles across the longest side of the box around their middles, and the halves
/// again, until each has at most `largest`: compact, so that few lie on the border of a tile.
void split(std::span<Placed> triangles, std::size_t largest,
           std::vector<std::span<Placed>>& parts) {
  if (triangles.size() <= largest) {
    parts.push_back(triangles);
    return;
  }
  Box3f box;
  for (const Placed& triangle : triangles) box.extend(triangle.middle);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::ranges::stable_sort(triangles, {},
                           [axis](const Placed& triangle) { return triangle.middle[axis]; });
  const std::size_t half = triangles.size() / 2;
  split(triangles.first(half), largest, parts);
  split(triangles.subspan(half), largest, parts);
}

/// Puts the mesh's triangles into the order of its chunks, each a mesh with its own bounds.
std::vector<Mesh> cut(Scene& scene, const Mesh& mesh, std::size_t triangles_per_chunk) {
  std::vector<Placed> triangles;
  for (std::uint32_t i = mesh.first_index; i < mesh.first_index + mesh.index_count; i += 3) {
    const Triangle corners{scene.indices[i], scene.indices[i + 1], scene.indices[i + 2]};
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t vertex : corners) sum += scene.vertices[vertex].position_in_node;
    triangles.push_back({corners, sum / 3});
  }
  std::vector<std::span<Placed>> parts;
  split(triangles, triangles_per_chunk, parts);
  std::vector<Mesh> chunks;
  std::uint32_t next = mesh.first_index;
  for (const std::span<Placed> part : parts) {
    Mesh chunk = mesh;
    chunk.first_index = next;
    chunk.index_count = static_cast<std::uint32_t>(3 * part.size());
    chunk.bounds_in_node.setEmpty();
    for (const Placed& triangle : part)
      for (const std::uint32_t vertex : triangle.corners) {
        scene.indices[next++] = vertex;
        chunk.bounds_in_node.extend(scene.vertices[vertex].position_in_node);
      }
    chunks.push_back(chunk);
  }
  return chunks;
}

/// A piece's vertices lie together: GPUs read memory in runs, and llvmpipe's cache of shaded
/// vertices is indexed by their lowest bits.
void order_vertices_by_use(Scene& scene) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place_of(scene.vertices.size(), kUnused);
  std::vector<Vertex> ordered;
  std::vector<Influences> influences;
  ordered.reserve(scene.vertices.size());
  for (std::uint32_t& index : scene.indices) {
    std::uint32_t& place = place_of[index];
    if (place == kUnused) {
      place = static_cast<std::uint32_t>(ordered.size());
      ordered.push_back(scene.vertices[index]);
      if (!scene.skin.influences.empty()) influences.push_back(scene.skin.influences[index]);
    }
    index = place;
  }
  scene.vertices = std::move(ordered);
  scene.skin.influences = std::move(influences);
}

}  // namespace

void cut_into_chunks(Scene& scene, std::size_t triangles_per_chunk) {
  std::vector<Mesh> meshes;
  std::vector<std::vector<int>> chunks_of(scene.meshes.size());
  for (std::size_t index = 0; index < scene.meshes.size(); ++index)
    for (const Mesh& chunk : cut(scene, scene.meshes[index], triangles_per_chunk)) {
      chunks_of[index].push_back(static_cast<int>(meshes.size()));
      meshes.push_back(chunk);
    }
  scene.meshes = std::move(meshes);
  for (Node& node : scene.nodes) {
    std::vector<int> chunks;
    for (const int mesh : node.meshes)
      chunks.insert(chunks.end(), chunks_of[mesh].begin(), chunks_of[mesh].end());
    node.meshes = std::move(chunks);
  }
  order_vertices_by_use(scene);
}

}  // namespace vindu
