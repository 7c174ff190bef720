// What a wall file says that is no error, and still will not do.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"

namespace vindu::app {

/// What is wrong with a helmet's LEDs that can be mistaken for each other; "" where they cannot.
std::string layout_remark(const HeadConfig& head);

/// One sentence or more on each: heads that nothing tells apart, or that are not tracked as
/// [tracking] has it.
std::vector<std::string> remarks_on(const Site& site);

}  // namespace vindu::app
