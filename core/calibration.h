// What a calibration found, in files of its own beside the wall file: calibration/cameras.toml and
// calibration/heads.toml. Reading a site lays them over what the wall file says; only the calibrate
// commands write them, each time keeping the version before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/site.h"

namespace vindu {

/// What is empty was not calibrated: the wall file's value holds.
struct CameraCalibration {
  std::string camera;  ///< its name in the wall file
  std::optional<Intrinsics> intrinsics;
  std::optional<Rigid3> room_from_camera;
  std::optional<double> lag_ms;
  std::optional<std::vector<Vec2>> masks_px{};
  CalibrationNote note;
};

struct HeadCalibration {
  HeadConfig head;
  CalibrationNote note;
};

/// "FOLDER/calibration" of "FOLDER/wall.toml".
std::string calibration_folder(const std::string& wall_file);

/// Writes what was found of these cameras beside the wall file and returns the file's name. What
/// the file says of other cameras, and of these where a new value is empty, stays; the whole
/// version before is kept as cameras.previous.toml. Throws Error where that is not possible.
std::string write_calibration(const std::string& wall_file,
                              const std::vector<CameraCalibration>& cameras);
/// The same of one head: heads.toml.
std::string write_calibration(const std::string& wall_file, const HeadCalibration& head);

/// The wall file's text with that of its calibration, to be read by parse_site: what a recording
/// holds. Throws Error where the wall file cannot be read.
std::string site_text(const std::string& wall_file);

}  // namespace vindu
