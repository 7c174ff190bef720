#include "renderer/import_skin.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/import_values.h"

namespace vindu {

void Pulls::add(std::uint16_t joint, double weight) {
  const auto end = strongest_.begin() + count_;
  const auto same =
      std::find_if(strongest_.begin(), end, [&](const Pull& pull) { return pull.joint == joint; });
  if (same != end)
    same->weight += weight;
  else if (count_ < strongest_.size())
    strongest_[count_++] = {joint, weight};
  else if (too_many_ = true; weight > strongest_.back().weight)
    strongest_.back() = {joint, weight};
  std::stable_sort(strongest_.begin(), strongest_.begin() + count_,
                   [](const Pull& a, const Pull& b) { return a.weight > b.weight; });
}

/// Rounded down, and what is left of the whole to the strongest.
Influences Pulls::normalised() const {
  double sum = 0;
  for (const Pull& pull : strongest_) sum += pull.weight;
  Influences influences;
  int left = kFullWeight;
  for (std::size_t i = 0; i < strongest_.size(); ++i) {
    const int share = static_cast<int>(kFullWeight * (strongest_[i].weight / sum));
    influences.joints[i] = strongest_[i].joint;
    influences.weights[i] = static_cast<std::uint16_t>(share);
    left -= share;
  }
  influences.weights[0] = static_cast<std::uint16_t>(influences.weights[0] + left);
  return influences;
}
std::optional<std::uint16_t> SkinImporter::joint_at(int node,
                                                    const Eigen::Matrix4f& joint_from_mesh) {
  Matrix key;
  std::memcpy(key.data(), joint_from_mesh.data(), sizeof(key));
  if (const auto known = known_.find({node, key}); known != known_.end()) return known->second;
  if (joints_.size() >= kMaxJoints) return std::nullopt;
  const auto index = static_cast<std::uint16_t>(joints_.size());
  joints_.push_back({node, joint_from_mesh});
  known_[{node, key}] = index;
  return index;
}

bool SkinImporter::add(const aiBone& bone, std::vector<Pulls>& pulls) {
  const auto node = node_of_name_.find(bone.mName.C_Str());
  const Eigen::Matrix4f joint_from_mesh = matrix_of(bone.mOffsetMatrix);
  if (node == node_of_name_.end() || !joint_from_mesh.allFinite()) {
    ++bones_left_out_;
    return true;
  }
  const auto joint = joint_at(node->second, joint_from_mesh);
  if (!joint) return false;
  for (unsigned i = 0; i < bone.mNumWeights; ++i) {
    const auto [vertex, weight] = bone.mWeights[i];
    if (weight == 0) continue;
    if (std::isfinite(weight) && weight > 0 && vertex < pulls.size())
      pulls[vertex].add(*joint, weight);
    else
      ++weights_left_out_;
  }
  return true;
}

std::vector<Influences> SkinImporter::read(const aiMesh& mesh, int node) {
  std::vector<Pulls> pulls(mesh.HasBones() ? mesh.mNumVertices : 0);
  bool fits = true;
  for (unsigned b = 0; fits && b < mesh.mNumBones; ++b) fits = add(*mesh.mBones[b], pulls);
  if (fits && std::ranges::all_of(pulls, &Pulls::none)) return {};
  std::vector<Influences> influences;
  for (Pulls& of_vertex : pulls) {
    const auto own = of_vertex.none() ? joint_at(node, Eigen::Matrix4f::Identity()) : 0;
    fits = fits && own;
    if (!fits) break;
    if (of_vertex.none()) of_vertex.add(*own, 1);
    vertices_of_many_ += of_vertex.too_many() ? 1 : 0;
    influences.push_back(of_vertex.normalised());
  }
  if (fits) return influences;
  ++meshes_that_do_not_fit_;
  return {};
}

void SkinImporter::warn(std::vector<std::string>& warnings) const {
  const auto warn = [&](std::size_t count, const std::string& what) {
    if (count > 0) warnings.push_back(std::to_string(count) + what);
  };
  warn(bones_left_out_, " bones name no node or have no finite matrix; they move nothing");
  warn(weights_left_out_, " weights of bones are not numbers or of no vertex; they are left out");
  warn(vertices_of_many_, " vertices follow more than four bones; the four strongest count");
  warn(meshes_that_do_not_fit_, " meshes stand still: beyond " + std::to_string(kMaxJoints) +
                                    " bones in a file there is no room");
}

}  // namespace vindu
