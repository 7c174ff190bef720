// What the dots of a wand scatter about its poses, and which of them are no dots of it. Private to
// the wand calibration.
#pragma once

#include <cmath>
#include <vector>

#include "tracker/calibration/wand_adjust.h"

namespace vindu {

constexpr double kGate = 3;  ///< sigma, beyond which a dot is an outlier

struct Scatter {
  double sum2 = 0;  ///< square pixels
  int coordinates = 0;
  double rms() const { return coordinates > 0 ? std::sqrt(sum2 / coordinates) : 0; }
};

/// By camera, of the dots that are used; what motion adds to a dot's noise is taken out.
std::vector<Scatter> scatter_of(const std::vector<WandMoment>& moments, const WandWorld& world,
                                bool held_out);

/// Emulated cameras count as the Wiimotes that they stand for.
std::vector<CameraSource> kinds_of(const std::vector<CameraConfig>& cameras);

/// The cameras' noise from what the residuals scatter; those lack the freedom that the wand's poses
/// took.
void learn_sigma(const std::vector<WandMoment>& moments, const std::vector<CameraSource>& kinds,
                 WandWorld& world);
/// The robust beginning of the same: the median residual, of all dots.
void guess_sigma(const std::vector<WandMoment>& moments, const std::vector<CameraSource>& kinds,
                 WandWorld& world);

/// Dots beyond the gate are left out; what was left out before may return. A moment counts while
/// two views have both ends.
void drop_outliers(std::vector<WandMoment>& moments, const WandWorld& world);

/// Share of the dots that fit no wand; of a moment that has no pose at all, those of one view.
double outliers_of(const std::vector<WandMoment>& moments, const WandWorld& world);

}  // namespace vindu
