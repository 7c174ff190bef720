// A tile's own page: who it is and what it waits for, until it has a scene to show, and why where
// it cannot.
#pragma once

#include <span>
#include <string>

#include "renderer/image.h"

namespace vindu {

struct Notice {
  std::string title{};               ///< "tile-3-0"
  std::vector<std::string> lines{};  ///< below it; what is longer than the page is wrapped
};

/// Large letters in the middle of a dark page.
Image draw_notice(const Notice& notice, SizePx size);

}  // namespace vindu
