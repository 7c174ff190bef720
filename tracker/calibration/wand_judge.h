// Whether a wand calibration may be believed: refusals, and the figures that they rest on. Private
// to the wand calibration.
#pragma once

#include <string>
#include <vector>

#include "tracker/calibration/wand.h"
#include "tracker/calibration/wand_adjust.h"

namespace vindu {

/// LEDs that are unevenly spaced enough to be told apart, rising from 0. Throws Error else.
void check_leds(const std::vector<double>& leds_m);

/// Dots per picture cell of each camera, of the moments that are used.
std::vector<Coverage> coverage_of(const std::vector<WandMoment>& moments,
                                  const std::vector<CameraConfig>& cameras);

/// Lengths between LEDs as rays alone have them, without knowledge of the wand.
struct MeasuredWand {
  std::vector<double> outer_m;            ///< first to last LED, of each held-out moment
  std::vector<double> predicted_sigma_m;  ///< of each, by the dots' noise
  double place = 0;                       ///< of the middle LED, 0 to 1: median; 0 for two LEDs
  double place_sigma = 0;                 ///< of that median
};
MeasuredWand measure_wand(const std::vector<WandMoment>& moments, const WandWorld& world);

/// Throws Error for moments too few or one-sided to begin with.
void refuse_too_little(const std::vector<WandMoment>& moments,
                       const std::vector<Coverage>& coverage,
                       const std::vector<std::string>& names);
/// Throws Error for a wand of other proportions than said.
void refuse_other_wand(const MeasuredWand& measured, const std::vector<double>& leds_m);
/// How far apart the cameras stand, over what the wall file says; 1 where that says nothing.
double size_ratio(const WandWorld& world, const std::vector<CameraConfig>& cameras);
/// Throws Error for cameras that stand much nearer or farther apart than the wall file says.
void refuse_other_size(double size_ratio);
/// "" for a wand that is as long in one place as in another.
std::string scatter_doubt(const WandResult& result);
/// What may be wrong with a result that is not refused, for people.
std::vector<std::string> doubts_of(const WandResult& result, double size_ratio);

}  // namespace vindu
