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

/// x_in_a = result * x_in_b for as many points, least squares (Kabsch 1976); `mirrored`: the best
/// with a reflection, as a matrix.
struct PointFit {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
  double rms = 0;
};
PointFit fit_points(const std::vector<Vec3>& in_a, const std::vector<Vec3>& in_b,
                    bool mirrored = false);

}  // namespace vindu
