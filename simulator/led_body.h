// What emulated cameras look at: LEDs that move together. The helmet on a walking person is one;
// a wand, a calibration rig or a single LED in somebody's hand are others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/clock.h"
#include "core/site.h"

namespace vindu {

/// Reentrant, as its functions are.
struct LedBody {
  std::vector<Vec3> leds_in_body;
  /// Of one LED, seen from there; 1: as a helmet's cluster, straight ahead at 1 m.
  std::function<double(std::size_t led, const Vec3& viewer_in_body)> brightness;
  std::function<Rigid3(Time)> room_from_body;
};

using BodyMotion = std::function<Rigid3(Time)>;

/// The helmet's clusters, with the head in their way.
LedBody helmet_body(const HeadConfig& head, BodyMotion room_from_head);

/// LEDs that shine alike in all directions, nothing in their way.
LedBody bare_leds(std::vector<Vec3> leds_in_body, BodyMotion room_from_body);

/// One bare LED that is held to each point for 2 s, then moved on in 1 s; from time zero.
LedBody touching(std::vector<Vec3> points_in_room);

struct WaveOptions {
  std::uint64_t seed = 1;
  Time start{};
  Rigid3 room_from_rest;            ///< the middle of all places and directions
  Vec3 reach_m = {0.6, 0.4, 0.6};   ///< to both sides, along the axes of room
  Vec3 turn_rad = {kPi, kPi, kPi};  ///< to both sides, about the axes of the body
  double tempo_hz = 0.07;           ///< of the slowest swing; speeds grow with it
};

/// Waved by hand, to and fro in all directions at unrelated rates; smooth.
BodyMotion waved(const WaveOptions& options);

}  // namespace vindu
