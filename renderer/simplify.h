// Fewer triangles for a piece of a surface, over the same vertices and with the same outer border,
// so that it fits to its neighbours whatever they look like inside.
#pragma once

#include <span>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// Edge collapse by quadric errors (M. Garland & P. Heckbert, "Surface Simplification Using Quadric
/// Error Metrics", 1997; meshoptimizer's), down to about `target` triangles or to where the shape
/// would tear. Vertices at one place that differ in normal alone, as at edges of faceted models,
/// are one while edges collapse, and each new corner takes the normal that fits best; vertices
/// that differ in texture coordinates or colour stay a seam, whose two sides move together.
/// Three indices of `vertices` for each triangle, as `indices` are.
std::vector<std::uint32_t> simplified(std::span<const Vertex> vertices,
                                      std::span<const std::uint32_t> indices, std::size_t target);

}  // namespace vindu
