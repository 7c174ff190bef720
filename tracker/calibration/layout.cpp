#include "tracker/calibration/layout.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace vindu {
namespace {

/// Fits on three LEDs tell where the others come to lie: each is taken for the nearest that is
/// left.
std::vector<int> extended(const std::vector<Vec3>& leds, const std::vector<int>& from,
                          const std::vector<int>& to, bool mirrored) {
  std::vector<Vec3> in_a, in_b;
  std::vector<int> labelling(leds.size(), -1);
  std::vector<bool> taken(leds.size(), false);
  for (std::size_t i = 0; i < from.size(); ++i) {
    in_a.push_back(leds[static_cast<std::size_t>(to[i])]);
    in_b.push_back(leds[static_cast<std::size_t>(from[i])]);
    labelling[static_cast<std::size_t>(from[i])] = to[i];
    taken[static_cast<std::size_t>(to[i])] = true;
  }
  const PointFit fit = fit_points(in_a, in_b, mirrored);
  for (std::size_t led = 0; led < leds.size(); ++led) {
    if (labelling[led] >= 0) continue;
    const Vec3 there = fit.rotation * leds[led] + fit.translation;
    double nearest = 1e300;
    for (std::size_t other = 0; other < leds.size(); ++other)
      if (!taken[other] && (leds[other] - there).norm() < nearest) {
        nearest = (leds[other] - there).norm();
        labelling[led] = static_cast<int>(other);
      }
    taken[static_cast<std::size_t>(labelling[led])] = true;
  }
  return labelling;
}

double misfit_mm(const std::vector<Vec3>& leds, const std::vector<int>& labelling, bool mirrored) {
  std::vector<Vec3> taken_for;
  for (const int other : labelling) taken_for.push_back(leds[static_cast<std::size_t>(other)]);
  return 1e3 * fit_points(taken_for, leds, mirrored).rms;
}

bool is_right(const std::vector<int>& labelling) { return std::ranges::is_sorted(labelling); }

void try_labelling(const std::vector<Vec3>& leds, const std::vector<int>& to,
                   LayoutAmbiguity& worst) {
  std::vector<int> from(to.size());
  std::iota(from.begin(), from.end(), 0);
  for (const bool mirrored : {false, true}) {
    const auto labelling = extended(leds, from, to, mirrored);
    if (is_right(labelling)) continue;
    const double rigid_mm = misfit_mm(leds, labelling, false);
    if (rigid_mm < worst.rigid_mm) worst.rigid_mm = rigid_mm, worst.labelling = labelling;
    worst.mirrored_mm = std::min(worst.mirrored_mm, misfit_mm(leds, labelling, true));
  }
}

}  // namespace

PointFit fit_points(const std::vector<Vec3>& in_a, const std::vector<Vec3>& in_b, bool mirrored) {
  const auto count = static_cast<double>(in_a.size());
  Vec3 middle_a = Vec3::Zero(), middle_b = Vec3::Zero();
  for (std::size_t i = 0; i < in_a.size(); ++i)
    middle_a += in_a[i] / count, middle_b += in_b[i] / count;
  Mat3 spread = Mat3::Zero();
  for (std::size_t i = 0; i < in_a.size(); ++i)
    spread += (in_a[i] - middle_a) * (in_b[i] - middle_b).transpose();
  const Eigen::JacobiSVD<Mat3> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double turn = svd.matrixU().determinant() * svd.matrixV().determinant();
  Vec3 signs(1, 1, (mirrored ? -1 : 1) * (turn < 0 ? -1 : 1));
  PointFit fit;
  fit.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  fit.translation = middle_a - fit.rotation * middle_b;
  double sum2 = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i)
    sum2 += (fit.rotation * in_b[i] + fit.translation - in_a[i]).squaredNorm();
  fit.rms = std::sqrt(sum2 / count);
  return fit;
}

LayoutAmbiguity layout_ambiguity(const std::vector<Vec3>& leds_in_body) {
  LayoutAmbiguity worst;
  const int count = static_cast<int>(leds_in_body.size());
  if (count < 3) return {0, 0, {}};
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
      for (int c = 0; c < count; ++c)
        if (a != b && b != c && c != a) try_labelling(leds_in_body, {a, b, c}, worst);
  return worst;
}

}  // namespace vindu
