// One Assimp mesh into the scene's vertex and index arrays: triangles only, without what is not
// finite or not there, equal vertices joined, normals of unit length, computed where they are
// missing.
#pragma once

#include <assimp/mesh.h>

#include <cstddef>
#include <optional>

#include "renderer/scene.h"

namespace vindu {

/// x_in_texture = texture_from_uv * (u, v, 1); (0, 0) is the upper left on both sides.
using UvTransform = Eigen::Matrix<float, 2, 3>;

struct MeshOptions {
  unsigned uv_channel = 0;  ///< which of the mesh's texture coordinates the material uses
  UvTransform texture_from_uv = UvTransform::Identity();
  bool own_normals = false;  ///< the file's are not to be trusted: compute all
};

/// What was left out, over all meshes.
struct MeshLosses {
  std::size_t broken_triangles = 0;  ///< a vertex that is not finite or not there
  std::size_t points_and_lines = 0;
  std::size_t skinned_meshes = 0;  ///< shown as they lie in the file
  std::size_t morphed_meshes = 0;
};

/// Appends vertices and indices; the result's material is 0. Empty when no triangle is left.
std::optional<Mesh> append_mesh(const aiMesh& source, const MeshOptions& options, Scene& scene,
                                MeshLosses& losses);

}  // namespace vindu
