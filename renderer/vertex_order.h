// The order of vertices and triangles in memory: GPUs read both in runs and keep the last vertices
// that they shaded; llvmpipe looks those up by the lowest bits of their index.
#pragma once

#include <span>

#include "renderer/scene.h"

namespace vindu {

/// Puts the vertices into the order in which these meshes use them first, then other triangles of
/// the scene; those that none uses go.
void order_vertices_by_use(Scene& scene, std::span<const Mesh> meshes);

/// Puts triangles (three indices each) into an order in which few vertices are shaded twice
/// (T. Forsyth, "Linear-Speed Vertex Cache Optimisation", 2006).
void order_triangles_by_vertices(std::span<std::uint32_t> indices);

}  // namespace vindu
