#include "app/calibrate_progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace vindu::app {
namespace {

std::string pictures_of(const Capture& so_far, std::size_t camera) {
  return fmt::format(
      "{} pictures",
      std::ranges::count(so_far.observations, static_cast<int>(camera), &Observation::camera));
}

std::string text_of(const Progress& progress, const Capture& so_far, std::size_t camera) {
  if (progress.of_camera) return progress.of_camera(so_far, camera);
  return progress.of_all ? "" : pictures_of(so_far, camera);
}

}  // namespace

std::string progress_line(const Progress& progress, const Capture& so_far,
                          const std::vector<CameraState>& cameras) {
  std::string line = progress.of_all ? progress.of_all(so_far) : "";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string text = cameras[i].connected ? text_of(progress, so_far, i) : "not connected";
    if (text.empty()) continue;
    line += fmt::format("{}{}: {}", line.empty() ? "" : "   ", cameras[i].name, text);
  }
  return line;
}

}  // namespace vindu::app
