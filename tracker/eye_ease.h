// The eye that the wall shows when tracking comes and goes: held where it was, after two seconds
// led to the default viewpoint, and led back to the tracked eye without a jump. Where the tracker
// corrects itself, the shown eye follows as softly.
#pragma once

#include <optional>

#include "core/clock.h"
#include "core/rigid3.h"

namespace vindu {

struct EyeEaseOptions {
  Duration held_for = std::chrono::seconds(2);
  Duration to_default_within = std::chrono::milliseconds(1500);  ///< longer where that is too fast
  double to_default_m_s = 1;
  double catch_up_m_s = 0.7;  ///< how fast the shown eye closes on a tracked one, beside its motion
  double most_m_s = 1.1;      ///< of both together; a tracked eye that is faster is not closed on
  /// A step that differs by more from what the step before lets expect was no motion of the eye:
  /// so much, and so much for each second of the step.
  double leap_m = 0.004;
  double leap_m_s = 0.15;
  double acceleration_m_s2 = 10;  ///< of people's heads, at most
};

/// Bound to one thread. Starts at the default eye.
class EyeEase {
 public:
  explicit EyeEase(const Vec3& default_eye_in_wall, const EyeEaseOptions& options = {});

  /// The eye to show at `now`, in wall; `tracked_eye_in_wall` is empty while tracking is lost.
  /// Times must not go back.
  Vec3 update(const std::optional<Vec3>& tracked_eye_in_wall, Time now);

 private:
  enum class Phase { lost, tracked };

  bool leapt(const Vec3& step, double dt_s);
  Vec3 left_after(double melted_s) const;
  void melt(double way_m, double dt_s);
  Vec3 hold_or_return(Time now);

  EyeEaseOptions options_;
  Vec3 default_eye_in_wall_;
  Vec3 shown_in_wall_;
  Phase phase_ = Phase::lost;
  Time since_{};         // lost: when that began
  Vec3 start_;           // lost: the eye that is held; tracked: shown minus tracked at its start
  double melted_s_ = 0;  // for so long has that been melting
  bool started_ = false;
  Vec3 tracked_in_wall_ = Vec3::Zero();  // the frame before
  Time updated_at_{};
  Vec3 velocity_m_s_ = Vec3::Zero();
};

}  // namespace vindu
