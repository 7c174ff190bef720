// The buttons of a Wiimote by their names.
#pragma once

#include <string>

#include "tracker/wiimote/report.h"

namespace vindu::app {

/// "A", "Up+B", or "-".
std::string text_of(Buttons buttons);

}  // namespace vindu::app
