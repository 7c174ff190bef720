// One picture that a stranger understands at a glance: for several moments, the room with the
// person, what the wall shows, and what the person sees.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.h"

namespace vindu::app {

struct Moment {
  std::string title;    ///< "far left"
  std::string caption;  ///< figures of this moment
  Image room;
  Image wall;
  Image eye;
};

struct SheetText {
  std::string title;
  std::string subtitle;
};

/// One column a moment. Pictures of one row must have one size.
Image contact_sheet(const SheetText& text, const std::vector<Moment>& moments);

}  // namespace vindu::app
