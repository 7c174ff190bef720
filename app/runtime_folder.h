// Where the processes of a wall keep what the machine may forget when it is switched off.
#pragma once

#include <string>

#include "core/site.h"

namespace vindu::app {

/// Of a wall on this machine, for this user alone; made where it is not yet. Nothing of its path
/// comes over the network. Throws Error where it is somebody else's.
std::string runtime_folder(const ClusterConfig& cluster);

/// Its own name, in the user's folder for such things.
std::string runtime_folder_name(const ClusterConfig& cluster);

}  // namespace vindu::app
