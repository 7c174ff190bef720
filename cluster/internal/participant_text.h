// A participant as text, as it stands in the user data of DDS' discovery: "role=tile name=tile-3-0
// host=node7 version=0.1.0 protocol=1". Private to cluster.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cluster/topics.h"

namespace vindu::internal {

/// Throws Error where a name cannot be said.
std::string text_of(const Participant& participant);

/// Empty when it is no Vindu's. Words that are not known are left out, so that later versions may
/// say more.
std::optional<Participant> participant_from(std::string_view text);

}  // namespace vindu::internal
