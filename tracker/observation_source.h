// The seam "observation source": whatever delivers what cameras see. Wiimotes, infrared cameras and
// video files stand behind it; the tracker's caller drains them alike.
#pragma once

#include <optional>

#include "tracker/observation.h"

namespace vindu {

/// Bound to one thread.
class ObservationSource {
 public:
  virtual ~ObservationSource() = default;

  /// The next observation that arrives no later than `until`; call it until it is empty. Waits for
  /// it if need be, so `until = now` only drains what is there.
  virtual std::optional<Observation> next(Time until) = 0;

  /// Nothing will come, for now or for ever: unplugged, or a recording at its end.
  virtual bool gone() const = 0;
};

}  // namespace vindu
