#include "app/touch_eye.h"

#include <cmath>

namespace vindu::app {
namespace {

constexpr Duration kStill = std::chrono::seconds(2);
/// Touch systems report whole pixels, some thirty times a second: the eye is led there, with two
/// thirds of the way in this time.
constexpr double kGlide_s = 0.1;

}  // namespace

void TouchEye::hear(Time now) {
  for (const EventMessage& event : bus_.take<EventMessage>())
    if (event.kind == EventKind::touch) hear(event, now);
}

void TouchEye::hear(const EventMessage& touch, Time now) {
  const Hand hand{touch.source, touch.id, now};
  const bool is_followed = followed_ == hand;
  if (touch.phase == EventPhase::end) {
    if (is_followed) followed_.reset();
    return;
  }
  if (followed_ && !is_followed && now - followed_->heard < kStill) return;
  const auto point = point_of_picture(site_.wall, {touch.x_px, touch.y_px});
  if (!point) return;
  followed_ = hand;
  target_in_wall_ =
      point->in_wall + site_.touch.eye_distance_m * point->tile->corners.normal_in_wall();
}

EyeNow TouchEye::at(Time now, Time) {
  hear(now);
  if (!eye_in_wall_) eye_in_wall_ = target_in_wall_;
  const double passed_s = moved_ == Time{} ? 0 : seconds(now - moved_);
  moved_ = now;
  *eye_in_wall_ += (1 - std::exp(-passed_s / kGlide_s)) * (target_in_wall_ - *eye_in_wall_);
  return {.eye_in_wall = *eye_in_wall_, .mode = Mode::touch};
}

}  // namespace vindu::app
