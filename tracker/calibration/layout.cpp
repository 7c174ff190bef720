#include "tracker/calibration/layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "tracker/point_fit.h"

namespace vindu {
namespace {

/// Fits on three LEDs tell where the others come to lie: each is taken for the nearest of the
/// other body's that is left. That has as many LEDs or more.
std::vector<int> extended(const std::vector<Vec3>& leds, const std::vector<Vec3>& others,
                          const std::vector<int>& from, const std::vector<int>& to, bool mirrored) {
  std::vector<Vec3> in_a, in_b;
  std::vector<int> labelling(leds.size(), -1);
  std::vector<bool> taken(others.size(), false);
  for (std::size_t i = 0; i < from.size(); ++i) {
    in_a.push_back(others[static_cast<std::size_t>(to[i])]);
    in_b.push_back(leds[static_cast<std::size_t>(from[i])]);
    labelling[static_cast<std::size_t>(from[i])] = to[i];
    taken[static_cast<std::size_t>(to[i])] = true;
  }
  const PointFit fit = fit_points(in_a, in_b, mirrored);
  for (std::size_t led = 0; led < leds.size(); ++led) {
    if (labelling[led] >= 0) continue;
    const Vec3 there = fit.rotation * leds[led] + fit.translation;
    double nearest = 1e300;
    for (std::size_t other = 0; other < others.size(); ++other)
      if (!taken[other] && (others[other] - there).norm() < nearest) {
        nearest = (others[other] - there).norm();
        labelling[led] = static_cast<int>(other);
      }
    taken[static_cast<std::size_t>(labelling[led])] = true;
  }
  return labelling;
}

double misfit_mm(const std::vector<Vec3>& leds, const std::vector<Vec3>& others,
                 const std::vector<int>& labelling, bool mirrored) {
  std::vector<Vec3> taken_for;
  for (const int other : labelling) taken_for.push_back(others[static_cast<std::size_t>(other)]);
  return 1e3 * fit_points(taken_for, leds, mirrored).rms;
}

/// Of every three different numbers below `count`, in every order.
template <class Take>
void for_each_triple(std::size_t count, Take take) {
  const int end = static_cast<int>(count);
  for (int a = 0; a < end; ++a)
    for (int b = 0; b < end; ++b)
      for (int c = 0; c < end; ++c)
        if (a != b && b != c && c != a) take(std::vector<int>{a, b, c});
}

bool is_right(const std::vector<int>& labelling) { return std::ranges::is_sorted(labelling); }

void try_labelling(const std::vector<Vec3>& leds, const std::vector<int>& to,
                   LayoutAmbiguity& worst) {
  std::vector<int> from(to.size());
  std::iota(from.begin(), from.end(), 0);
  for (const bool mirrored : {false, true}) {
    const auto labelling = extended(leds, leds, from, to, mirrored);
    if (is_right(labelling)) continue;
    const double rigid_mm = misfit_mm(leds, leds, labelling, false);
    if (rigid_mm < worst.rigid_mm) worst.rigid_mm = rigid_mm, worst.labelling = labelling;
    worst.mirrored_mm = std::min(worst.mirrored_mm, misfit_mm(leds, leds, labelling, true));
  }
}

}  // namespace

LayoutAmbiguity layout_ambiguity(const std::vector<Vec3>& leds_in_body) {
  LayoutAmbiguity worst;
  if (leds_in_body.size() < 3) return {0, 0, {}};
  for_each_triple(leds_in_body.size(),
                  [&](const std::vector<int>& to) { try_labelling(leds_in_body, to, worst); });
  return worst;
}

double layouts_apart_mm(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const auto& [smaller, larger] = a.size() <= b.size() ? std::tie(a, b) : std::tie(b, a);
  if (smaller.size() < 3) return 0;
  double least_mm = 1e9;
  for_each_triple(larger.size(), [&, &few = smaller, &many = larger](const std::vector<int>& to) {
    least_mm =
        std::min(least_mm, misfit_mm(few, many, extended(few, many, {0, 1, 2}, to, false), false));
  });
  return least_mm;
}

}  // namespace vindu
