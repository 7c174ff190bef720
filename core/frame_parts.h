// Motion to photon as a sum of named parts, measured for every frame: from the light that a camera
// saw to the light that leaves the wall.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/clock.h"

namespace vindu {

/// In the order in which a frame goes through them.
enum class Part {
  capture_age,  ///< from the capture of what the eye rests on to the master's tick
  solve,        ///< reading the cameras and finding the eye
  publish,      ///< until the tile has heard of the frame
  pickup,       ///< until it begins to draw: it was busy with the frame before
  draw,
  barrier,  ///< until all tiles have drawn, and the master's word of it has come
  swap,     ///< the swap call
  display,  ///< from there to the light, as the wall file says
};
constexpr int kParts = 8;

constexpr std::string_view name_of(Part part) {
  constexpr std::string_view names[] = {"capture age", "solve",   "publish", "pick-up",
                                        "draw",        "barrier", "swap",    "display"};
  return names[static_cast<int>(part)];
}

/// How a frame began; the master's clock.
struct FrameOrigin {
  std::optional<Time> capture_time{};  ///< of what the eye rests on; empty: it is not tracked
  Time tick_time{};
  Time eye_time{};  ///< when the eye was known
};

/// What a tile spent on a frame, up to its swap.
struct TileParts {
  Duration pickup{}, draw{}, barrier{}, swap{};
  Duration sum() const { return pickup + draw + barrier + swap; }
  bool operator==(const TileParts&) const = default;
};

struct FrameParts {
  std::array<Duration, kParts> durations{};
  bool tracked = false;  ///< else there is no capture age, and the sum begins at the tick

  Duration& operator[](Part part) { return durations[static_cast<std::size_t>(part)]; }
  Duration operator[](Part part) const { return durations[static_cast<std::size_t>(part)]; }
  /// The sum of all parts.
  Duration motion_to_photon() const;
  bool operator==(const FrameParts&) const = default;
};

/// `shown`: when the swap was done, on the origin's clock. What neither end measured is `publish`,
/// so that the sum is exact; it is as uncertain as the clocks of two hosts.
FrameParts parts_of(const FrameOrigin& origin, const TileParts& tile, Time shown, Duration display);

}  // namespace vindu
