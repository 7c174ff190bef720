#include "app/captures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "app/runtime_folder.h"
#include "core/log.h"
#include "core/new_file.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKept = 4;  // pictures of a tile

/// By name a tile's pictures are in order of time.
void forget_old(const std::string& folder, const std::string& tile) {
  std::vector<fs::path> own;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().filename().string().ends_with("-" + tile + ".png"))
      own.push_back(entry.path());
  std::ranges::sort(own);
  for (std::size_t i = 0; i + kKept < own.size(); ++i) fs::remove(own[i], ignored);
}

void write(const std::string& folder, const std::string& file, const std::string& tile,
           const Image& picture) {
  NewFile fresh(folder + "/" + file);
  write_png(picture, fresh.beside());
  fresh.place("is XDG_RUNTIME_DIR still there, with space?");
  forget_old(folder, tile);
}

}  // namespace

std::string text_of(const CapturedFrame& frame) {
  const Vec3& eye = frame.eye_in_wall;
  return fmt::format("{} {} {} {} {}", frame.epoch, frame.number, eye.x(), eye.y(), eye.z());
}

std::optional<CapturedFrame> captured_frame_from(const std::string& text) {
  std::istringstream words(text);
  CapturedFrame frame;
  words >> frame.epoch >> frame.number >> frame.eye_in_wall.x() >> frame.eye_in_wall.y() >>
      frame.eye_in_wall.z();
  if (!words || frame.epoch == 0 || frame.number == 0 || !frame.eye_in_wall.allFinite())
    return std::nullopt;
  return frame;
}

std::string capture_prefix(const CapturedFrame& frame) {
  return fmt::format("{:020}-{:012}-", frame.epoch, frame.number);
}

std::string capture_file(const CapturedFrame& frame, const std::string& tile) {
  return capture_prefix(frame) + tile + ".png";
}

void CaptureWriter::keep(const ClusterConfig& cluster, const CapturedFrame& frame,
                         const std::string& tile, Image picture) {
  std::erase_if(writing_, [](const std::future<void>& writing) {
    return writing.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  writing_.push_back(std::async(std::launch::async, [=, picture = std::move(picture)] {
    try {
      write(runtime_folder(cluster), capture_file(frame, tile), tile, picture);
    } catch (const std::exception& error) {
      log_warning(tile, std::string("keeps no picture: ") + error.what());
    }
  }));
}

}  // namespace vindu::app
