// vindu capture: one frame of a running wall as pictures: every tile, the joined wall, and what the
// viewer sees of it.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "app/captures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/wall_console.h"
#include "cluster/console.h"
#include "cluster/dds.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/eye_picture.h"
#include "renderer/surface.h"

namespace vindu::app {
namespace {

struct CaptureCommand {
  std::string wall_file;
  std::vector<std::string> tiles;
  std::string out = "out";
  double timeout_s = 5;
  bool wall_picture = false;
  std::optional<int> device;
};

using Pictures = std::map<std::string, Image>;  // by tile

CapturedFrame ask_for_frame(const CaptureCommand& command, const Site& site) {
  DdsTransport transport(network_of(site, Role::console));
  const AnswerMessage answer =
      ask_wall(transport, this_console(), {Verb::capture, ""}, from_seconds(command.timeout_s));
  expect_done(answer);
  const auto frame = captured_frame_from(answer.text);
  if (!frame)
    throw Error({"answered \"" + answer.text + "\", which names no frame", answer.from,
                 "install the same vindu on both (vindu deploy)"});
  return *frame;
}

/// What has come of the frame until then.
Pictures collect(const CaptureCommand& command, const Site& site, const CapturedFrame& frame) {
  const std::string folder = capture_folder(site.cluster) + "/";
  const Time end = std::chrono::steady_clock::now() + from_seconds(command.timeout_s);
  Pictures pictures;
  for (;;) {
    for (const std::string& tile : command.tiles) {
      const std::string file = folder + capture_file(frame, tile);
      if (!pictures.contains(tile) && std::filesystem::exists(file))
        pictures[tile] = read_png(file);
    }
    if (pictures.size() == command.tiles.size() || std::chrono::steady_clock::now() > end)
      return pictures;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void save(const Image& image, const std::string& file) {
  write_png(image, file);
  fmt::print("{}\n", file);
}

/// The scale of the largest picture: tiles may be drawn smaller than they are.
double scale_of(const Wall& wall, const Pictures& pictures) {
  double scale = 0;
  for (const auto& [tile, picture] : pictures)
    scale = std::max(scale, 1.0 * picture.width_px / wall.find(tile)->width_px);
  return scale;
}

/// Nearest pixels.
Image resized(const Image& image, SizePx size) {
  if (image.width_px == size.width && image.height_px == size.height) return image;
  Image result = Image::filled(size.width, size.height, {});
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      result.at(x, y) =
          image.at(x * image.width_px / size.width, y * image.height_px / size.height);
  return result;
}

/// Bezels, and tiles without a picture, are black.
Image joined(const Wall& wall, const WallLayout& layout, const Pictures& pictures) {
  Image whole = Image::filled(layout.size.width, layout.size.height, {0, 0, 0, 255});
  for (std::size_t i = 0; i < wall.tiles.size(); ++i) {
    const auto found = pictures.find(wall.tiles[i].name);
    if (found == pictures.end()) continue;
    const RectPx& place = layout.tiles[i];
    paste(resized(found->second, place.size), place.x,
          layout.size.height - place.y - place.size.height, whole);
  }
  return whole;
}

void save_wall(const CaptureCommand& command, const Site& site, const CapturedFrame& frame,
               const Pictures& pictures) {
  const double scale = scale_of(site.wall, pictures);
  const Image whole = joined(site.wall, layout_of(site.wall, scale), pictures);
  save(whole, command.out + "/wall.png");
  if (command.wall_picture) return;
  const auto surface = make_headless_surface({.device = command.device});
  WallRenderer wall(site.wall, scale, Look{});
  wall.picture().write(whole);
  save(picture_from_eye(wall, frame.eye_in_wall, kEyePicture), command.out + "/eye.png");
}

void check_tiles(const CaptureCommand& command, const Wall& wall) {
  for (const std::string& tile : command.tiles)
    if (!wall.find(tile))
      throw Error({"there is no tile \"" + tile + "\"", "--tile",
                   "this wall has " + wall.tiles.front().name + " to " + wall.tiles.back().name});
}

int capture(CaptureCommand command) {
  const Site site = load_site(command.wall_file);
  check_tiles(command, site.wall);
  const bool whole = command.tiles.empty();
  if (whole) command.tiles = tile_names(site.wall);
  const CapturedFrame frame = ask_for_frame(command, site);
  const Pictures pictures = collect(command, site, frame);
  make_folder(command.out);
  if (!command.wall_picture)
    for (const auto& [tile, picture] : pictures) save(picture, command.out + "/" + tile + ".png");
  if (whole && !pictures.empty()) save_wall(command, site, frame, pictures);
  for (const std::string& tile : command.tiles)
    if (!pictures.contains(tile))
      log_warning(tile, fmt::format("gave no picture of frame {}: does it run on this machine? "
                                    "(vindu status)",
                                    frame.number));
  return pictures.size() == command.tiles.size() ? 0 : 1;
}

}  // namespace

void add_capture(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<CaptureCommand>();
  CLI::App* app = parent.add_subcommand("capture", "One frame of a running wall as pictures");
  auto* tile = app->add_option("--tile", command->tiles, "Only these tiles")->type_name("tile-X-Y");
  app->add_flag("--wall-picture", command->wall_picture, "Only the joined wall")->excludes(tile);
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_option("--timeout", command->timeout_s, "Seconds to wait for the master and the tiles")
      ->check(between(0.1, 3600.0))
      ->capture_default_str();
  app->add_option("--device", command->device, "EGL device (GPU) that draws the eye's view");
  app->add_option("--out", command->out, "Folder for the pictures (default: out)")
      ->type_name("DIR");
  app->footer(
      "\nWrites tile-X-Y.png for each tile, wall.png (the whole wall as one picture) and eye.png\n"
      "(what the viewer sees), all of one frame. Tiles of this machine alone are found.\n"
      "\nExamples:\n"
      "  vindu capture --wall wall.toml --out pictures\n"
      "  vindu capture --tile tile-3-1\n");
  app->callback([command, &chosen] { chosen = [command] { return capture(*command); }; });
}

}  // namespace vindu::app
