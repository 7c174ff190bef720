// Other people's viewers on the same model, as yardsticks: Debian's OpenSceneGraph and ParaView,
// under Xvfb, drawn by the same CPU.
#pragma once

#include <optional>
#include <string>

#include "renderer/image.h"
#include "renderer/scene.h"

namespace vindu {

/// Binary PLY with normals and colours.
void write_ply(const Scene& scene, const std::string& file);

struct ViewerTimes {
  double frame_s = 0;
  double first_picture_s = 0;  ///< from the program's start; osgviewer's until its end
};

/// In a window of that size; a frame is a run of many less a run of few, so that loading does not
/// count. Empty where xvfb-run or osgviewer is missing or fails.
std::optional<ViewerTimes> osgviewer_times(const std::string& model, SizePx size, int frames);

/// ParaView's pvbatch from where osgviewer's camera stands; the median frame, and what it drew last
/// into `picture`. Empty where xvfb-run or pvbatch is missing or fails.
std::optional<ViewerTimes> pvbatch_times(const std::string& model, double half_diagonal,
                                         SizePx size, int frames, const std::string& picture);

/// Where osgviewer's camera stands at first, for a box from the model's middle with this half
/// diagonal: so far before it (on -y, z up), with this angle of view from bottom to top.
double osgviewer_distance(double half_diagonal);
double osgviewer_fov_y_rad();

}  // namespace vindu
