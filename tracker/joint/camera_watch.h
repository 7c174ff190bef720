// Whether a camera still agrees with the others. One that was bumped keeps sending good dots in
// wrong places; it is named and trusted less, and never put right unasked.
#pragma once

#include <span>

#include "core/clock.h"
#include "tracker/joint/association.h"

namespace vindu {

/// Of one camera. Bound to one thread.
class CameraWatch {
 public:
  /// A report of it, taken in while a head is tracked.
  void count(const Association& association);
  /// The same, by the report's dots: for aside_px() and larger().
  void note_misfit(std::span<const MisfitDot> dots);
  /// Whether its dots fit what others see at the same time; some twenty times a second.
  void judge(bool fits);

  /// Its dots have not fitted what the others see for a second or more.
  bool moved() const { return moved_; }
  /// It may make a head doubtful, as it did not do so just now, time and again.
  bool may_widen() const { return !moved_ && widenings_ < 3; }
  /// Factor on the sigma of its dots.
  double distrust() const { return moved_ ? 6 : 1; }

  /// How far its dots stand from where all cameras together expect them: the mean over some
  /// seconds, raw pixels. Noise and motion cancel out of it.
  Vec2 aside_px() const { return aside_px_; }
  /// By which share its heads look larger than they should where all cameras together see them: the
  /// mean over some seconds.
  double larger() const { return larger_; }

  /// Whether moving dots would fit better, had they been captured at another time; that time is
  /// given less the one in use. Then both change places here as well.
  bool prefers_other_time(const Association& association, double other_less_used_s);

 private:
  Vec2 aside_px_ = Vec2::Zero();
  double larger_ = 0;
  double reports_ = 0;       // that these rest on
  double disagreement_ = 0;  // running mean over about a second; 0: all fits, 1: nothing
  bool moved_ = false;
  int widenings_ = 0;
  int fitting_ = 0;                      // reports in a row
  double used_px2_ = 0, other_px2_ = 0;  // running sums of residuals
  double weight_ = 0;
};

}  // namespace vindu
