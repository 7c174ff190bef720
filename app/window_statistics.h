// The figures of one process that draws a whole wall or a screen, in the upper left of its window,
// switched by F1.
#pragma once

#include "app/frame_loop.h"
#include "app/statistics.h"
#include "renderer/gpu_timer.h"
#include "renderer/overlay.h"
#include "renderer/surface.h"

namespace vindu::app {

/// Bound to the render thread; made and destroyed while its context is current.
class WindowStatistics {
 public:
  /// The window must outlive it.
  WindowStatistics(Window& window, double rate_hz) : window_(window), statistics_(rate_hz) {}

  /// Around the draws of a frame.
  GpuTimer& timer() { return timer_; }
  void drew(const DrawCount& count, Duration draw);
  /// The frame was shown.
  void showed(const FrameRecord& record);

  /// Whether it is switched on, by all keys until now.
  bool on();
  /// Into the window, if it is switched on; after everything else.
  void draw_over(const SceneRenderer& renderer);

 private:
  Window& window_;
  FrameStatistics statistics_;
  GpuTimer timer_;
  DrawCount count_;
  OverlayPanel panel_;
  bool on_ = false;
};

}  // namespace vindu::app
