// Where a model stands before the wall: wall_from_scene from its size, its unit and what the user
// asked for.
#pragma once

#include <string>

#include "core/frame_state.h"
#include "core/site.h"
#include "renderer/packed_scene.h"

namespace vindu {

struct PlacedScene {
  Navigation navigation;
  std::string remark;  ///< what a user should know, or empty
};

/// fit: four fifths of the wall's width or height, whichever is reached first, centred, its front
/// in the screen plane. life_size: metres if the file states its unit, else fitted, and the remark
/// says so. as_is: coordinates are wall's.
PlacedScene place_scene(const PackedScene& packed, Placement placement, const Wall& wall);

}  // namespace vindu
