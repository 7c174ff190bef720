// Bones of Assimp's meshes as the scene's joints: of each vertex the four strongest, normalised. A
// bone names its node; Assimp's mOffsetMatrix takes the mesh to that node as it stood when the two
// were bound, whatever the format, so the mesh's own node does not count.
#pragma once

#include <assimp/mesh.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// What moves one vertex: as many joints as Influences holds, the strongest first.
class Pulls {
 public:
  /// Above zero and finite. A joint that is there already pulls the more.
  void add(std::uint16_t joint, double weight);
  bool none() const { return count_ == 0; }
  bool too_many() const { return too_many_; }
  /// Of at least one.
  Influences normalised() const;

 private:
  struct Pull {
    std::uint16_t joint = 0;
    double weight = 0;
  };
  std::array<Pull, 4> strongest_{};
  std::uint8_t count_ = 0;
  bool too_many_ = false;
};

class SkinImporter {
 public:
  /// Appends to `joints`. Both must outlive it.
  SkinImporter(const std::map<std::string, int>& node_of_name, std::vector<Joint>& joints)
      : node_of_name_(node_of_name), joints_(joints) {}

  /// Of each vertex of a mesh, which hangs on `node`: that moves what no bone does. Empty where
  /// none of its vertices follows a bone.
  std::vector<Influences> read(const aiMesh& mesh, int node);

  /// What was lost, over all meshes.
  void warn(std::vector<std::string>& warnings) const;

 private:
  using Matrix = std::array<float, 16>;
  /// False where there is no room for another joint.
  bool add(const aiBone& bone, std::vector<Pulls>& pulls);
  std::optional<std::uint16_t> joint_at(int node, const Eigen::Matrix4f& joint_from_mesh);

  const std::map<std::string, int>& node_of_name_;
  std::vector<Joint>& joints_;
  std::map<std::pair<int, Matrix>, std::uint16_t> known_;
  std::size_t bones_left_out_ = 0, weights_left_out_ = 0;
  std::size_t vertices_of_many_ = 0;
  std::size_t meshes_that_do_not_fit_ = 0;
};

}  // namespace vindu
