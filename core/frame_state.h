// Everything that a tile needs to draw frame n, whole and idempotent: a tile that has just started
// needs the newest one and nothing else.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/clock.h"
#include "core/pattern.h"
#include "core/rigid3.h"
#include "core/touch_page.h"

namespace vindu {

enum class Mode { loop, touch, track };

constexpr std::string_view name_of(Mode mode) {
  constexpr std::string_view names[] = {"loop", "touch", "track"};
  return names[static_cast<int>(mode)];
}

/// Where the scene stands: wall_from_scene, with a uniform scale applied first.
struct Navigation {
  Rigid3 wall_from_scene;
  double scale = 1;
};

/// What is drawn over it, as bits.
enum Overlay : std::uint32_t {
  kStatistics = 1,   ///< of each tile in its own corner, and of the wall in one
  kKeepPicture = 2,  ///< nothing is drawn, but tiles keep this frame's picture (vindu capture)
};

struct FrameState {
  std::uint64_t number = 0;
  Time photon_time{};  ///< when its light is expected to leave the wall; the master's clock
  Vec3 eye_in_wall = Vec3(0, 0.10, 2.0);
  Navigation navigation{};
  double animation_time_s = 0;
  int clip = 0;  ///< which of the scene's animations plays; -1, and one that is not there: at rest
  Mode mode = Mode::track;
  std::uint32_t overlays = 0;
  Pattern pattern = Pattern::none;
  bool blank = false;                     ///< black, whatever else is said here
  std::optional<TouchPage> touch_page{};  ///< in place of model and pattern
};

/// Else the frame needs no scene.
inline bool shows_model(const FrameState& state) {
  return !state.blank && !state.touch_page &&
         (state.pattern == Pattern::none || state.pattern == Pattern::counter);
}

/// Whether the frame's number stands in its picture.
inline bool shows_number(const FrameState& state) {
  return !state.blank && !state.touch_page &&
         (state.pattern == Pattern::counter || state.pattern == Pattern::bar);
}

/// 64-bit FNV-1a over every field's bytes, little endian: two tiles with one hash draw the same
/// frame.
std::uint64_t hash_of(const FrameState& state);

/// Of what can be seen of it: where this is equal, and the scene is, the picture is the same and
/// need not be drawn again. Overlays, counters and bars show something else in every frame.
std::uint64_t content_hash_of(const FrameState& state);

}  // namespace vindu
