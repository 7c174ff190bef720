// Cuts a scene's meshes into compact pieces, so that a tile draws only what lies in its frustum: a
// wall of 28 tiles would otherwise send every vertex through the GPU 28 times.
#pragma once

#include "renderer/scene.h"

namespace vindu {

/// Small enough to cull closely, large enough that a draw call is worth it.
constexpr std::size_t kChunkTriangles = 96;

/// Halves every mesh across its longest side, at the median of its triangles' middles, until no
/// piece has more triangles than asked for, and makes a mesh of each piece (a k-d tree: J. Bentley,
/// 1975). Vertices are put into the order in which the pieces use them; those that none uses go.
void cut_into_chunks(Scene& scene, std::size_t triangles_per_chunk = kChunkTriangles);

}  // namespace vindu
