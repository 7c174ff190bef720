#include "core/frame_parts.h"

#include <numeric>

namespace vindu {

Duration FrameParts::motion_to_photon() const {
  return std::accumulate(durations.begin(), durations.end(), Duration{});
}

FrameParts parts_of(const FrameOrigin& origin, const TileParts& tile, Time shown,
                    Duration display) {
  FrameParts parts{.durations = {}, .tracked = origin.capture_time.has_value()};
  if (origin.capture_time) parts[Part::capture_age] = origin.tick_time - *origin.capture_time;
  parts[Part::solve] = origin.eye_time - origin.tick_time;
  parts[Part::publish] = shown - tile.sum() - origin.eye_time;
  parts[Part::pickup] = tile.pickup;
  parts[Part::draw] = tile.draw;
  parts[Part::barrier] = tile.barrier;
  parts[Part::swap] = tile.swap;
  parts[Part::display] = display;
  return parts;
}

}  // namespace vindu
