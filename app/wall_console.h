// What the commands that speak to a running wall share: who they are on the bus.
#pragma once

#include <string>

#include "cluster/topics.h"
#include "core/wall.h"

namespace vindu::app {

/// A console with a name that no other has.
Participant this_console();

std::vector<std::string> tile_names(const Wall& wall);

}  // namespace vindu::app
