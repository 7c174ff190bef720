#include "app/fluid_scale.h"

#include <algorithm>
#include <cmath>

namespace vindu::app {
namespace {

constexpr double kLeast = 0.04;

struct Trial {
  double scale = 0;
  double time_s = 0;
};

/// Where time, which grows with the pixels, reaches the budget between one that fits and one that
/// does not.
double scale_at(const Trial& fits, const Trial& slow, double budget_s) {
  const double least = fits.scale * fits.scale, most = slow.scale * slow.scale;
  const double share = (budget_s - fits.time_s) / (slow.time_s - fits.time_s);
  return std::sqrt(least + share * (most - least));
}

}  // namespace

double fluid_scale(const std::function<double(double scale)>& frame_s, double budget_s) {
  Trial fits{kLeast, frame_s(kLeast)};
  double fastest_s = fits.time_s;
  while (fits.scale < 1) {
    const double scale = std::min(2 * fits.scale, 1.0);
    const Trial next{scale, frame_s(scale)};
    fastest_s = std::min(fastest_s, next.time_s);
    const double allowed_s = std::max(budget_s, 1.2 * fastest_s);
    if (next.time_s > allowed_s) return scale_at(fits, next, allowed_s);
    fits = next;
  }
  return fits.scale;
}

}  // namespace vindu::app
