// A wall file as Vindu understood it, for other programs.
#pragma once

#include <string>

#include "core/site.h"

namespace vindu::app {

/// One JSON object: every tile with its corners in wall, cameras in room, heads; metres.
std::string json_of(const Site& site);

}  // namespace vindu::app
