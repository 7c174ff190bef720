// What the commands that speak to a running wall share: how they join its bus, and who they are
// there.
#pragma once

#include <string>

#include "cluster/dds.h"
#include "core/site.h"

namespace vindu::app {

/// How to join the wall: by its [cluster] and, where that names keys, with the key of the role; of
/// tiles, with that of their host, by the name of one of them. Throws Error where it does not
/// count.
DdsSettings network_of(const Site& site, Role role, const std::string& tile = {});

/// This process on the bus of that wall. `epoch`: of a master.
Participant this_participant(Role role, const std::string& name, const Site& site,
                             std::uint64_t epoch = 0);
/// A console with a name that no other has.
Participant this_console(const Site& site);

std::vector<std::string> tile_names(const Wall& wall);

}  // namespace vindu::app
