#include "tracker/joint/disagreement.h"

#include <algorithm>
#include <array>

namespace vindu {
namespace {

/// Half a degree of a Wiimote at the most: beyond, anything fits.
constexpr std::array<double, 3> kTried_px = {2, 5, 12};
constexpr int kLooks = 12;     // that fail, a third of a second, before the next one is tried
constexpr int kBaffled = 400;  // ten seconds: lamps are masked by then

}  // namespace

void Disagreement::found_with(double sigma_px) { sigma_px_ = std::max(sigma_px_, sigma_px); }

void Disagreement::note_aside(double largest_px) {
  constexpr double kUsual_px = 0.8, kUp = 0.02, kDown = 0.001;
  const double wanted_px = largest_px > kUsual_px ? std::min(largest_px, kTried_px.back()) : 0;
  sigma_px_ += (wanted_px > sigma_px_ ? kUp : kDown) * (wanted_px - sigma_px_);
  if (wanted_px == 0 && sigma_px_ < 0.1) sigma_px_ = 0;
}

void FailedLooks::add(bool dots_enough) {
  failed_ = std::clamp(failed_ + (dots_enough ? 1 : -1), 0, kBaffled + kLooks);
  attempts_ = failed_ == 0 ? 0 : attempts_ + (dots_enough ? 1 : 0);
}

double FailedLooks::tried_px() const {
  const auto tries = static_cast<std::size_t>(attempts_ / kLooks) % (kTried_px.size() + 1);
  return tries == 0 ? 0 : kTried_px[tries - 1];
}

bool FailedLooks::baffled() const { return failed_ > kBaffled; }

}  // namespace vindu
