// Where the pages of vindu calibrate wall are shown on this machine: in a window, or as files.
#pragma once

#include <functional>
#include <string>

#include "core/wall.h"
#include "renderer/touch_page.h"

namespace vindu::app {

/// Shows a page; false when the window was closed.
using ShowPage = std::function<bool(const TouchPage&)>;

/// A wall of one tile fills its screen, pixel for pixel; of a larger one the window shows all tiles
/// together, small. Bound to the thread that made it. Throws Error where no window can be opened.
ShowPage page_window(const Wall& wall);

/// Writes touch-N.png, the picture of the tile that has point N at its full size, and wall-N.png,
/// all tiles together: when point N is next, when dots are refused there, and as it was when the
/// point was touched; at the end wall-done.png. Throws Error when a file cannot be written.
ShowPage page_folder(const Wall& wall, const std::string& folder);

/// All tiles' pictures in their places, and below them a line of words; smaller than they are where
/// that would be larger than `largest`.
Image joined_pages(const TouchPage& page, const Wall& wall, SizePx largest);

}  // namespace vindu::app
