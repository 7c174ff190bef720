// A picture of times against sizes, both by their logarithms: a curve for each thing that was
// measured.
#pragma once

#include <string>
#include <vector>

#include "core/rigid3.h"
#include "renderer/image.h"

namespace vindu {

struct Curve {
  std::string name;  ///< empty: it stands in no legend
  Rgba8 colour;
  std::vector<Vec2> points;  ///< size, ms
};

struct LogAxis {
  std::string title;
  std::vector<double> marks;  ///< in order; the axis reaches from the first to the last
};

/// `words`: what machine, which picture.
Image log_plot(const std::vector<Curve>& curves, const LogAxis& sizes, const std::string& words);

/// "100 k", "10 M"
std::string short_number(double number);

}  // namespace vindu
