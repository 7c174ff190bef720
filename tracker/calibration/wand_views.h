// Finds a wand in the dots of each camera, and joins what several cameras saw at one time. Private
// to the wand calibration.
#pragma once

#include <span>
#include <vector>

#include "tracker/calibration/capture.h"

namespace vindu {

/// One camera's view of the wand, one entry for each LED along it.
struct WandView {
  int camera = 0;
  double t_s = 0;      ///< of capture; later by the camera's lag
  double sigma_s = 0;  ///< how uncertain that is
  std::vector<Vec2> dots_px;
  std::vector<Vec2> speed_px_s;  ///< slope through the pictures about this one
  std::vector<bool> used;        ///< false: an outlier

  /// Either end may be the first.
  void reverse();
};

/// What at least two cameras saw at one time.
struct WandMoment {
  double t_s = 0;
  std::vector<WandView> views;
  bool held_out = false;
  bool used = true;
};

/// Pictures that show the wand and nothing like it a second time: two dots, or three on a line.
std::vector<WandView> find_wand(const CameraTrack& track, int camera,
                                std::span<const double> leds_m);

/// At most `most` moments, evenly thinned, every tenth of them held out. `lag_s`: of each camera.
std::vector<WandMoment> join_views(const std::vector<std::vector<WandView>>& views,
                                   std::span<const double> lag_s, int most);

}  // namespace vindu
