// The page of vindu calibrate wall on the tiles of the running wall.
#pragma once

#include "app/touch_screen.h"
#include "core/site.h"

namespace vindu::app {

/// Ten pages a second at most: who shows more waits, so that emulated cameras, which are read as
/// fast as it goes, are followed as people would be. Empty where no master of the wall runs. At its
/// end the wall shows again what it showed. Throws Error where the master that is there has another
/// version or another wall, does not answer, or refuses.
ShowPage page_on_running_wall(const Site& site, const TouchPage& first);

}  // namespace vindu::app
