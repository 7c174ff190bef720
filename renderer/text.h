// Words on pictures: captions of contact sheets and names on diagrams, set in DejaVu Sans.
#pragma once

#include <string_view>

#include "renderer/image.h"

namespace vindu {

struct TextStyle {
  double height_px = 18;  ///< of a line
  Rgba8 colour = {235, 235, 235, 255};
  bool bold = false;
};

/// Width that draw_text would use. UTF-8; characters that the font lacks become its box.
int text_width_px(std::string_view text, const TextStyle& style);

/// The line's upper left is at (x, y); what falls outside the image is cut. Throws Error when the
/// font is not there.
void draw_text(Image& image, int x, int y, std::string_view text, const TextStyle& style);

}  // namespace vindu
