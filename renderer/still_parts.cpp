#include "renderer/still_parts.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "renderer/chunks.h"

namespace vindu {
namespace {

using Indices = std::vector<std::uint32_t>;
using Matrices = std::vector<Eigen::Matrix4d>;

/// Of the root, which is node 0.
Matrices root_from_nodes(const std::vector<Node>& nodes) {
  Matrices matrices;
  for (const Node& node : nodes) {
    if (node.parent < 0)
      matrices.push_back(Eigen::Matrix4d::Identity());
    else
      matrices.push_back(matrices[node.parent] * node.parent_from_node.cast<double>());
  }
  return matrices;
}

/// Those that an animation moves, and all below them.
std::vector<bool> moving_nodes(const SceneOutline& scene) {
  std::vector<bool> moving(scene.nodes.size(), false);
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels) moving[channel.node] = true;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (const int parent = scene.nodes[i].parent; parent >= 0 && moving[parent]) moving[i] = true;
  return moving;
}

std::vector<int> uses_of_meshes(const SceneOutline& scene) {
  std::vector<int> uses(scene.meshes.size(), 0);
  for (const Node& node : scene.nodes)
    for (const int mesh : node.meshes) ++uses[mesh];
  return uses;
}

/// One mesh at one node.
struct Part {
  int node = 0;
  int mesh = 0;
};

/// What can be joined; nothing where that would save no call.
std::vector<Part> joinable_parts(const SceneOutline& scene, const Matrices& root_from_node) {
  const std::vector<bool> moving = moving_nodes(scene);
  const std::vector<int> uses = uses_of_meshes(scene);
  std::vector<Part> parts;
  std::map<int, int> of_material;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Eigen::Matrix3d linear = root_from_node[i].topLeftCorner<3, 3>();
    if (moving[i] || !linear.allFinite() || linear.determinant() == 0) continue;
    for (const int index : scene.nodes[i].meshes) {
      const Mesh& mesh = scene.meshes[index];
      if (mesh.skinned || (uses[index] > 1 && mesh.index_count > 3 * kChunkTriangles)) continue;
      parts.push_back({static_cast<int>(i), index});
      ++of_material[mesh.material];
    }
  }
  const auto several = [](const auto& material) { return material.second > 1; };
  return std::ranges::any_of(of_material, several) ? parts : std::vector<Part>{};
}

Eigen::Vector3d middle_of(const SceneOutline& scene, const std::vector<Part>& parts,
                          const Matrices& root_from_node) {
  Eigen::AlignedBox3d box;
  for (const auto& [node, mesh] : parts) {
    const Eigen::Vector3f middle = scene.meshes[mesh].bounds_in_node.center();
    box.extend((root_from_node[node] * middle.cast<double>().homogeneous()).head<3>());
  }
  return box.center();
}

/// Takes vertices from one frame to another, as shaders/scene.vert takes them into the world.
class Move {
 public:
  explicit Move(const Eigen::Matrix4d& to_from_node)
      : matrix_(to_from_node),
        normals_(to_from_node.topLeftCorner<3, 3>().inverse().transpose()),
        mirrors_(to_from_node.topLeftCorner<3, 3>().determinant() < 0) {}

  bool mirrors() const { return mirrors_; }
  void apply(Vertex& vertex) const {
    const Eigen::Vector3d position = vertex.position_in_node.cast<double>();
    const Eigen::Vector3d tangent = vertex.tangent_in_node.cast<double>();
    const Eigen::Vector3d normal = normals_ * vertex.normal_in_node.cast<double>();
    vertex.position_in_node = (matrix_ * position.homogeneous()).head<3>().cast<float>();
    vertex.normal_in_node = normal.normalized().cast<float>();
    vertex.tangent_in_node = (matrix_.topLeftCorner<3, 3>() * tangent).normalized().cast<float>();
    if (mirrors_) vertex.bitangent_sign = -vertex.bitangent_sign;
  }

 private:
  Eigen::Matrix4d matrix_;
  Eigen::Matrix3d normals_;
  bool mirrors_;
};

/// Puts vertices where a part of the joined mesh has them.
class VertexMover {
 public:
  explicit VertexMover(Scene& scene)
      : scene_(scene), uses_(uses_of_meshes(scene)), owner_(scene.vertices.size(), kNobody) {
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
      for (const std::uint32_t vertex : indices_of(static_cast<int>(mesh))) {
        int& owner = owner_[vertex];
        owner =
            owner == kNobody || owner == static_cast<int>(mesh) ? static_cast<int>(mesh) : kSeveral;
      }
  }

  /// The part's triangles. Its vertices move where nobody else needs them, else copies do.
  Indices moved(int mesh, const Move& to_joined) {
    const auto given = indices_of(mesh);
    Indices indices(given.begin(), given.end());
    const auto own = [&](std::uint32_t vertex) { return owner_[vertex] == mesh; };
    const bool alone = uses_[mesh] == 1 && std::ranges::all_of(indices, own);
    Indices vertices = indices;
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (!alone) copy(vertices, indices);
    for (const std::uint32_t vertex : vertices) to_joined.apply(scene_.vertices[vertex]);
    if (to_joined.mirrors())
      for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
    return indices;
  }

 private:
  static constexpr int kNobody = -1, kSeveral = -2;

  std::span<const std::uint32_t> indices_of(int mesh) const {
    return std::span(scene_.indices)
        .subspan(scene_.meshes[mesh].first_index, scene_.meshes[mesh].index_count);
  }

  /// Makes both name the copies.
  void copy(Indices& vertices, Indices& indices) {
    std::unordered_map<std::uint32_t, std::uint32_t> copies;
    for (std::uint32_t& vertex : vertices) {
      const auto copied = static_cast<std::uint32_t>(scene_.vertices.size());
      copies[vertex] = copied;
      const Vertex original = scene_.vertices[vertex];
      scene_.vertices.push_back(original);
      if (!scene_.influences.empty()) {
        const Influences of_original = scene_.influences[vertex];
        scene_.influences.push_back(of_original);
      }
      vertex = copied;
    }
    for (std::uint32_t& index : indices) index = copies[index];
  }

  Scene& scene_;
  std::vector<int> uses_;
  std::vector<int> owner_;  // of each vertex: the mesh that has it
};

/// Meshes and indices built anew, of those that some node still shows.
class MeshList {
 public:
  int add(Mesh mesh, std::span<const std::uint32_t> indices) {
    mesh.first_index = static_cast<std::uint32_t>(indices_.size());
    mesh.index_count = static_cast<std::uint32_t>(indices.size());
    indices_.insert(indices_.end(), indices.begin(), indices.end());
    meshes_.push_back(mesh);
    return static_cast<int>(meshes_.size()) - 1;
  }
  void put_into(Scene& scene) {
    scene.meshes = std::move(meshes_);
    scene.indices = std::move(indices_);
  }

 private:
  std::vector<Mesh> meshes_;
  Indices indices_;
};

void keep_what_nodes_show(Scene& scene, MeshList& meshes) {
  std::vector<std::optional<int>> kept(scene.meshes.size());
  for (Node& node : scene.nodes)
    for (int& index : node.meshes) {
      const Mesh& mesh = scene.meshes[index];
      if (!kept[index])
        kept[index] =
            meshes.add(mesh, std::span(scene.indices).subspan(mesh.first_index, mesh.index_count));
      index = *kept[index];
    }
}

Mesh mesh_of(const Scene& scene, const Indices& indices, int material) {
  Mesh mesh{.material = material, .bounds_in_node = {}};
  for (const std::uint32_t vertex : indices)
    mesh.bounds_in_node.extend(scene.vertices[vertex].position_in_node);
  return mesh;
}

/// Keeps their order, so that parents come first.
void drop_idle_nodes(Scene& scene) {
  std::vector<bool> needed(scene.nodes.size(), false);
  needed[0] = true;
  for (const Joint& joint : scene.joints) needed[joint.node] = true;
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels) needed[channel.node] = true;
  for (std::size_t i = scene.nodes.size(); i-- > 1;) {
    if (!scene.nodes[i].meshes.empty()) needed[i] = true;
    if (needed[i]) needed[scene.nodes[i].parent] = true;
  }
  std::vector<int> place(scene.nodes.size(), -1);
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!needed[i]) continue;
    place[i] = static_cast<int>(nodes.size());
    nodes.push_back(std::move(scene.nodes[i]));
    if (int& parent = nodes.back().parent; parent >= 0) parent = place[parent];
  }
  scene.nodes = std::move(nodes);
  for (Joint& joint : scene.joints) joint.node = place[joint.node];
  for (Animation& animation : scene.animations)
    for (AnimationChannel& channel : animation.channels) channel.node = place[channel.node];
}

}  // namespace

void join_still_parts(Scene& scene) {
  const Matrices root_from_node = root_from_nodes(scene.nodes);
  const std::vector<Part> parts = joinable_parts(scene, root_from_node);
  if (parts.empty()) return;
  Node node{.name = "still parts", .parent = 0, .meshes = {}};
  node.parent_from_node.topRightCorner<3, 1>() =
      middle_of(scene, parts, root_from_node).cast<float>();
  const Eigen::Matrix4d joined_from_root = node.parent_from_node.cast<double>().inverse();
  VertexMover mover(scene);
  MeshList meshes;
  std::map<int, Indices> joined;  // of each material that is not blended
  std::vector<std::pair<int, Indices>> apart;
  for (const auto& [part_node, mesh] : parts) {
    const int material = scene.meshes[mesh].material;
    Indices indices = mover.moved(mesh, Move(joined_from_root * root_from_node[part_node]));
    if (scene.materials[material].alpha_mode == AlphaMode::blend)
      apart.emplace_back(material, std::move(indices));
    else
      joined[material].insert(joined[material].end(), indices.begin(), indices.end());
    std::erase(scene.nodes[part_node].meshes, mesh);
  }
  keep_what_nodes_show(scene, meshes);
  apart.insert(apart.begin(), joined.begin(), joined.end());
  for (const auto& [material, indices] : apart)
    node.meshes.push_back(meshes.add(mesh_of(scene, indices, material), indices));
  scene.nodes.push_back(std::move(node));
  meshes.put_into(scene);
  drop_idle_nodes(scene);
}

}  // namespace vindu
