#include "core/internal/calibration_reader.h"

#include <algorithm>
#include <filesystem>

#include "core/internal/plausible.h"
#include "core/log.h"

namespace vindu::internal {
namespace {

CalibrationNote read_note(TomlTable& table) {
  CalibrationNote note;
  note.method = table.text("method").value_or("");
  note.date = table.text("date").value_or("");
  note.recording = table.text("recording").value_or("");
  note.rms_px = table.number("rms_px", {0, 1e6}).value_or(0);
  note.focal_sigma_px = table.number("focal_sigma_px", {0, 1e6}).value_or(0);
  note.position_sigma_mm = table.number("position_sigma_mm", {0, 1e6}).value_or(0);
  note.rotation_sigma_deg = table.number("rotation_sigma_deg", {0, 1e6}).value_or(0);
  return note;
}

std::optional<Intrinsics> read_intrinsics(TomlTable& table) {
  const auto focal = table.numbers("focal_px", 2, {10, 1e5});
  const auto centre = table.numbers("centre_px", 2, {-1e4, 1e4});
  const auto distortion = table.numbers("distortion", 5, {-10, 10});
  if (!focal && !centre && !distortion) return std::nullopt;
  if (!focal || !centre || !distortion) {
    table.fail("focal_px", "needs centre_px and distortion beside it, and they need it");
    return std::nullopt;
  }
  Intrinsics lens{(*focal)[0], (*focal)[1], (*centre)[0], (*centre)[1], {}};
  std::ranges::copy(*distortion, lens.distortion.begin());
  return lens;
}

std::optional<Rigid3> read_pose(TomlTable& table) {
  const auto position = table.vec3("position_m");
  const auto rotation = table.numbers("rotation_xyzw", 4, {-1.001, 1.001});
  if (!position && !rotation) return std::nullopt;
  if (!position || !rotation) {
    table.fail("position_m", "and rotation_xyzw stand together");
    return std::nullopt;
  }
  const Quat quaternion((*rotation)[3], (*rotation)[0], (*rotation)[1], (*rotation)[2]);
  if (std::abs(quaternion.norm() - 1) > 1e-3) {
    table.fail("rotation_xyzw", "is no rotation: its length is not 1; calibrate again");
    return std::nullopt;
  }
  return Rigid3{quaternion.normalized(), *position};
}

/// Which of the two holds would be a guess.
template <class Calibration, class Name>
void refuse_twice(TomlTable& table, const std::vector<Calibration>& before, const std::string& name,
                  Name name_of) {
  if (!name.empty() && std::ranges::find(before, name, name_of) != before.end())
    table.fail("name", "\"" + name +
                           "\" is calibrated twice; keep the newer table (see date), "
                           "and delete the other");
}

void apply(const CameraCalibration& found, CameraConfig& camera) {
  camera.intrinsics = found.intrinsics.value_or(camera.intrinsics);
  camera.room_from_camera = found.room_from_camera.value_or(camera.room_from_camera);
  camera.lag_ms = found.lag_ms.value_or(camera.lag_ms);
  camera.masks_px = found.masks_px.value_or(camera.masks_px);
  camera.calibration = found.note;
}

void apply_file(const std::string& file, Site& site) {
  if (!std::filesystem::exists(file)) return;
  const toml::table parsed = parse_toml_file(file);
  Problems problems(file);
  TomlTable root(parsed, "", problems);
  apply_calibrations(root, site);
  root.finish();
  problems.throw_if_any();
}

}  // namespace

std::vector<CameraCalibration> read_camera_calibrations(TomlTable& root) {
  std::vector<CameraCalibration> found;
  for (TomlTable& table : root.tables("calibrated_camera")) {
    table.require("name", "\"left\"");
    CameraCalibration camera;
    camera.camera = table.text("name").value_or("");
    camera.intrinsics = read_intrinsics(table);
    camera.room_from_camera = read_pose(table);
    camera.lag_ms = table.number("lag_ms", {-1000, 1000});
    camera.masks_px = table.vec2s("masks_px", 0, 64, {-1e4, 1e4});
    camera.note = read_note(table);
    refuse_twice(table, found, camera.camera, &CameraCalibration::camera);
    table.finish();
    found.push_back(std::move(camera));
  }
  return found;
}

std::vector<HeadCalibration> read_head_calibrations(TomlTable& root) {
  std::vector<HeadCalibration> found;
  for (TomlTable& table : root.tables("calibrated_head")) {
    table.require("leds_m", "[[-0.09, 0, -0.09], [0, 0, 0]]");
    HeadCalibration head;
    head.head.name = table.text("name").value_or(head.head.name);
    head.head.leds_in_head =
        table.vec3s("leds_m", 1, 16, {-10, 10}).value_or(head.head.leds_in_head);
    expect_a_helmet(table, head.head.leds_in_head);
    head.head.eye_in_head = table.vec3("eye_m", {-1, 1}).value_or(head.head.eye_in_head);
    head.note = read_note(table);
    refuse_twice(table, found, head.head.name,
                 [](const HeadCalibration& other) { return other.head.name; });
    table.finish();
    found.push_back(std::move(head));
  }
  return found;
}

void apply_calibrations(TomlTable& root, Site& site) {
  for (const CameraCalibration& found : read_camera_calibrations(root)) {
    const auto camera = std::ranges::find(site.cameras, found.camera, &CameraConfig::name);
    if (camera == site.cameras.end())
      log_warning("calibration", "camera \"" + found.camera +
                                     "\" was calibrated, but the wall file does not name it");
    else if (camera->use_calibration)
      apply(found, *camera);
  }
  for (const HeadCalibration& found : read_head_calibrations(root)) {
    const auto head = std::ranges::find(site.heads, found.head.name, &HeadConfig::name);
    if (head == site.heads.end()) {
      log_warning("calibration", "head \"" + found.head.name +
                                     "\" was calibrated, but the wall file does not name it");
    } else if (head->use_calibration) {
      head->leds_in_head = found.head.leds_in_head;
      head->eye_in_head = found.head.eye_in_head;
      head->calibration = found.note;
    }
  }
}

void apply_calibration_files(const std::string& wall_file, Site& site) {
  for (const char* name : {"/cameras.toml", "/heads.toml"})
    apply_file(calibration_folder(wall_file) + name, site);
}

}  // namespace vindu::internal
