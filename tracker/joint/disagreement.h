// By how much cameras contradict each other: what their poses and lenses are off by, which no dot's
// own noise explains. Without it a quarter of a degree between two cameras would be the end of all
// tracking: their dots would fit no pose of the head. Nothing is put right by it: dots count for
// less.
#pragma once

#include "core/clock.h"

namespace vindu {

/// Of two cameras: of more, those that agree are right. Bound to one thread.
class Disagreement {
 public:
  /// What is to be added to the sigma of every dot, raw pixels; 0 where cameras agree.
  double sigma_px() const { return sigma_px_; }
  /// For the next look for a head that is lost: the same, or more where looks have failed for long
  /// though there were dots enough.
  double sigma_of_look_px() const;

  /// Whether looks have failed for seconds, whatever they allowed for.
  bool nothing_fits() const;

  /// `dots_enough`: that a head should have been found.
  void look_failed(bool dots_enough);
  /// A head was found with that sigma.
  void look_succeeded(double sigma_px);
  /// How far the dots of a tracked head stand aside, as the mean over some seconds; with each
  /// report.
  void note_aside(double largest_px);

 private:
  double sigma_px_ = 0;
  int failed_ = 0;    // looks though there were dots enough, less those where there were not
  int attempts_ = 0;  // of those, since failed_ was 0
};

}  // namespace vindu
