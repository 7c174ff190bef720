// A wall file as Vindu understood it, for other programs.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"

namespace vindu::app {

/// One JSON object: every tile with its corners in wall, cameras in room, heads; metres. `warnings`
/// are told as they are.
std::string json_of(const Site& site, const std::vector<std::string>& warnings);

}  // namespace vindu::app
