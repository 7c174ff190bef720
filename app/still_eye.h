// The eye of who stands still: what tracks it trembles, and every tremble would be a new picture.
#pragma once

#include <span>

#include "app/eye_source.h"
#include "tracker/eye_rest.h"

namespace vindu::app {

/// Bound to one thread.
class StillEye {
 public:
  /// The site must outlive it.
  explicit StillEye(const Site& site) : site_(site) {}

  /// The eye to show. `corners_in_wall`: of what is shown. Times must not go back.
  Vec3 at(const EyeNow& eye, std::span<const Vec3> corners_in_wall, Time now);

 private:
  const Site& site_;
  EyeRest rest_;
};

}  // namespace vindu::app
