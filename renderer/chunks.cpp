#include "renderer/chunks.h"

#include <array>

#include "renderer/partition.h"
#include "renderer/vertex_order.h"

namespace vindu {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Puts the mesh's triangles into the order of its chunks, each a mesh with its own bounds.
std::vector<Mesh> cut(Scene& scene, const Mesh& mesh, std::size_t triangles_per_chunk) {
  std::vector<Triangle> triangles;
  std::vector<Placed> places;
  for (std::uint32_t i = mesh.first_index; i < mesh.first_index + mesh.index_count; i += 3) {
    const Triangle corners{scene.indices[i], scene.indices[i + 1], scene.indices[i + 2]};
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t vertex : corners) sum += scene.vertices[vertex].position_in_node;
    places.push_back({sum / 3, static_cast<std::uint32_t>(triangles.size())});
    triangles.push_back(corners);
  }
  std::vector<Mesh> chunks;
  std::uint32_t next = mesh.first_index;
  for (const std::span<Placed> part : compact_parts(places, triangles_per_chunk)) {
    Mesh chunk = mesh;
    chunk.first_index = next;
    chunk.index_count = static_cast<std::uint32_t>(3 * part.size());
    chunk.bounds_in_node.setEmpty();
    for (const Placed& placed : part)
      for (const std::uint32_t vertex : triangles[placed.item]) {
        scene.indices[next++] = vertex;
        chunk.bounds_in_node.extend(scene.vertices[vertex].position_in_node);
      }
    chunks.push_back(chunk);
  }
  return chunks;
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
  order_vertices_by_use(scene, scene.meshes);  // a piece's lie together
}

}  // namespace vindu
