#include "app/film.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/log.h"
#include "renderer/eye_picture.h"

namespace vindu::app {
namespace {

/// Where the frames go.
class Reel {
 public:
  explicit Reel(const FilmOptions& options) : options_(options) {}

  void add(const Image& image, int number) {
    if (options_.out != "-") {
      write_png(image, fmt::format("{}/frame-{:05}.png", options_.out, number));
      return;
    }
    if (number == 1)
      log_info("film", fmt::format("rgb24, {}x{}, {} frames a second", image.width_px,
                                   image.height_px, options_.rate_hz));
    bytes_.clear();
    for (const Rgba8& pixel : image.pixels)
      bytes_.insert(bytes_.end(), pixel.begin(), pixel.begin() + 3);
    if (std::fwrite(bytes_.data(), 1, bytes_.size(), stdout) != bytes_.size())
      throw Error({"cannot be written: its reader has gone", "the output stream", ""});
  }

 private:
  const FilmOptions& options_;
  std::vector<std::uint8_t> bytes_;
};

Image picture_of(WallRenderer& wall, const FrameState& state, const std::string& view) {
  const Tile* const tile = wall.wall().find(view);
  wall.draw(state, tile);
  if (tile) return wall.read_tile(static_cast<std::size_t>(tile - wall.wall().tiles.data()));
  if (view == "eye") return picture_from_eye(wall, state.eye_in_wall, kEyePicture);
  return wall.picture().read();
}

}  // namespace

void make_film(WallRenderer& wall, const CameraPath& path, const FrameState& first,
               const FilmOptions& options) {
  const int count = static_cast<int>(std::ceil(options.length_s * options.rate_hz - 1e-9));
  const bool terminal = isatty(STDERR_FILENO) == 1;
  Reel reel(options);
  for (int i = 0; i < count; ++i) {
    const double t_s = i / options.rate_hz;
    FrameState state = first;
    state.number = first.number + static_cast<std::uint64_t>(i);
    state.photon_time = first.photon_time + from_seconds(t_s);
    state.animation_time_s = first.animation_time_s + t_s;
    state.eye_in_wall = path.eye_at(t_s);
    reel.add(picture_of(wall, state, options.view), i + 1);
    if (terminal) fmt::print(stderr, "\rframe {} of {}", i + 1, count);
  }
  if (terminal) std::fputc('\n', stderr);
}

}  // namespace vindu::app
