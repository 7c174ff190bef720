// Cuts a scene's meshes into compact pieces, so that a tile draws only what lies in its frustum: a
// wall of 28 tiles would otherwise send every vertex through the GPU 28 times.
#pragma once

#include "renderer/scene.h"

namespace vindu {

/// Small enough to cull closely, large enough that a draw call is worth it.
constexpr std::size_t kChunkTriangles = 96;

/// Reorders the triangles of every opaque or masked mesh of over 1.5 chunks along a Morton curve
/// (G. Morton, 1966) of their centroids and makes a mesh of each run. Blended meshes keep their
/// order of triangles. Nothing else changes.
void cut_into_chunks(Scene& scene, std::size_t triangles_per_chunk = kChunkTriangles);

}  // namespace vindu
