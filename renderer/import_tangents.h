// Tangents for normal maps, where a model comes without.
#pragma once

#include "renderer/scene.h"

namespace vindu {

/// Gives every vertex of the mesh a unit tangent at right angles to its normal; those that have one
/// keep it. A tangent is the mean of where the texture's u grows on the triangles around, weighted
/// by their area (E. Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001).
/// A vertex between a texture and its mirror image is split: each side has its own sign. Where the
/// texture says nothing, any direction will do.
void complete_tangents(Scene& scene, const Mesh& mesh, const TextureUse& normal_map);

}  // namespace vindu
