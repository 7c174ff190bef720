// Assimp's node tree and its animations as flat lists, parents before their children.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <string>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// A node that shows one of Assimp's meshes.
struct MeshUse {
  int node = 0;
  unsigned source_mesh = 0;
};

struct ImportedNodes {
  std::vector<Node> nodes{};             ///< without their meshes
  std::vector<MeshUse> meshes{};         ///< in the order of nodes; of those that are there and not
  std::map<std::string, int> by_name{};  ///< the first of each name
};

ImportedNodes import_nodes(const aiScene& source, std::vector<std::string>& warnings);

/// Animations of nodes, which bones are too; not of morph targets. Channels of
/// unknown nodes and keys that are not finite are left out.
std::vector<Animation> import_animations(const aiScene& source,
                                         const std::map<std::string, int>& node_of_name);

}  // namespace vindu
