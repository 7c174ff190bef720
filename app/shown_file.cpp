#include "app/shown_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "core/log.h"
#include "renderer/frame_counter.h"

namespace vindu::app {
namespace {

/// Of all pixels' red, green and blue, 0 to 255.
double mean_level(const Image& image) {
  std::uint64_t sum = 0;
  for (const Rgba8& pixel : image.pixels) sum += pixel[0] + pixel[1] + pixel[2];
  return static_cast<double>(sum) / (3.0 * static_cast<double>(image.pixels.size()));
}

std::string file_for(const std::string& path, const std::string& tile) {
  if (!path.ends_with('/') && !std::filesystem::is_directory(path)) return path;
  std::error_code unable;  // then the file is, too
  std::filesystem::create_directories(path, unable);
  for (int start = 1;; ++start)
    if (const auto file = std::filesystem::path(path) / fmt::format("{}-{}.csv", tile, start);
        !std::filesystem::exists(file))
      return file;
}

}  // namespace

ShownFile::ShownFile(const std::string& path, const std::string& tile) {
  if (path.empty()) return;
  file_ = file_for(path, tile);
  stream_.rdbuf()->pubsetbuf(nullptr, 0);  // each line at once: a tile may be killed
  stream_.open(file_);
  if (!stream_) throw Error({"cannot be written", file_, "choose another --shown"});
  write("", "time_ns,epoch,frame,tile,pixels,eye_x_m,locked,mean_level\n");
}

void ShownFile::add(Time time, const FrameMessage& frame, const std::string& tile,
                    const Image& picture) {
  const auto number = read_frame_counter(picture);
  write(tile,
        fmt::format("{},{},{},{},{},{},{},{:.4f}\n", time.time_since_epoch().count(), frame.epoch,
                    frame.newest.number, tile, number ? std::to_string(*number) : "",
                    frame.newest.eye_in_wall.x(), frame.active_tiles, mean_level(picture)));
}

void ShownFile::write(const std::string& tile, const std::string& line) {
  if (stream_.write(line.data(), static_cast<std::streamsize>(line.size()))) {
    size_ += line.size();
    if (lost_ > 0) log_info(tile, fmt::format("{}: written again, {} lines lost", file_, lost_));
    lost_ = 0;
    return;
  }
  if (lost_++ == 0) log_warning(tile, file_ + ": cannot be written; lines get lost");
  // What of the line got through goes away.
  std::error_code unable;
  std::filesystem::resize_file(file_, size_, unable);
  stream_.clear();
  stream_.seekp(static_cast<std::streamoff>(size_));
}

}  // namespace vindu::app
