// Assimp's node tree and its animations as flat lists, parents before their children.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// `mesh_of_source[i]` is the scene's index of Assimp's mesh i, or -1 where nothing of it is left.
std::vector<Node> import_nodes(const aiScene& source, const std::vector<int>& mesh_of_source,
                               std::vector<std::string>& warnings);

/// Animations of nodes; those of bones and morph targets only where they move nodes. Channels of
/// unknown nodes and keys that are not finite are left out.
std::vector<Animation> import_animations(const aiScene& source, const std::vector<Node>& nodes);

}  // namespace vindu
