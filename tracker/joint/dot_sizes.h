// Lamps and windows are large where the LEDs of a head are small: a dot far larger than those of
// heads were lately is none, even where it is on the move.
#pragma once

#include "core/clock.h"
#include "core/site.h"
#include "tracker/observation.h"

namespace vindu {

/// Of one camera. Bound to one thread.
class DotSizes {
 public:
  explicit DotSizes(CameraSource source = CameraSource::emulated) : source_(source) {}

  /// A dot of a head. Times may go back.
  void note(const Dot& dot, Time time);
  /// Whether it is none. No, while no head's dots have been seen for two seconds.
  bool too_large(const Dot& dot, Time time) const;

 private:
  double across(const Dot& dot) const;

  CameraSource source_;
  double largest_ = 0;  // across, as it was when last noted
  Time noted_ = Time::min();
};

}  // namespace vindu
