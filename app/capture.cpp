// vindu capture: one frame of a running wall as pictures: every tile, the joined wall, and what the
// viewer sees of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "app/captures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/runtime_folder.h"
#include "app/wall_console.h"
#include "cluster/console.h"
#include "cluster/dds.h"
#include "cluster/launch/host_plan.h"
#include "cluster/launch/hosts.h"
#include "cluster/launch/node_set.h"
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
      ask_wall(transport, this_console(site), {Verb::capture, ""}, from_seconds(command.timeout_s));
  expect_done(answer);
  const auto frame = captured_frame_from(answer.text);
  if (!frame)
    throw Error({"answered \"" + answer.text + "\", which names no frame", answer.from,
                 "install the same vindu on both (vindu deploy)"});
  return *frame;
}

/// Of those tiles that have none yet.
void read_pictures(const std::string& folder, const std::vector<std::string>& tiles,
                   const CapturedFrame& frame, Pictures& pictures) {
  for (const std::string& tile : tiles) {
    const std::string file = folder + "/" + capture_file(frame, tile);
    if (!pictures.contains(tile) && std::filesystem::exists(file)) pictures[tile] = read_png(file);
  }
}

/// A wall over hosts names its master's; a tile without a host of its own runs here.
bool is_elsewhere(const Tile& tile, const ClusterConfig& cluster) {
  const std::string own = host_name();
  return !cluster.master.empty() && own != tile.host && !own.starts_with(tile.host + ".");
}

/// What this machine's tiles have kept until then, or before the others have to be waited for.
Pictures collect(const CaptureCommand& command, const Site& site, const CapturedFrame& frame) {
  const std::string folder = runtime_folder(site.cluster);
  const Time end = std::chrono::steady_clock::now() + from_seconds(command.timeout_s);
  Pictures pictures;
  const auto has_come = [&](const std::string& tile) {
    return pictures.contains(tile) || is_elsewhere(*site.wall.find(tile), site.cluster);
  };
  for (;;) {
    read_pictures(folder, command.tiles, frame, pictures);
    if (std::ranges::all_of(command.tiles, has_come) || std::chrono::steady_clock::now() > end)
      return pictures;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// The hosts whose tiles are missing, with these tiles alone.
std::vector<HostPlan> hosts_of_missing(const CaptureCommand& command, const Site& site,
                                       const Pictures& pictures) {
  std::vector<HostPlan> plans = host_plans(site);
  for (HostPlan& plan : plans)
    std::erase_if(plan.tiles, [&](const std::string& tile) {
      return pictures.contains(tile) ||
             std::ranges::find(command.tiles, tile) == command.tiles.end();
    });
  std::erase_if(plans, [](const HostPlan& plan) { return plan.tiles.empty(); });
  return plans;
}

/// Brings what the hosts of the other tiles keep, over ssh.
void fetch(const CaptureCommand& command, const Site& site, const CapturedFrame& frame,
           Pictures& pictures) {
  const std::vector<HostPlan> plans = hosts_of_missing(command, site, pictures);
  if (plans.empty()) return;
  const int patience_s = static_cast<int>(std::ceil(command.timeout_s));
  const std::vector<HostReport> found = on_hosts(
      names_of(plans),
      kept_script(plans, runtime_folder_name(site.cluster), capture_prefix(frame), patience_s));
  std::vector<HostPaths> wanted;
  for (const HostReport& report : found)
    if (!report.failure && !report.lines.empty()) wanted.push_back({report.host, report.lines});
  const TemporaryFolder folder;
  const std::vector<HostReport> copied = copy_from_hosts(wanted, folder.path());
  for (const auto* reports : {&found, &copied}) std::fputs(failures_of(*reports).c_str(), stderr);
  read_pictures(folder.path(), command.tiles, frame, pictures);
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
  save_picture(whole, command.out + "/wall.png");
  if (command.wall_picture) return;
  const auto surface = make_headless_surface({.device = command.device});
  WallRenderer wall(site.wall, scale, Look{});
  wall.picture().write(whole);
  save_picture(picture_from_eye(wall, frame.eye_in_wall, kEyePicture), command.out + "/eye.png");
}

void check_tiles(const CaptureCommand& command, const Wall& wall) {
  for (const std::string& tile : command.tiles)
    if (!wall.find(tile))
      throw Error({"there is no tile \"" + tile + "\"", "--tile",
                   "this wall has " + wall.tiles.front().name + " to " + wall.tiles.back().name});
}

/// Says which tiles' pictures are missing, and why that may be.
bool all_came(const CaptureCommand& command, const Site& site, const CapturedFrame& frame,
              const Pictures& pictures) {
  std::vector<std::string> missing;
  for (const std::string& tile : command.tiles)
    if (!pictures.contains(tile)) missing.push_back(tile);
  if (missing.empty()) return true;
  log_warning(fold_names(missing),
              fmt::format("no picture of frame {}: do they run (vindu status)? This machine's "
                          "were looked for in {}: where the wall was started by another user, or "
                          "with another XDG_RUNTIME_DIR, call this so too",
                          frame.number, runtime_folder(site.cluster)));
  return false;
}

int capture(CaptureCommand command) {
  const Site site = load_site(command.wall_file);
  check_tiles(command, site.wall);
  const bool whole = command.tiles.empty();
  if (whole) command.tiles = tile_names(site.wall);
  const CapturedFrame frame = ask_for_frame(command, site);
  Pictures pictures = collect(command, site, frame);
  if (!site.cluster.master.empty()) fetch(command, site, frame, pictures);
  make_folder(command.out);
  if (!command.wall_picture)
    for (const auto& [tile, picture] : pictures)
      save_picture(picture, command.out + "/" + tile + ".png");
  if (whole && !pictures.empty()) save_wall(command, site, frame, pictures);
  return all_came(command, site, frame, pictures) ? 0 : 1;
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
      "(what the viewer sees), all of one frame. What other hosts' tiles keep comes over ssh, by\n"
      "clush and rsync, where the wall file names a [cluster] master.\n"
      "\nExamples:\n"
      "  vindu capture --wall wall.toml --out pictures\n"
      "  vindu capture --tile tile-3-1\n");
  app->callback([command, &chosen] { chosen = [command] { return capture(*command); }; });
}

}  // namespace vindu::app
