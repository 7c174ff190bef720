// Levels of detail of a scene's opaque surfaces: chunks that lie together get a coarser set of
// chunks that stands for all of them, those again, until nothing is left to leave out. Docs:
// docs/decisions/0011-levels-of-detail.md.
#pragma once

#include "renderer/scene.h"

namespace vindu {

/// After cut_into_chunks(): adds the coarser chunks to the scene's meshes and to the nodes that
/// show the finer ones, over the same vertices. Which of them to draw: Mesh::made_by and
/// replaced_by. All chunks of a coarsening's outer border keep its vertices, and neighbouring
/// coarsenings differ from level to level, so borders get coarser too and never crack. An error
/// is measured, not estimated (renderer/level_error.h).
void make_levels(Scene& scene);

}  // namespace vindu
