// Frames of a wall along a camera path, one after the other, as fast or as slow as drawing them
// takes: as numbered pictures, or as bytes for a program that makes a video of them.
#pragma once

#include <string>

#include "core/camera_path.h"
#include "core/frame_state.h"
#include "renderer/wall_renderer.h"

namespace vindu::app {

struct FilmOptions {
  double rate_hz = 30;
  double length_s = 0;
  std::string view = "wall";  ///< wall, eye, or a tile's name
  std::string out;  ///< a folder; "-": red, green, blue of each pixel on the output stream
};

/// Draws frame i at i / rate_hz of the path; `first` says all else of a frame, and its animation
/// time counts on from there. Throws Error where a picture cannot be written, or the reader of the
/// output stream has gone.
void make_film(WallRenderer& wall, const CameraPath& path, const FrameState& first,
               const FilmOptions& options);

}  // namespace vindu::app
