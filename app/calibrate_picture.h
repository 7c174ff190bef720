// Pictures of a calibration: where in its view each camera has seen something.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.h"
#include "tracker/calibration/wand.h"

namespace vindu::app {

struct CoveragePanel {
  std::string title;
  Coverage coverage;
};

/// Panels of 8 x 6 cells beside each other: the lighter the more dots, with their count.
Image coverage_picture(const std::vector<CoveragePanel>& panels);

}  // namespace vindu::app
