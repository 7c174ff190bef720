// What bones do to vertices: which joints a scene has, and which of them move a vertex by how much.
// The blend is linear (glTF 2.0, section 3.7.3.3).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace vindu {

/// Of one vertex, the strongest first.
struct Influences {
  std::array<std::uint16_t, 4> joints{};   ///< indices into SceneOutline::joints
  std::array<std::uint16_t, 4> weights{};  ///< of kFullWeight, which they are together
};
constexpr std::uint16_t kFullWeight = 65535;

/// A node that moves vertices as if they hung on it: scene_from_mesh = scene_from_node *
/// joint_from_mesh. Where the mesh's own node stands does not count.
struct Joint {
  int node = 0;
  Eigen::Matrix4f joint_from_mesh = Eigen::Matrix4f::Identity();  ///< when it was bound
};

/// As many matrices as every GPU has room for in a buffer texture (65,536 texels at least).
constexpr std::size_t kMaxJoints = 16'384;

}  // namespace vindu
