// How long the GPU takes for what is drawn between two points, by its own clock, without waiting
// for it. Bound to the render thread.
#pragma once

#include <array>
#include <optional>

#include "core/clock.h"
#include "renderer/gl/handle.h"

namespace vindu {

class GpuTimer {
 public:
  GpuTimer();

  /// Around the draws of a frame; not nested. A frame is left out while all queries are under way.
  void begin();
  void end();

  /// The newest one that is known; empty before the first. A few frames late on a GPU.
  std::optional<Duration> newest();

 private:
  static constexpr std::size_t kQueries = 4;  // frames that a driver may be behind

  std::array<gl::Query, kQueries> queries_;
  std::size_t asked_ = 0, answered_ = 0;  // since the start
  bool running_ = false;
  std::optional<Duration> newest_;
};

}  // namespace vindu
