#include "renderer/skinning.h"

#include <map>

namespace vindu {

std::vector<Eigen::Matrix4f> joint_transforms(std::span<const Joint> joints,
                                              std::span<const Eigen::Matrix4f> world_from_nodes) {
  std::vector<Eigen::Matrix4f> world_from_meshes;
  world_from_meshes.reserve(joints.size());
  for (const Joint& joint : joints) {
    const Eigen::Matrix4d world_from_node =
        world_from_nodes[static_cast<std::size_t>(joint.node)].cast<double>();
    const Eigen::Matrix4d world_from_mesh = world_from_node * joint.joint_from_mesh.cast<double>();
    world_from_meshes.emplace_back(world_from_mesh.cast<float>());
  }
  return world_from_meshes;
}

Eigen::Vector3f skinned(const Eigen::Vector3f& position_in_mesh, const Influences& influences,
                        std::span<const Eigen::Matrix4f> world_from_meshes) {
  Eigen::Vector3f position_in_world = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < influences.joints.size(); ++i) {
    if (influences.weights[i] == 0) continue;
    const float weight = static_cast<float>(influences.weights[i]) / kFullWeight;
    const Eigen::Affine3f world_from_mesh(world_from_meshes[influences.joints[i]]);
    position_in_world += weight * (world_from_mesh * position_in_mesh);
  }
  return position_in_world;
}

std::vector<JointBox> joint_boxes(const Scene& scene, const Mesh& mesh) {
  std::map<int, Box3f> boxes;
  for (std::uint32_t at = mesh.first_index; at < mesh.first_index + mesh.index_count; ++at) {
    const std::uint32_t vertex = scene.indices[at];
    const Influences& influences = scene.influences[vertex];
    for (std::size_t i = 0; i < influences.joints.size(); ++i)
      if (influences.weights[i] > 0)
        boxes[influences.joints[i]].extend(scene.vertices[vertex].position_in_node);
  }
  std::vector<JointBox> result;
  result.reserve(boxes.size());
  for (const auto& [joint, box] : boxes) result.push_back({joint, box});
  return result;
}

/// Its middle moves, its half size by the absolute matrix (J. Arvo, Graphics Gems, 1990).
Box3f moved(const Box3f& box, const Eigen::Matrix4f& matrix) {
  const Eigen::Vector3f middle = (matrix * box.center().homogeneous()).head<3>();
  const Eigen::Vector3f half = 0.5f * matrix.topLeftCorner<3, 3>().cwiseAbs() * box.sizes();
  return {middle - half, middle + half};
}

}  // namespace vindu
