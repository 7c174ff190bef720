// vindu launch in its two forms: the processes of this machine, and the hosts of a wall.
#pragma once

#include "cluster/launch/local_wall.h"

namespace vindu::app {

/// Until it is stopped. Returns the exit code.
int launch_here(const LaunchRequest& request, const Site& site, int tiles_per_process);

}  // namespace vindu::app
