// Calibrates single cameras by a rig of LEDs in a planar grid (thesis 3.3, 4.2.4): the lens from
// many views of a rig that is waved, the place from a rig that stands at a known place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracker/calibration/capture.h"
#include "tracker/calibration/wand.h"

namespace vindu {

/// Up to 4 x 4 LEDs. Frame rig: origin in its middle, +x right and +y up as one sees it who looks
/// at its LEDs, +z towards him.
struct Grid {
  int columns = 2;
  int rows = 2;
  double across_m = 0.09144;  ///< from LED to LED (the thesis' rig)
  double up_m = 0.09144;

  /// Row by row from the upper left, as the thesis numbers them (Fig. 4.8).
  std::vector<Vec3> leds_in_rig() const;
};

/// Which dot each LED is, by Fig. 4.8 of the thesis, but whichever way the camera is held: all
/// labellings that a plane can have are tried; of those that fit, the one whose upper edge lies
/// nearest to `up_in_image` is taken. Empty where the dots are no such grid.
std::optional<std::vector<std::size_t>> label_grid(const std::vector<Vec2>& dots_px,
                                                   const Grid& grid,
                                                   const Vec2& up_in_image = {0, -1});

struct LensResult {
  Intrinsics intrinsics;
  double focal_sigma_px = 0;
  Vec2 centre_sigma_px = Vec2::Zero();
  double k1_sigma = 0;
  double rms_px = 0;
  int views = 0;
  Coverage coverage;
};

struct LensOptions {
  int views = 30;  ///< the thesis' 30 every 0.5 s
  double interval_s = 0.5;
};

/// The priors are those of the wand calibration. Throws Error for too few views, or views too much
/// alike to tell the lens.
LensResult calibrate_lens(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          std::size_t camera, const Grid& grid, const LensOptions& options = {});

struct PlaceResult {
  Rigid3 room_from_camera;
  double rms_px = 0;
  double position_sigma_mm = 0;
  int pictures = 0;
  std::vector<Vec2> dots_px;  ///< image: the mean of each LED's, in the order of the grid
};

/// The rig stands still at `room_from_rig`; the camera's lens is known. Throws Error where the rig
/// is not seen or moves.
PlaceResult calibrate_place(const Capture& capture, const std::vector<CameraConfig>& cameras,
                            std::size_t camera, const Grid& grid, const Rigid3& room_from_rig);

}  // namespace vindu
