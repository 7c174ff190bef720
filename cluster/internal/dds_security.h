// What Cyclone is told of a participant's credentials, and what it says itself. Private to cluster.
#pragma once

#include <dds/dds.h>

#include "cluster/credentials.h"

namespace vindu::internal {

/// Throws Error where Cyclone's security plugins are not installed.
void add_credentials(dds_qos_t* participant, const Credentials& credentials);

/// From now on Cyclone's warnings and errors are lines of our log. Those of one kind, at 1, 2, 4, 8
/// ... of them: what strangers on the network cause fills no log.
void log_what_dds_says(bool with_keys);

}  // namespace vindu::internal
