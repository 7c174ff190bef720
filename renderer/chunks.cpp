#include "renderer/chunks.h"

#include <algorithm>
#include <array>

namespace vindu {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Puts two zero bits after each of the lowest ten.
std::uint32_t spread_bits(std::uint32_t value) {
  value = (value | value << 16) & 0x030000ff;
  value = (value | value << 8) & 0x0300f00f;
  value = (value | value << 4) & 0x030c30c3;
  return (value | value << 2) & 0x09249249;
}

/// Place along the curve of a point in the box, with 10 bits an axis.
std::uint32_t morton(const Eigen::Vector3f& point, const Box3f& box) {
  const Eigen::Vector3f size = box.sizes().cwiseMax(1e-30f);
  const Eigen::Vector3f place =
      (point - box.min()).cwiseQuotient(size).cwiseMax(0).cwiseMin(1) * 1023;
  return spread_bits(static_cast<std::uint32_t>(place.x())) |
         spread_bits(static_cast<std::uint32_t>(place.y())) << 1 |
         spread_bits(static_cast<std::uint32_t>(place.z())) << 2;
}

void sort_along_curve(Scene& scene, const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, Triangle>> triangles;
  for (std::uint32_t i = mesh.first_index; i < mesh.first_index + mesh.index_count; i += 3) {
    const Triangle triangle{scene.indices[i], scene.indices[i + 1], scene.indices[i + 2]};
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t vertex : triangle) sum += scene.vertices[vertex].position_in_node;
    triangles.emplace_back(morton(sum / 3, mesh.bounds_in_node), triangle);
  }
  std::ranges::stable_sort(triangles, {}, &std::pair<std::uint32_t, Triangle>::first);
  auto out = scene.indices.begin() + mesh.first_index;
  for (const auto& [place, triangle] : triangles) out = std::ranges::copy(triangle, out).out;
}

/// The runs of a sorted mesh, each with its own bounds.
std::vector<Mesh> runs_of(const Scene& scene, const Mesh& mesh, std::size_t triangles_per_chunk) {
  std::vector<Mesh> runs;
  const auto step = static_cast<std::uint32_t>(3 * triangles_per_chunk);
  for (std::uint32_t first = 0; first < mesh.index_count; first += step) {
    Mesh run = mesh;
    run.first_index = mesh.first_index + first;
    run.index_count = std::min(step, mesh.index_count - first);
    run.bounds_in_node.setEmpty();
    for (std::uint32_t i = run.first_index; i < run.first_index + run.index_count; ++i)
      run.bounds_in_node.extend(scene.vertices[scene.indices[i]].position_in_node);
    runs.push_back(run);
  }
  return runs;
}

}  // namespace

void cut_into_chunks(Scene& scene, std::size_t triangles_per_chunk) {
  std::vector<Mesh> meshes;
  std::vector<std::vector<int>> chunks_of(scene.meshes.size());
  for (std::size_t index = 0; index < scene.meshes.size(); ++index) {
    const Mesh& mesh = scene.meshes[index];
    const bool whole = scene.materials[mesh.material].alpha_mode == AlphaMode::blend ||
                       mesh.index_count / 3 <= triangles_per_chunk * 3 / 2;
    if (!whole) sort_along_curve(scene, mesh);
    for (const Mesh& run :
         whole ? std::vector<Mesh>{mesh} : runs_of(scene, mesh, triangles_per_chunk)) {
      chunks_of[index].push_back(static_cast<int>(meshes.size()));
      meshes.push_back(run);
    }
  }
  scene.meshes = std::move(meshes);
  for (Node& node : scene.nodes) {
    std::vector<int> chunks;
    for (const int mesh : node.meshes)
      chunks.insert(chunks.end(), chunks_of[mesh].begin(), chunks_of[mesh].end());
    node.meshes = std::move(chunks);
  }
}

}  // namespace vindu
