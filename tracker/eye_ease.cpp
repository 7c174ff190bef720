#include "tracker/eye_ease.h"

#include <algorithm>

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
  const bool leap = tracked_eye_in_wall && leapt(*tracked_eye_in_wall, now);
  if (!started_ || phase != phase_ || leap) {
    started_ = true;
    phase_ = phase;
    since_ = now;
    start_ = tracked_eye_in_wall ? Vec3(shown_in_wall_ - *tracked_eye_in_wall) : shown_in_wall_;
  }
  shown_in_wall_ = tracked_eye_in_wall ? follow(*tracked_eye_in_wall, now) : hold_or_return(now);
  return shown_in_wall_;
}

// Whether the tracked eye is not where its motion over the last frames would have brought it. What
// is known of that motion follows as fast as people accelerate, and no leap.
bool EyeEase::leapt(const Vec3& tracked_eye_in_wall, Time now) {
  const double dt_s = seconds(now - tracked_at_);
  const bool follows = started_ && phase_ == Phase::tracked && dt_s > 0;
  const Vec3 surprise = tracked_eye_in_wall - tracked_in_wall_ - dt_s * velocity_m_s_;
  tracked_in_wall_ = tracked_eye_in_wall;
  tracked_at_ = now;
  if (!follows) {
    velocity_m_s_.setZero();
    return false;
  }
  const double change_m_s = surprise.norm() / dt_s;
  const double largest_m_s = options_.acceleration_m_s2 * dt_s;
  velocity_m_s_ += std::min(1.0, largest_m_s / std::max(change_m_s, 1e-9)) * surprise / dt_s;
  return surprise.norm() > options_.leap_m + options_.leap_m_s * dt_s;
}

// The offset at the start melts; the time it takes grows with it, so that a short gap in the
// tracking costs milliseconds and a long way is not leapt.
Vec3 EyeEase::follow(const Vec3& tracked_eye_in_wall, Time now) {
  const double within_s = 1.5 * start_.norm() / options_.catch_up_m_s;
  const double passed_s = seconds(now - since_);
  if (passed_s >= within_s) return tracked_eye_in_wall;
  return tracked_eye_in_wall + (1 - smooth_step(passed_s / within_s)) * start_;
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
