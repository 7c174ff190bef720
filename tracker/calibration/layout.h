// How well a helmet's LEDs can be told apart by their places alone.
#pragma once

#include <vector>

#include "core/rigid3.h"

namespace vindu {

struct LayoutAmbiguity {
  double rigid_mm = 1e9;  ///< rms by which the best wrong labelling fits, moved rigidly
  double mirrored_mm =
      1e9;  ///< the same of its mirror image, which one camera far away cannot tell
  std::vector<int> labelling;  ///< the best wrong one by rigid_mm: which LED each is taken for
};

/// Nearer than this a wrong labelling cannot be told from the right one by the noise of 3 m.
constexpr double kAmbiguous_mm = 6;

/// Of two to sixteen LEDs; fewer than three are ambiguous in any case.
LayoutAmbiguity layout_ambiguity(const std::vector<Vec3>& leds_in_body);

/// The rms by which the LEDs of the smaller body fit some of the larger's, moved rigidly: nearer
/// than kAmbiguous_mm, the two cannot be told apart. Zero for fewer than three LEDs.
double layouts_apart_mm(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace vindu
