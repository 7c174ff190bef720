// Joins what stands still: a building of ten thousand parts, each at a node of its own, is drawn by
// as many calls as it has materials.
#pragma once

#include "renderer/scene.h"

namespace vindu {

/// Moves meshes that no animation moves to one node at the end, and those of them that share an
/// opaque or masked material into one mesh; blended ones stay apart, as their order matters. What
/// several nodes show stays with them unless it is so small that a call would cost more. Nodes that
/// nothing needs any more go. All of it is where it was: to a float's precision at the middle of
/// what was joined, wherever in the world that is.
void join_still_parts(Scene& scene);

}  // namespace vindu
