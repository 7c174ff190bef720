#include "app/frame_loop.h"

#include <cmath>

namespace vindu::app {
namespace {

/// Exponential mean of what it takes from tick to light, over some ten frames.
class PhotonDelay {
 public:
  explicit PhotonDelay(Duration first) : mean_s_(seconds(first)) {}
  Duration expected() const { return from_seconds(mean_s_); }
  void add(Duration measured) { mean_s_ += 0.1 * (seconds(measured) - mean_s_); }

 private:
  double mean_s_;
};

}  // namespace

LoopResult run_frames(const LoopOptions& options, Clock& clock, EyeSource& eyes,
                      const FrameSteps& steps) {
  LoopResult result;
  const Time start = clock.now();
  PhotonDelay delay(from_seconds(1 / options.rate_hz));
  const auto show = [&](FrameRecord record, const FrameOrigin& origin) {
    const Time drawing = clock.now();
    record.black_tiles = steps.draw(record.state);
    const Time drawn = clock.now();
    const bool go_on = steps.present(record);
    const Time shown = clock.now();
    record.parts = parts_of(origin, {.draw = drawn - drawing, .swap = shown - drawn}, shown,
                            options.display_latency);
    delay.add(shown - record.tick);
    if (steps.shown) steps.shown(record);
    result.frames.push_back(std::move(record));
    return go_on;
  };
  for (std::int64_t tick = 1;;) {
    clock.sleep_until(start + from_seconds(static_cast<double>(tick) / options.rate_hz));
    const Time now = clock.now();
    if (options.length && now - start > *options.length) break;
    const Time photon = now + delay.expected() + options.display_latency;
    const EyeNow eye = eyes.at(now, photon);
    const FrameRecord record{.state = {.number = result.frames.size() + 1,
                                       .photon_time = photon,
                                       .eye_in_wall = eye.eye_in_wall,
                                       .navigation = options.navigation,
                                       .animation_time_s = seconds(now - start),
                                       .clip = options.clip,
                                       .mode = eye.mode,
                                       .pattern = options.pattern},
                             .pose = eye.pose,
                             .shows_the_tracked_eye = eye.tracked,
                             .tick = now};
    const FrameOrigin origin = origin_of(eye, now, clock.now());
    const bool due = !steps.due || steps.due(record.state);
    if (!due) ++result.ticks_at_rest;
    if (!(due ? show(record, origin) : steps.rest())) break;
    const auto next =
        static_cast<std::int64_t>(seconds(clock.now() - start) * options.rate_hz + 1e-6) + 1;
    result.ticks_missed += static_cast<std::uint64_t>(std::max<std::int64_t>(next - tick - 1, 0));
    tick = std::max(next, tick + 1);
  }
  result.length = clock.now() - start;
  return result;
}

}  // namespace vindu::app
