// By how much cameras contradict each other: what their poses and lenses are off by, which no dot's
// own noise explains. Without it a quarter of a degree between two cameras would be the end of all
// tracking: their dots would fit no pose of the head. Nothing is put right by it: dots count for
// less.
#pragma once

namespace vindu {

/// Of two cameras: of more, those that agree are right. Bound to one thread.
class Disagreement {
 public:
  /// What is to be added to the sigma of every dot, raw pixels; 0 where cameras agree.
  double sigma_px() const { return sigma_px_; }

  /// A head was found with that sigma.
  void found_with(double sigma_px);
  /// How far the dots of a tracked head stand aside, as the mean over some seconds; with each
  /// report.
  void note_aside(double largest_px);

 private:
  double sigma_px_ = 0;
};

/// Looks for one head that have failed, and what the next one should therefore allow for.
class FailedLooks {
 public:
  /// One failed. `dots_enough`: that the head should have been found.
  void add(bool dots_enough);
  void forget() { *this = {}; }

  /// A sigma of dots for the next look; 0 at first and now and then, more where looks have failed
  /// for long though there were dots enough.
  double tried_px() const;
  /// Whether they have failed for seconds, whatever they allowed for.
  bool baffled() const;

 private:
  int failed_ = 0;    // though there were dots enough, less those where there were not
  int attempts_ = 0;  // of those, since failed_ was 0
};

}  // namespace vindu
