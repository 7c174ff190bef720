// One Assimp mesh into the scene's vertex and index arrays: triangles only, without what is not
// finite or not there, equal vertices joined, normals of unit length, computed where they are
// missing.
#pragma once

#include <assimp/mesh.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "renderer/scene.h"

namespace vindu {

/// Which of a mesh's texture coordinates the material uses: what becomes Vertex::uv and ::uv_1.
using UvChannels = std::array<unsigned, 2>;

struct MeshOptions {
  UvChannels uv_channels = {0, 0};
  bool own_normals = false;                ///< the file's are not to be trusted: compute all
  std::optional<TextureUse> normal_map;    ///< where there is one, vertices get tangents
  std::span<const Influences> influences;  ///< of each of its vertices; empty: no bone moves any
};

/// What was left out, over all meshes.
struct MeshLosses {
  std::size_t broken_triangles = 0;  ///< a vertex that is not finite or not there
  std::size_t points_and_lines = 0;
  std::size_t morphed_meshes = 0;
};

/// Appends vertices and indices; the result's material is 0. Empty when no triangle is left.
std::optional<Mesh> append_mesh(const aiMesh& source, const MeshOptions& options, Scene& scene,
                                MeshLosses& losses);

}  // namespace vindu
