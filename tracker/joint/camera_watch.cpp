#include "tracker/joint/camera_watch.h"

#include <algorithm>
#include <numeric>

namespace vindu {

/// Mean and spread of what is left over, of the expected dots' picture. The first reports count for
/// more, that a camera which is far off is known soon.
void CameraWatch::note_misfit(std::span<const MisfitDot> dots) {
  constexpr double kReports = 200, kLeastSpread_px = 20;
  if (dots.empty()) return;
  reports_ = std::min(kReports, reports_ + 1);
  const double share = 1 / std::min(kReports, reports_ + 20);
  const auto count = static_cast<double>(dots.size());
  Vec2 aside_px = Vec2::Zero(), middle_px = Vec2::Zero();
  for (const MisfitDot& dot : dots) {
    aside_px += dot.residual_px / count;
    middle_px += dot.expected_px / count;
  }
  aside_px_ += share * (aside_px - aside_px_);
  double outward_px2 = 0, spread_px2 = 0;
  for (const MisfitDot& dot : dots) {
    const Vec2 arm_px = dot.expected_px - middle_px;
    outward_px2 += arm_px.dot(dot.residual_px - aside_px);
    spread_px2 += arm_px.squaredNorm();
  }
  if (spread_px2 > kLeastSpread_px * kLeastSpread_px)
    larger_ += share * (outward_px2 / spread_px2 - larger_);
}

void CameraWatch::count(const Association& association) {
  constexpr int kCalm = 30;
  if (association.accepted.empty()) return;
  fitting_ = association.widened ? 0 : fitting_ + 1;
  if (fitting_ > kCalm) widenings_ = 0;
  if (association.widened) ++widenings_;
}

void CameraWatch::judge(bool fits) {
  constexpr double kShare = 0.05, kMovedAt = 0.7, kBackAt = 0.2;
  disagreement_ += kShare * ((fits ? 0 : 1) - disagreement_);
  if (disagreement_ > kMovedAt) moved_ = true;
  if (disagreement_ < kBackAt) moved_ = false;
}

bool CameraWatch::prefers_other_time(const Association& association, double other_less_used_s) {
  constexpr double kMoving_px_s = 60, kForget = 0.995, kEnough = 60, kBetter = 0.7;
  for (const AcceptedDot& dot : association.accepted) {
    if (dot.raw_px_s.norm() < kMoving_px_s) continue;
    const Vec2 other_px = dot.residual_px - other_less_used_s * dot.raw_px_s;
    used_px2_ = kForget * used_px2_ + dot.residual_px.squaredNorm();
    other_px2_ = kForget * other_px2_ + other_px.squaredNorm();
    weight_ = kForget * weight_ + 1;
  }
  if (weight_ < kEnough || other_px2_ > kBetter * used_px2_) return false;
  std::swap(used_px2_, other_px2_);
  weight_ = 0;
  return true;
}

}  // namespace vindu
