// The master of a wall in one process: ticks at the wall's rate, asks for the eye once, draws all
// tiles, presents, and keeps account of every frame: motion to photon as a sum of named parts.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "app/eye_source.h"
#include "core/clock.h"
#include "core/frame_state.h"

namespace vindu::app {

struct FrameRecord {
  FrameState state;
  std::optional<PoseSample> pose;
  bool shows_the_tracked_eye = false;  ///< not held, and not on its way to it or from it
  Time tick{};
  FrameParts parts{};  ///< drawn and presented by this process: no barrier, no pick-up
  int black_tiles = 0;
};

struct LoopOptions {
  double rate_hz = 60;
  Duration display_latency{};
  std::optional<Duration> length;  ///< empty: until the surface is closed
  Navigation navigation;
  Pattern pattern = Pattern::none;
  int clip = 0;
};

struct LoopResult {
  std::vector<FrameRecord> frames;
  std::uint64_t ticks_missed = 0;   ///< ticks that passed while a frame was still being drawn
  std::uint64_t ticks_at_rest = 0;  ///< ticks with nothing new to draw
  Duration length{};
};

/// Draws the frame into the wall's picture; returns the number of black tiles.
using DrawFrame = std::function<int(const FrameState&)>;

/// Presents it; false ends the loop.
using PresentFrame = std::function<bool(const FrameRecord&)>;

/// What is to be known of a frame when it was presented.
using FrameShown = std::function<void(const FrameRecord&)>;

struct FrameSteps {
  DrawFrame draw;
  PresentFrame present;
  FrameShown shown{};
  /// False: the frame would look as the one that is shown, and is not drawn. Empty: always true.
  std::function<bool(const FrameState&)> due{};
  /// At each tick whose frame is not due; false ends the loop.
  std::function<bool()> rest{};
};

/// A tick that cannot be kept is skipped, never made up for. The frame's photon time is predicted
/// from the draw time of the frames before.
LoopResult run_frames(const LoopOptions& options, Clock& clock, EyeSource& eyes,
                      const FrameSteps& steps);

}  // namespace vindu::app
