#include "tracker/joint/dot_sizes.h"

#include <algorithm>
#include <cmath>

namespace vindu {

// The largest is forgotten over seconds, as the head goes farther away.
void DotSizes::note(const Dot& dot, Time time) {
  constexpr double kFades_s = 5;
  if (noted_ != Time::min())
    largest_ *= std::exp(-std::max(0.0, seconds(time - noted_)) / kFades_s);
  largest_ = std::max(across(dot), largest_);
  noted_ = std::max(noted_, time);
}

bool DotSizes::too_large(const Dot& dot, Time time) const {
  constexpr Duration kKnown = std::chrono::seconds(2);
  // LEDs that turn towards the camera, or two that run into one dot, grow by less.
  constexpr double kLarger = 2, kAndBy = 3;
  if (noted_ == Time::min() || time - noted_ > kKnown) return false;
  return across(dot) > kLarger * largest_ + kAndBy;
}

/// A Wiimote's sizes go with the diameter; a video camera counts pixels.
double DotSizes::across(const Dot& dot) const {
  return source_ == CameraSource::video ? std::sqrt(dot.size) : dot.size;
}

}  // namespace vindu
