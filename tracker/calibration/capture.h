// What a calibration works on: every observation of all cameras while something was waved or held
// before them, and which way is up, by the accelerometers of Wiimotes at rest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/observation.h"

namespace vindu {

struct Capture {
  std::vector<Observation> observations;  ///< of each camera in the order of its arrivals
  /// By camera: unit vector against gravity; empty without an accelerometer, or where it was moved.
  std::vector<std::optional<Vec3>> up_in_camera;
};

/// Direction against gravity by many readings of a Wiimote's accelerometer, in g (x left, y back, z
/// up); empty unless it was at rest: all within 0.15 g of their mean, which is 0.9 to 1.1 g long.
std::optional<Vec3> up_in_camera(const std::vector<Vec3>& readings_g);

/// All Wiimotes of a recording that vindu record wrote, by the names of the site's cameras. Throws
/// Error where it cannot be read or none of its devices is a camera of the site.
Capture read_capture(const std::string& recording, const Site& site);

/// The dots of one camera, in image pixels (OpenCV's), by the times at which they were captured.
struct CameraTrack {
  struct Picture {
    double t_s = 0;      ///< of capture; later by the camera's lag
    double sigma_s = 0;  ///< how uncertain that is
    std::vector<Vec2> dots_px;
  };
  std::vector<Picture> pictures;
};

/// One for each camera of the site, in the order of capture. When a Wiimote took what has arrived
/// in bursts is told by CaptureClock; a video camera's pictures are taken when they arrive. What
/// does not move, a lamp or a reflection, is left out: dots in a cell of 4 px that is lit in more
/// than 30 % of a camera's pictures.
std::vector<CameraTrack> moving_dots(const Capture& capture,
                                     const std::vector<CameraConfig>& cameras);

}  // namespace vindu
