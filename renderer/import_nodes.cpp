#include "renderer/import_nodes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "renderer/import_values.h"

namespace vindu {
namespace {

Node node_of(const aiNode& source, int parent) {
  Node node;
  node.name = source.mName.C_Str();
  node.parent = parent;
  node.parent_from_node = matrix_of(source.mTransformation);
  return node;
}

/// Assimp's default where a file does not say.
constexpr double kDefaultTicksPerSecond = 25;

template <class Value>
void put_in_order(std::vector<Key<Value>>& keys) {
  std::ranges::stable_sort(keys, {}, &Key<Value>::t_s);
}

std::vector<Key<Eigen::Vector3f>> vector_keys(const aiVectorKey* source, unsigned count,
                                              double ticks_per_s) {
  std::vector<Key<Eigen::Vector3f>> keys;
  for (unsigned i = 0; i < count; ++i) {
    const aiVector3D& v = source[i].mValue;
    const Eigen::Vector3f value(v.x, v.y, v.z);
    if (std::isfinite(source[i].mTime) && value.allFinite())
      keys.push_back({source[i].mTime / ticks_per_s, value});
  }
  put_in_order(keys);
  return keys;
}

std::vector<Key<Eigen::Quaternionf>> rotation_keys(const aiQuatKey* source, unsigned count,
                                                   double ticks_per_s) {
  std::vector<Key<Eigen::Quaternionf>> keys;
  for (unsigned i = 0; i < count; ++i) {
    const aiQuaternion& q = source[i].mValue;
    const Eigen::Quaternionf value(q.w, q.x, q.y, q.z);
    const float norm = value.norm();
    if (std::isfinite(source[i].mTime) && std::isfinite(norm) && norm > 1e-6f)
      keys.push_back({source[i].mTime / ticks_per_s, value.normalized()});
  }
  put_in_order(keys);
  return keys;
}

AnimationChannel channel_of(const aiNodeAnim& source, int node, double ticks_per_s) {
  return {node, vector_keys(source.mPositionKeys, source.mNumPositionKeys, ticks_per_s),
          rotation_keys(source.mRotationKeys, source.mNumRotationKeys, ticks_per_s),
          vector_keys(source.mScalingKeys, source.mNumScalingKeys, ticks_per_s)};
}

double last_key_s(const AnimationChannel& channel) {
  double last_s = 0;
  if (!channel.translations.empty()) last_s = std::max(last_s, channel.translations.back().t_s);
  if (!channel.rotations.empty()) last_s = std::max(last_s, channel.rotations.back().t_s);
  if (!channel.scales.empty()) last_s = std::max(last_s, channel.scales.back().t_s);
  return last_s;
}

Animation animation_of(const aiAnimation& source, const std::map<std::string, int>& node_of_name) {
  const double ticks_per_s =
      source.mTicksPerSecond > 0 ? source.mTicksPerSecond : kDefaultTicksPerSecond;
  Animation animation{source.mName.C_Str(), source.mDuration / ticks_per_s, {}};
  double last_s = 0;
  for (unsigned i = 0; i < source.mNumChannels; ++i) {
    const auto node = node_of_name.find(source.mChannels[i]->mNodeName.C_Str());
    if (node == node_of_name.end()) continue;
    animation.channels.push_back(channel_of(*source.mChannels[i], node->second, ticks_per_s));
    last_s = std::max(last_s, last_key_s(animation.channels.back()));
  }
  if (!std::isfinite(animation.duration_s) || animation.duration_s <= 0)
    animation.duration_s = last_s;
  return animation;
}

}  // namespace

ImportedNodes import_nodes(const aiScene& source, std::vector<std::string>& warnings) {
  struct Task {
    const aiNode* node;
    int parent;
  };
  ImportedNodes imported;
  std::vector<Node>& nodes = imported.nodes;
  std::unordered_map<const aiNode*, int> index_of;
  std::vector<Task> tasks = {{source.mRootNode, -1}};  // a stack: trees may be very deep
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const int index = static_cast<int>(nodes.size());
    // Assimp 5.2's Half-Life loader lists all bones as children of one node; they know better.
    const auto own_parent = index_of.find(task.node->mParent);
    nodes.push_back(
        node_of(*task.node, own_parent != index_of.end() ? own_parent->second : task.parent));
    index_of[task.node] = index;
    imported.by_name.try_emplace(nodes.back().name, index);
    for (unsigned i = 0; i < task.node->mNumMeshes; ++i)
      imported.meshes.push_back({index, task.node->mMeshes[i]});
    if (!nodes.back().parent_from_node.allFinite()) {
      nodes.back().parent_from_node.setIdentity();
      warnings.push_back("node " + nodes.back().name + ": its transform is not finite; left out");
    }
    for (unsigned i = task.node->mNumChildren; i-- > 0;)
      if (task.node->mChildren[i]) tasks.push_back({task.node->mChildren[i], index});
  }
  return imported;
}

std::vector<Animation> import_animations(const aiScene& source,
                                         const std::map<std::string, int>& node_of_name) {
  std::vector<Animation> animations;
  for (unsigned i = 0; i < source.mNumAnimations; ++i) {
    Animation animation = animation_of(*source.mAnimations[i], node_of_name);
    if (!animation.channels.empty() && animation.duration_s > 0)
      animations.push_back(std::move(animation));
  }
  return animations;
}

}  // namespace vindu
