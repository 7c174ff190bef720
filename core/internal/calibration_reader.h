// Lays calibrations over a site that was read from a wall file. Private to core.
#pragma once

#include "core/calibration.h"
#include "core/internal/toml_table.h"

namespace vindu::internal {

/// The tables [[calibrated_camera]] of a file.
std::vector<CameraCalibration> read_camera_calibrations(TomlTable& root);
/// The tables [[calibrated_head]].
std::vector<HeadCalibration> read_head_calibrations(TomlTable& root);

/// Of both kinds; what the site does not know is left out with a warning, what it does not want
/// without.
void apply_calibrations(TomlTable& root, Site& site);
/// The same of the files beside the wall file, where there are any.
void apply_calibration_files(const std::string& wall_file, Site& site);

}  // namespace vindu::internal
