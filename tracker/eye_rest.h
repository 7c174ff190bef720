// The eye of a wall at which nobody moves: tracked eyes tremble by noise, and every tremble would
// be a new picture on every tile. While the eye stays where it is, so nearly that nobody sees the
// difference, the shown one does not change at all.
#pragma once

#include <deque>
#include <span>

#include "core/clock.h"
#include "core/pose.h"
#include "core/wall.h"

namespace vindu {

/// How far an eye may be from where it is taken to be, so that nothing on the wall is displaced by
/// more than half a pixel: neither what is farther behind the wall than anything, nor the scene's
/// corners before it. 0 where one of them is as near as the eye. Metres.
double eye_slack_m(const Wall& wall, const Vec3& eye_in_wall,
                   std::span<const Vec3> corners_in_wall);

/// Standard deviation of the eye along an axis, as the tracker knows it; 0: not known. Metres.
double eye_sigma_m(const PoseSample& pose, const Vec3& eye_in_head);

struct EyeRestOptions {
  Duration quiet_for = std::chrono::milliseconds(500);  ///< before the eye counts as still
  double quiet_share = 0.8;  ///< of what it may be off, that it keeps within meanwhile
  double noise_sigmas = 4;   ///< a tracked eye trembles so far without having moved
  Duration mean_over = std::chrono::seconds(2);            ///< a tracked eye that may drift
  Duration blend_within = std::chrono::milliseconds(150);  ///< into rest and out of it
};

/// Bound to one thread.
class EyeRest {
 public:
  explicit EyeRest(const EyeRestOptions& options = {}) : options_(options) {}

  /// The eye to show at `now`: never farther from the tracked one than its slack or, where that is
  /// more, its noise; and in rest never farther than the slack from the mean. Times must not go
  /// back.
  Vec3 update(const Vec3& eye_in_wall, double slack_m, double sigma_m, Time now);
  bool resting() const { return resting_; }

 private:
  struct Sample {
    Time time{};
    Vec3 eye_in_wall;
  };

  bool stays(const Vec3& eye_in_wall, double slack_m, double reach_m, Time now);
  bool quiet(double reach_m) const;
  Vec3 mean() const;

  EyeRestOptions options_;
  std::deque<Sample> last_;  // of quiet_for
  bool resting_ = false;
  Vec3 held_in_wall_ = Vec3::Zero(), mean_in_wall_ = Vec3::Zero();
  Vec3 shown_in_wall_ = Vec3::Zero();
  Vec3 offset_ = Vec3::Zero();  // of what was shown when rest began or ended
  Time turned_{};               // when that was
};

}  // namespace vindu
