// Where a scene's joints put its vertices: the reckoning that shaders/scene.vert does for every
// frame, for bounds and as its reference.
#pragma once

#include <span>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// world_from_mesh of each joint, by world_from_node of each node. The world may be the scene.
std::vector<Eigen::Matrix4f> joint_transforms(std::span<const Joint> joints,
                                              std::span<const Eigen::Matrix4f> world_from_nodes);

/// A vertex' place in world.
Eigen::Vector3f skinned(const Eigen::Vector3f& position_in_mesh, const Influences& influences,
                        std::span<const Eigen::Matrix4f> world_from_meshes);

/// Around the vertices that a joint moves.
struct JointBox {
  int joint = 0;
  Box3f box_in_mesh;
};

/// Of a skinned mesh. However its joints stand, its vertices lie in the box around these, each
/// moved by its joint: a blend is never outside of what it is of.
std::vector<JointBox> joint_boxes(const Scene& scene, const Mesh& mesh);

/// The box around a moved box.
Box3f moved(const Box3f& box, const Eigen::Matrix4f& matrix);

}  // namespace vindu
