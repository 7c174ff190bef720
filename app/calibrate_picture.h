// Pictures of a calibration: where in its view each camera has seen something.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.h"
#include "tracker/calibration/wand.h"

namespace vindu::app {

/// A place in a camera's picture: a disc in a ring, and its name beside it.
struct PictureMark {
  Vec2 image_px;
  double radius_px = 0;  ///< of the disc
  std::string name;
};

/// Of one camera.
struct CoveragePanel {
  std::string title;
  Vec2 size_px = {1024, 768};  ///< of its picture
  Coverage coverage{};
  std::vector<PictureMark> marks{};
};

/// Titled with the share of the picture that is covered.
CoveragePanel covered_panel(const std::string& camera, const Coverage& coverage);

/// Panels of 8 x 6 cells beside each other: the lighter the more dots, with their count; marks.
Image coverage_picture(const std::vector<CoveragePanel>& panels);

}  // namespace vindu::app
