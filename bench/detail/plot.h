// The bench's picture: the time of a frame against the number of triangles, with levels of detail,
// without them, and osgviewer's.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.h"

namespace vindu {

struct DetailCurve {
  std::string name;
  Rgba8 colour;
  std::vector<std::pair<double, double>> triangles_and_ms;
};

/// `words`: what machine, which picture.
Image detail_plot(const std::vector<DetailCurve>& curves, const std::string& words);

}  // namespace vindu
