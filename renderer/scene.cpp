#include "renderer/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/skinning.h"

namespace vindu {
namespace {

Eigen::Vector3f between(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float fraction) {
  return from + fraction * (to - from);
}

Eigen::Quaternionf between(const Eigen::Quaternionf& from, const Eigen::Quaternionf& to,
                           float fraction) {
  return from.slerp(fraction, to);
}

/// Before the first key the first, after the last the last.
template <class Value>
Value sample(const std::vector<Key<Value>>& keys, double t_s) {
  const auto after = std::ranges::upper_bound(keys, t_s, {}, &Key<Value>::t_s);
  if (after == keys.begin()) return keys.front().value;
  if (after == keys.end()) return keys.back().value;
  const auto before = after - 1;
  const double fraction = (t_s - before->t_s) / (after->t_s - before->t_s);
  return between(before->value, after->value, static_cast<float>(fraction));
}

/// matrix = translation * rotation * scale; shear, which no animation can express, is lost. A
/// mirrored matrix has its x scale negative.
struct TransformParts {
  Eigen::Vector3f translation;
  Eigen::Quaternionf rotation;
  Eigen::Vector3f scale;

  explicit TransformParts(const Eigen::Matrix4f& matrix) : translation(matrix.col(3).head<3>()) {
    Eigen::Matrix3f axes = matrix.topLeftCorner<3, 3>();
    scale = axes.colwise().norm().transpose();
    if (axes.determinant() < 0) scale.x() = -scale.x();
    for (int axis = 0; axis < 3; ++axis)
      if (scale[axis] != 0) axes.col(axis) /= scale[axis];
    const bool invertible = std::abs(axes.determinant()) > 1e-6f;
    rotation = invertible ? Eigen::Quaternionf(axes).normalized() : Eigen::Quaternionf::Identity();
  }

  Eigen::Matrix4f matrix() const {
    Eigen::Matrix4f result = Eigen::Matrix4f::Identity();
    result.topLeftCorner<3, 3>() = rotation.toRotationMatrix() * scale.asDiagonal();
    result.topRightCorner<3, 1>() = translation;
    return result;
  }
};

Eigen::Matrix4f animated(const AnimationChannel& channel, const Eigen::Matrix4f& at_rest,
                         double t_s) {
  TransformParts parts(at_rest);
  if (!channel.translations.empty()) parts.translation = sample(channel.translations, t_s);
  if (!channel.rotations.empty()) parts.rotation = sample(channel.rotations, t_s);
  if (!channel.scales.empty()) parts.scale = sample(channel.scales, t_s);
  return parts.matrix();
}

double wrapped(double t_s, double duration_s) {
  if (!(duration_s > 0)) return 0;
  const double remainder_s = std::fmod(t_s, duration_s);
  return remainder_s < 0 ? remainder_s + duration_s : remainder_s;
}

/// Replaces every node's parent_from_node by scene_from_node.
void compose(const std::vector<Node>& nodes, std::vector<Eigen::Matrix4f>& transforms) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].parent >= 0) transforms[i] = transforms[nodes[i].parent] * transforms[i];
}

std::vector<Eigen::Matrix4f> transforms_at_rest(const std::vector<Node>& nodes) {
  std::vector<Eigen::Matrix4f> transforms;
  transforms.reserve(nodes.size());
  for (const Node& node : nodes) transforms.push_back(node.parent_from_node);
  return transforms;
}

}  // namespace

float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::vector<Eigen::Matrix4f> node_transforms(const SceneOutline& scene, double animation_time_s,
                                             int clip) {
  std::vector<Eigen::Matrix4f> transforms = transforms_at_rest(scene.nodes);
  if (clip >= 0 && static_cast<std::size_t>(clip) < scene.animations.size()) {
    const Animation& animation = scene.animations[static_cast<std::size_t>(clip)];
    const double t_s = wrapped(animation_time_s, animation.duration_s);
    for (const AnimationChannel& channel : animation.channels)
      transforms[channel.node] = animated(channel, transforms[channel.node], t_s);
  }
  compose(scene.nodes, transforms);
  return transforms;
}

std::size_t SceneOutline::triangle_count() const {
  std::size_t indices_of_all = 0;
  for (const Mesh& mesh : meshes) indices_of_all += mesh.made_by < 0 ? mesh.index_count : 0;
  return indices_of_all / 3;
}

Box3f bounds_in_scene(const Scene& scene) {
  std::vector<Eigen::Matrix4f> transforms = transforms_at_rest(scene.nodes);
  compose(scene.nodes, transforms);
  const std::vector<Eigen::Matrix4f> joints = joint_transforms(scene.joints, transforms);
  Box3f bounds;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    for (const int index : scene.nodes[i].meshes) {
      const Mesh& mesh = scene.meshes[index];
      if (mesh.made_by >= 0) continue;  // of the same vertices
      const Eigen::Affine3f scene_from_node(transforms[i]);
      for (std::uint32_t at = mesh.first_index; at < mesh.first_index + mesh.index_count; ++at) {
        const std::uint32_t vertex = scene.indices[at];
        const Eigen::Vector3f& position = scene.vertices[vertex].position_in_node;
        bounds.extend(mesh.skinned ? skinned(position, scene.influences[vertex], joints)
                                   : Eigen::Vector3f(scene_from_node * position));
      }
    }
  return bounds;
}

}  // namespace vindu
