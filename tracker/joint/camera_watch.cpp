#include "tracker/joint/camera_watch.h"

#include <algorithm>
#include <numeric>

namespace vindu {

/// Mean and spread of what is left over, of the expected dots' picture.
void CameraWatch::note_misfit(const Association& association, const DotList& dots) {
  constexpr double kShare = 0.005, kLeastSpread_px = 20;
  if (association.accepted.empty()) return;
  const auto count = static_cast<double>(association.accepted.size());
  const auto expected_px = [&](const AcceptedDot& dot) -> Vec2 {
    return raw_px_of(dots[dot.dot]) - dot.residual_px;
  };
  Vec2 aside_px = Vec2::Zero(), middle_px = Vec2::Zero();
  for (const AcceptedDot& dot : association.accepted) {
    aside_px += dot.residual_px / count;
    middle_px += expected_px(dot) / count;
  }
  aside_px_ += kShare * (aside_px - aside_px_);
  double outward_px2 = 0, spread_px2 = 0;
  for (const AcceptedDot& dot : association.accepted) {
    const Vec2 arm_px = expected_px(dot) - middle_px;
    outward_px2 += arm_px.dot(dot.residual_px - aside_px);
    spread_px2 += arm_px.squaredNorm();
  }
  if (spread_px2 > kLeastSpread_px * kLeastSpread_px)
    larger_ += kShare * (outward_px2 / spread_px2 - larger_);
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
