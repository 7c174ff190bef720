// vindu status: what a running wall does, asked of nobody: heard on the bus, as every console may.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/stop_signals.h"
#include "app/wall_console.h"
#include "cluster/dds.h"
#include "cluster/wall_view.h"
#include "core/error.h"
#include "core/log.h"

namespace vindu::app {
namespace {

struct StatusCommand {
  std::string wall_file;
  bool json = false;
  bool watch = false;
  double timeout_s = 0;
};

/// Long enough for all to be found, and for a tile that hangs to be called silent.
constexpr auto kListen = std::chrono::milliseconds(1500);
constexpr auto kTurn = std::chrono::milliseconds(50);

std::string json_of(const Quantiles& ms) {
  return fmt::format(R"({{"p50": {:.4f}, "p99": {:.4f}, "max": {:.4f}}})", ms.p50, ms.p99, ms.max);
}

/// What the master measured of the wall or of a tile; parts by their names.
std::string json_of(const std::optional<ReportMessage>& report) {
  if (!report) return "null";
  const FrameSummary& frames = report->frames;
  std::string parts;
  for (int i = 0; i < kParts; ++i)
    parts += fmt::format("{}{}: {:.4f}", i > 0 ? ", " : "",
                         json_text(std::string(name_of(static_cast<Part>(i)))),
                         frames.mean_ms[static_cast<std::size_t>(i)]);
  return fmt::format(
      R"({{"frames": {}, "fps": {:.2f}, "tracked": {}, "level": {}, "parts_ms": {{{}}}, )"
      R"("motion_to_photon_ms": {}, "skew_ms": {}, "locked": {}, "evicted": {}, )"
      R"("restarted": {}, "event": {}}})",
      frames.frames, frames.frames_per_s, frames.tracked,
      json_text(std::string(name_of(report->level))), parts, json_of(frames.motion_to_photon_ms),
      json_of(frames.skew_ms), report->locked, report->evictions, report->restarts,
      json_text(report->event));
}

std::string json_of(const std::optional<TileNow::Twin>& twin) {
  if (!twin) return "null";
  return fmt::format(R"({{"host": {}, "process": {}}})", json_text(twin->host), twin->process);
}

std::string json_of(const TileNow& tile) {
  const StatusMessage& last = tile.last;
  return fmt::format(
      R"({{"tile": {}, "host": {}, "state": {}, "process": {}, "twin": {}, "frame": {}, )"
      R"("fps": {:.2f}, "late_frames": {}, )"
      R"("restarts": {}, "scene": {}, "renderer": {}, "version": {}, "error": {}, )"
      R"("draw_ms": {:.3f}, "gpu_ms": {:.3f}, "triangles": {}, "culled_share": {:.4f}, )"
      R"("memory_bytes": {:.0f}, "report": {}}})",
      json_text(tile.name), json_text(last.host), json_text(tile.state), last.process,
      json_of(tile.twin), last.presented, last.frames_per_s, last.late_frames, tile.restarts,
      last.scene_revision, json_text(last.renderer), json_text(last.version), json_text(last.error),
      last.draw.draw_ms, last.draw.gpu_ms, last.draw.triangles, last.draw.culled_share,
      last.draw.memory_bytes, json_of(tile.report));
}

/// One line.
std::string json_of(const WallNow& wall) {
  std::string tiles, trackers, complaints;
  for (const TileNow& tile : wall.tiles) tiles += (tiles.empty() ? "" : ", ") + json_of(tile);
  for (const std::string& name : wall.trackers)
    trackers += (trackers.empty() ? "" : ", ") + json_text(name);
  for (const std::string& line : wall.complaints)
    complaints += (complaints.empty() ? "" : ", ") + json_text(line);
  const std::string heard = wall.heard_tracker();
  return fmt::format(
      R"({{"good": {}, "complaints": [{}], "master": {}, "epoch": {}, "frame": {}, "fps": {:.2f}, )"
      R"("pattern": {}, "blank": {}, "touch_page": {}, "active_tiles": {}, "report": {}, )"
      R"("trackers": [{}], "heard_tracker": {}, "tiles": [{}]}})",
      wall.good(), complaints, wall.master ? json_text(wall.master->host) : "null", wall.epoch,
      wall.frame, wall.frames_per_s, json_text(std::string(name_of(wall.pattern))), wall.blank,
      wall.touch_page, wall.active_tiles, json_of(wall.report), trackers,
      heard.empty() ? "null" : json_text(heard), tiles);
}

void print(const StatusCommand& command, const WallNow& wall) {
  if (command.json) {
    fmt::print("{}\n", json_of(wall));
  } else {
    const bool rewrites = command.watch && isatty(STDOUT_FILENO) == 1;
    fmt::print("{}{}", rewrites ? "\x1b[H\x1b[J" : "", table_of(wall));
  }
  if (std::fflush(stdout) != 0)
    throw Error({"cannot be written", "the standard output", "is its disk full?"});
}

/// Where no frame and no tile is heard. A master may be known to be there: names are no secret.
void say_why_nobody(const WallNow& wall, const Site& site) {
  const auto heard = [](const TileNow& tile) { return !tile.missing(); };
  if (wall.frame > 0 || std::ranges::any_of(wall.tiles, heard)) return;
  log_info("status",
           site.cluster.keys.empty()
               ? "nobody is heard; a wall with keys is heard with them alone: "
                 "[cluster] keys in the wall file"
               : "nobody is heard who has a key of the same authority as " + site.cluster.keys);
}

int status(const StatusCommand& command) {
  const Site site = load_site(command.wall_file);
  const StopSignals signals;
  DdsTransport transport(network_of(site, Role::console));
  const Participant self = this_console(site);
  const auto bus = transport.join({self, {}, WallView::hears()});
  WallView view(tile_names(site.wall), self);
  const MonotonicClock clock;
  const Time patient_until = clock.now() + from_seconds(command.timeout_s);
  for (Time shown = clock.now(); !signals.came_within(Duration::zero());) {
    bus->wait(WallView::hears(), clock.now() + kTurn);
    view.poll(*bus, clock.now());
    if (clock.now() - shown < kListen) continue;
    if (!command.watch && clock.now() < patient_until && !view.now().good()) continue;
    print(command, view.now());
    if (!command.watch) say_why_nobody(view.now(), site);
    shown = clock.now();
    if (!command.watch) break;
  }
  return view.now().good() ? 0 : 1;
}

}  // namespace

void add_status(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<StatusCommand>();
  CLI::App* app =
      parent.add_subcommand("status", "What a running wall does, and what is missing of it");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_flag("--json", command->json, "A line of JSON, with every tile");
  app->add_flag("--watch", command->watch, "Again and again, until Ctrl-C");
  app->add_option(
         "--timeout", command->timeout_s,
         "Seconds to listen for until all is good (default: 1.5); many hosts with keys take\n"
         "longer to be found")
      ->check(between(0, 3600));
  app->footer(
      "\nExit code: 0 when there is a master and every tile is ready, else 1.\n"
      "\nExamples:\n"
      "  vindu status --wall wall.toml\n"
      "  vindu status --wall wall.toml --timeout 60      waits until all tiles are ready\n"
      "  vindu status --watch\n");
  app->callback([command, &chosen] { chosen = [command] { return status(*command); }; });
}

}  // namespace vindu::app
