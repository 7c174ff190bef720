// The line on the terminal while live cameras are calibrated: how far it is, and which of them are
// not there.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/cameras.h"
#include "tracker/calibration/capture.h"

namespace vindu::app {

struct Progress {
  std::function<std::string(const Capture& so_far)> of_all{};
  /// "" for one that does not matter. Without either: how many pictures each has sent.
  std::function<std::string(const Capture& so_far, std::size_t camera)> of_camera{};
};

/// "left: 88 % covered   right: not connected", by the states of all cameras of the site.
std::string progress_line(const Progress& progress, const Capture& so_far,
                          const std::vector<CameraState>& cameras);

}  // namespace vindu::app
