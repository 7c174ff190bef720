// Test patterns: what a wall shows instead of the model, for those who set it up.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vindu {

enum class Pattern {
  none,     ///< the model
  grid,     ///< metres of the wall, circles, each tile's outermost pixels
  names,    ///< each tile's name, host, pixels, mount, which way is up
  seams,    ///< lines across all seams, on which an offset of a pixel shows
  ramps,    ///< steps of grey and of the primaries, near black and near white
  counter,  ///< the model, and over it each frame's number, to be read from the pixels again
  bar,      ///< bars that move over the whole wall, and the frame's number
  eye,      ///< the wall, the tile's frustum and the eye, from above and from the side
};

constexpr std::array kPatterns = {Pattern::none,  Pattern::grid,    Pattern::names, Pattern::seams,
                                  Pattern::ramps, Pattern::counter, Pattern::bar,   Pattern::eye};

constexpr std::string_view name_of(Pattern pattern) {
  constexpr std::string_view names[] = {"none",  "grid",    "names", "seams",
                                        "ramps", "counter", "bar",   "eye"};
  return names[static_cast<int>(pattern)];
}

/// Empty for a name that no pattern has.
constexpr std::optional<Pattern> pattern_from(std::string_view name) {
  for (const Pattern pattern : kPatterns)
    if (name_of(pattern) == name) return pattern;
  return std::nullopt;
}

/// "none", "grid", ...
inline std::vector<std::string> pattern_names() {
  std::vector<std::string> names;
  for (const Pattern pattern : kPatterns) names.emplace_back(name_of(pattern));
  return names;
}

}  // namespace vindu
