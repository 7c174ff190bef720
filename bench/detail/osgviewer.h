// OpenSceneGraph's viewer on the same model, as a yardstick: Debian's openscenegraph under Xvfb.
#pragma once

#include <optional>
#include <string>

#include "renderer/image.h"
#include "renderer/scene.h"

namespace vindu {

/// Binary PLY with normals and colours.
void write_ply(const Scene& scene, const std::string& file);

/// Seconds a frame in a window of that size: a run of many frames less a run of few, so that
/// loading does not count. Empty where xvfb-run or osgviewer is missing or fails.
std::optional<double> osgviewer_frame_s(const std::string& model, SizePx size, int frames);

/// Where osgviewer's camera stands at first, for a box from the model's middle with this half
/// diagonal: so far before it (on -y, z up), with this angle of view from bottom to top.
double osgviewer_distance(double half_diagonal);
double osgviewer_fov_y_rad();

}  // namespace vindu
