#include "core/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/internal/calibration_reader.h"
#include "core/new_file.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') out += '\\';
    if (static_cast<unsigned char>(letter) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(letter));
    else
      out += letter;
  }
  return out + "\"";
}

std::string text_of(const Vec3& point) {
  return fmt::format("[{}, {}, {}]", point.x(), point.y(), point.z());
}

std::string text_of(const CalibrationNote& note) {
  std::string text;
  for (const auto& [name, value] : {std::pair("method", note.method), std::pair("date", note.date),
                                    std::pair("recording", note.recording)})
    if (!value.empty()) text += fmt::format("{} = {}\n", name, quoted(value));
  for (const auto& [name, value] :
       {std::pair("rms_px", note.rms_px), std::pair("focal_sigma_px", note.focal_sigma_px),
        std::pair("position_sigma_mm", note.position_sigma_mm),
        std::pair("rotation_sigma_deg", note.rotation_sigma_deg)})
    if (value > 0) text += fmt::format("{} = {:.4g}\n", name, value);
  return text;
}

std::string text_of(const CameraCalibration& found) {
  std::string text = fmt::format("[[calibrated_camera]]\nname = {}\n", quoted(found.camera));
  if (const auto& lens = found.intrinsics)
    text +=
        fmt::format("focal_px = [{}, {}]\ncentre_px = [{}, {}]\ndistortion = [{}]\n", lens->fx_px,
                    lens->fy_px, lens->cx_px, lens->cy_px, fmt::join(lens->distortion, ", "));
  if (const auto& pose = found.room_from_camera) {
    const Quat& q = pose->rotation;
    text += fmt::format("position_m = {}\nrotation_xyzw = [{}, {}, {}, {}]\n",
                        text_of(pose->translation), q.x(), q.y(), q.z(), q.w());
  }
  if (const auto& masks = found.masks_px) {
    std::string points;
    for (const Vec2& mask : *masks)
      points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", mask.x(), mask.y());
    text += fmt::format("masks_px = [{}]\n", points);
  }
  if (found.lag_ms) text += fmt::format("lag_ms = {}\n", *found.lag_ms);
  return text + text_of(found.note);
}

std::string text_of(const HeadCalibration& found) {
  std::string leds;
  for (const Vec3& led : found.head.leds_in_head) leds += (leds.empty() ? "" : ", ") + text_of(led);
  return fmt::format("[[calibrated_head]]\nname = {}\nleds_m = [{}]\neye_m = {}\n{}",
                     quoted(found.head.name), leds, text_of(found.head.eye_in_head),
                     text_of(found.note));
}

std::string read_text(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error({"cannot be read", file, "give the path of a wall file"});
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What the file said before stands beside it afterwards.
std::string replace_file(const std::string& wall_file, const std::string& name,
                         const std::string& text) {
  const std::string folder = calibration_folder(wall_file);
  const std::string remedy = "make its folder writable, or copy the wall file";
  std::string file = folder + "/" + name + ".toml";
  std::error_code error;
  fs::create_directories(folder, error);
  NewFile fresh(file);
  fresh.write("# Written by vindu calibrate; it holds instead of what the wall file says.\n" + text,
              remedy);
  if (fs::exists(file))
    fs::copy_file(file, folder + "/" + name + ".previous.toml",
                  fs::copy_options::overwrite_existing, error);
  if (error) throw Error({"cannot be copied: " + error.message(), file, remedy});
  fresh.place(remedy);
  return file;
}

/// What a file holds already; nothing where there is none.
template <class Read>
auto read_before(const std::string& file, Read read) {
  const toml::table parsed = fs::exists(file) ? internal::parse_toml_file(file) : toml::table{};
  internal::Problems problems(file);
  internal::TomlTable root(parsed, "", problems);
  auto found = read(root);
  root.finish();
  problems.throw_if_any();
  return found;
}

void merge(const CameraCalibration& found, std::vector<CameraCalibration>& cameras) {
  const auto known = std::ranges::find(cameras, found.camera, &CameraCalibration::camera);
  if (known == cameras.end()) return cameras.push_back(found);
  if (found.intrinsics) known->intrinsics = found.intrinsics;
  if (found.room_from_camera) known->room_from_camera = found.room_from_camera;
  if (found.lag_ms) known->lag_ms = found.lag_ms;
  if (found.masks_px) known->masks_px = found.masks_px;
  const bool measured = found.intrinsics || found.room_from_camera || found.lag_ms;
  if (measured) known->note = found.note;
}

}  // namespace

std::string calibration_folder(const std::string& wall_file) {
  return (fs::path(wall_file).parent_path() / "calibration").string();
}

std::string write_calibration(const std::string& wall_file,
                              const std::vector<CameraCalibration>& cameras) {
  auto all = read_before(calibration_folder(wall_file) + "/cameras.toml",
                         internal::read_camera_calibrations);
  for (const CameraCalibration& camera : cameras) merge(camera, all);
  std::string text;
  for (const CameraCalibration& camera : all) text += "\n" + text_of(camera);
  return replace_file(wall_file, "cameras", text);
}

std::string write_calibration(const std::string& wall_file, const HeadCalibration& head) {
  auto all =
      read_before(calibration_folder(wall_file) + "/heads.toml", internal::read_head_calibrations);
  std::erase_if(all,
                [&](const HeadCalibration& other) { return other.head.name == head.head.name; });
  all.push_back(head);
  std::string text;
  for (const HeadCalibration& each : all) text += "\n" + text_of(each);
  return replace_file(wall_file, "heads", text);
}

std::string site_text(const std::string& wall_file) {
  std::string text = read_text(wall_file);
  for (const char* name : {"/cameras.toml", "/heads.toml"}) {
    const std::string file = calibration_folder(wall_file) + name;
    if (fs::exists(file)) text += "\n" + read_text(file);
  }
  return text;
}

}  // namespace vindu
