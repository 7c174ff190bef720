// Calibrates all cameras at once by a waved wand: poses, intrinsics and lags by bundle adjustment.
// A wand has two or three LEDs on a line; three at uneven spacing also tell a wrong length. The
// procedure is that of the wand calibrations of motion capture systems (EasyWand: Theriault et al.
// 2014, J. Exp. Biol. 217; anipose: Karashchuk et al. 2021) with the lags of Kalibr's (Furgale et
// al. 2013).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tracker/calibration/capture.h"

namespace vindu {

/// A picture's share of dots in 8 x 6 equal cells, row by row from the upper left.
struct Coverage {
  static constexpr int kColumns = 8, kRows = 6;
  std::array<int, std::size_t{kColumns} * kRows> dots{};

  void add(const Vec2& image_px, const Vec2& size_px);
  /// Share of the cells that have any.
  double share() const;
};

struct WandOptions {
  /// Along the wand, from its first LED on: {0, 0.5} or {0, 0.15, 0.5}; rising.
  std::vector<double> leds_m = {0, 0.15, 0.5};
  int max_poses = 1000;         ///< more are thinned out evenly
  bool trust_wall_file = true;  ///< refuse a size that contradicts the cameras' places in it
  std::uint64_t seed = 1;       ///< of the random samples
};

struct WandCamera {
  std::string name;
  Intrinsics intrinsics;
  Rigid3 room_from_camera;
  double lag_ms = 0;  ///< of the first camera: as it was
  // One sigma each, from the Jacobian, what the residuals scatter, and what parts of the capture
  // contradict each other by; against the first camera.
  double focal_sigma_px = 0;
  double aspect_sigma = 0;
  Vec2 centre_sigma_px = Vec2::Zero();
  double k1_sigma = 0;
  Vec3 position_sigma_mm = Vec3::Zero();  ///< along the axes of the first camera; zero for it
  double rotation_sigma_deg = 0;
  double lag_sigma_ms = 0;
  double rms_px = 0;       ///< of a coordinate
  double held_out_px = 0;  ///< the same of poses that were not used
  int views = 0;
  Coverage coverage;
};

struct WandResult {
  std::vector<WandCamera> cameras;
  int poses = 0;
  double outliers = 0;                 ///< share of the dots that were left out
  double length_rms_mm = 0;            ///< of the length between the outer LEDs, of held-out poses
  double length_mean_mm = 0;           ///< its mean error
  double predicted_length_rms_mm = 0;  ///< what the dots' noise alone makes of it
  bool level = false;                  ///< by gravity; else as the wall file has the first camera
  std::vector<std::string> remarks;
};

/// Priors: a Wiimote's (emulated, too) are those of its kind, f = 1335 +- 50 px, centre +- 20 px,
/// k1 = 0 +- 0.1; a video camera's are the wall file's. Room: the first camera stays where the wall
/// file has it, gravity levels, and the other cameras' places in the wall file turn it about the
/// vertical. Throws Error with what to do when the capture cannot carry a calibration: too few
/// poses, too little coverage, a camera that never sees the wand together with another, a wand of
/// other proportions or size, more than 30 % outliers.
WandResult calibrate_wand(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          const WandOptions& options);

}  // namespace vindu
