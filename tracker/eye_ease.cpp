#include "tracker/eye_ease.h"

#include <algorithm>
#include <utility>

namespace vindu {
namespace {

// 3u^2 - 2u^3: from 0 to 1, at rest at both ends, steepest slope 1.5.
double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

}  // namespace

EyeEase::EyeEase(const Vec3& default_eye_in_wall, const EyeEaseOptions& options)
    : options_(options),
      default_eye_in_wall_(default_eye_in_wall),
      shown_in_wall_(default_eye_in_wall),
      start_(default_eye_in_wall) {}

Vec3 EyeEase::update(const std::optional<Vec3>& tracked_eye_in_wall, Time now) {
  const Phase phase = tracked_eye_in_wall ? Phase::tracked : Phase::lost;
  const bool goes_on = started_ && phase == phase_;
  const double dt_s = seconds(now - std::exchange(updated_at_, now));
  started_ = true;
  phase_ = phase;
  if (!tracked_eye_in_wall) {
    if (!goes_on) {
      since_ = now;
      start_ = shown_in_wall_;
    }
    return shown_in_wall_ = hold_or_return(now);
  }
  const Vec3 step = *tracked_eye_in_wall - std::exchange(tracked_in_wall_, *tracked_eye_in_wall);
  if (!goes_on) velocity_m_s_.setZero();
  if (!goes_on || leapt(step, dt_s)) {
    start_ = shown_in_wall_ - *tracked_eye_in_wall;
    melted_s_ = 0;
  } else {
    melt(step.norm(), dt_s);
  }
  return shown_in_wall_ = *tracked_eye_in_wall + left_after(melted_s_);
}

// Whether the tracked eye is not where its motion over the last frames would have brought it. What
// is known of that motion follows as fast as people accelerate, and no leap.
bool EyeEase::leapt(const Vec3& step, double dt_s) {
  if (dt_s <= 0) return false;
  const Vec3 surprise = step - dt_s * velocity_m_s_;
  const double change_m_s = surprise.norm() / dt_s;
  const double largest_m_s = options_.acceleration_m_s2 * dt_s;
  velocity_m_s_ += std::min(1.0, largest_m_s / std::max(change_m_s, 1e-9)) * surprise / dt_s;
  return surprise.norm() > options_.leap_m + options_.leap_m_s * dt_s;
}

// The offset at the start melts; the time it takes grows with it, so that a short gap in the
// tracking costs milliseconds and a long way is not leapt.
Vec3 EyeEase::left_after(double melted_s) const {
  const double within_s = 1.5 * start_.norm() / options_.catch_up_m_s;
  if (melted_s >= within_s) return Vec3::Zero();
  return (1 - smooth_step(melted_s / within_s)) * start_;
}

// The slower, the more of the speed that a shown eye may have is that of the tracked one.
void EyeEase::melt(double way_m, double dt_s) {
  const double melts_m = (left_after(melted_s_ + dt_s) - left_after(melted_s_)).norm();
  if (melts_m == 0) return;
  const double spare_m = options_.most_m_s * dt_s - way_m;
  melted_s_ += std::clamp(spare_m / melts_m, 0.0, 1.0) * dt_s;
}

Vec3 EyeEase::hold_or_return(Time now) {
  const Duration returning = now - since_ - options_.held_for;
  const double within_s =
      std::max(seconds(options_.to_default_within),
               1.5 * (default_eye_in_wall_ - start_).norm() / options_.to_default_m_s);
  const double u = seconds(returning) / within_s;
  return start_ + smooth_step(u) * (default_eye_in_wall_ - start_);
}

}  // namespace vindu
