// Scenes with bones whose poses can be reckoned without the renderer: a bending stalk, and what a
// skinned scene looks like when a CPU has posed its vertices.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "renderer/scene.h"
#include "tests/renderer/test_scenes.h"

namespace vindu::testing {

/// Two joints of a vertex, the first with `share` of the whole.
inline Influences two_joints(std::uint16_t first, std::uint16_t second, float share) {
  const auto weight = static_cast<std::uint16_t>(std::lround(share * kFullWeight));
  return {{first, second, 0, 0}, {weight, static_cast<std::uint16_t>(kFullWeight - weight), 0, 0}};
}

/// "stand" turns, "bend" above it too, and both stretch: channels of one clip of 2 s; a second clip
/// only lifts the stand.
inline void add_stalk_clips(Scene& scene) {
  const auto turn = [](float angle_rad, const Eigen::Vector3f& axis) {
    return Eigen::Quaternionf(Eigen::AngleAxisf(angle_rad, axis.normalized()));
  };
  AnimationChannel stand{.node = 1, .translations = {}, .rotations = {}, .scales = {}};
  stand.rotations = {
      {0, turn(-0.4f, {0, 0, 1})}, {1, turn(0.5f, {0, 1, 1})}, {2, turn(-0.4f, {0, 0, 1})}};
  AnimationChannel bend{.node = 2, .translations = {}, .rotations = {}, .scales = {}};
  bend.rotations = {
      {0, turn(0.9f, {0, 0, 1})}, {1, turn(-1, {1, 0, 1})}, {2, turn(0.9f, {0, 0, 1})}};
  bend.scales = {{0, {1, 1, 1}}, {1, {1.5f, 0.7f, 1}}, {2, {1, 1, 1}}};
  scene.animations.push_back({"sway", 2, {stand, bend}});
  AnimationChannel lift{.node = 1, .translations = {}, .rotations = {}, .scales = {}};
  lift.translations = {{0, {0, -0.8f, 0}}, {1, {0, -0.3f, 0}}};
  scene.animations.push_back({"lift", 1, {lift}});
}

/// A round stalk from y = -0.8 to 0.4 on two bones, of 12 sides; it hangs on a node of its own that
/// stands elsewhere, which must not count.
inline Scene stalk_scene(const Material& material) {
  constexpr int kSides = 12, kRings = 13;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  Scene scene;
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side <= kSides; ++side) {
      const float along = static_cast<float>(ring) / (kRings - 1),
                  angle_rad = 2 * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
      const Eigen::Vector3f out(std::sin(angle_rad), 0, std::cos(angle_rad));
      Vertex vertex;
      vertex.position_in_node = 0.15f * out + Eigen::Vector3f(0, -0.8f + 1.2f * along, 0);
      vertex.normal_in_node = out;
      vertex.tangent_in_node = {out.z(), 0, -out.x()};
      vertex.uv = {static_cast<float>(side) / kSides, 1 - along};
      vertex.colour = {static_cast<std::uint8_t>(40 + 16 * ring),
                       static_cast<std::uint8_t>(20 * side), 90, 255};
      vertices.push_back(vertex);
      scene.influences.push_back(two_joints(0, 1, std::clamp(2.5f - 4 * along, 0.0f, 1.0f)));
    }
  for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring)
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t low = ring * (kSides + 1) + side, high = low + kSides + 1;
      indices.insert(indices.end(), {low, low + 1, high + 1, low, high + 1, high});
    }
  add_mesh(scene, vertices, indices, material);
  scene.meshes.back().skinned = true;
  scene.nodes = {empty_node(Eigen::Matrix4f::Identity()), empty_node(moved_by(0, -0.8f, 0), 0),
                 empty_node(moved_by(0, 0.6f, 0), 1), empty_node(moved_by(5, 6, 7), 0)};
  scene.nodes[3].meshes = {0};
  scene.joints = {{1, moved_by(0, 0.8f, 0)}, {2, moved_by(0, 0.2f, 0)}};
  add_stalk_clips(scene);
  return scene;
}

/// The same without bones, as they have moved it: in double precision, normals by the inverse
/// transpose of the blended matrix, triangles turned round where joints mirror them (all or none).
inline Scene posed_by_hand(Scene scene, double animation_time_s, int clip = 0) {
  const std::vector<Eigen::Matrix4f> nodes = node_transforms(scene, animation_time_s, clip);
  bool mirrored = false;
  for (std::size_t v = 0; v < scene.vertices.size(); ++v) {
    Eigen::Matrix4d blend = Eigen::Matrix4d::Zero();
    for (int i = 0; i < 4; ++i) {
      const Joint& joint = scene.joints[scene.influences[v].joints[i]];
      blend += scene.influences[v].weights[i] / 65535.0 * nodes[joint.node].cast<double>() *
               joint.joint_from_mesh.cast<double>();
    }
    const Eigen::Matrix3d linear = blend.topLeftCorner<3, 3>();
    Vertex& vertex = scene.vertices[v];
    const Eigen::Vector4d position = blend * vertex.position_in_node.cast<double>().homogeneous();
    vertex.position_in_node = position.head<3>().cast<float>();
    vertex.normal_in_node = (linear.inverse().transpose() * vertex.normal_in_node.cast<double>())
                                .normalized()
                                .cast<float>();
    vertex.tangent_in_node =
        (linear * vertex.tangent_in_node.cast<double>()).normalized().cast<float>();
    if (linear.determinant() >= 0) continue;
    mirrored = true;
    vertex.bitangent_sign = -vertex.bitangent_sign;
  }
  for (std::size_t i = 0; mirrored && i < scene.indices.size(); i += 3)
    std::swap(scene.indices[i], scene.indices[i + 1]);
  for (Mesh& mesh : scene.meshes) {
    mesh.skinned = false;
    mesh.bounds_in_node.setEmpty();
    for (std::uint32_t i = 0; i < mesh.index_count; ++i)
      mesh.bounds_in_node.extend(
          scene.vertices[scene.indices[mesh.first_index + i]].position_in_node);
  }
  for (Node& node : scene.nodes) node.parent_from_node.setIdentity();
  scene.joints.clear();
  scene.influences.clear();
  scene.animations.clear();
  return scene;
}

}  // namespace vindu::testing
