// vindu tile: a tile of the wall, or several of one host. It hears frames from the master, draws
// its part of each, and shows it when all tiles have theirs.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <random>

#include "app/background.h"
#include "app/captures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/service.h"
#include "app/shown_file.h"
#include "app/stop_signals.h"
#include "app/tile_statistics.h"
#include "app/wall_console.h"
#include "cluster/dds.h"
#include "cluster/wall_tile.h"
#include "core/error.h"
#include "core/log.h"
#include "core/sha256.h"
#include "renderer/gpu_timer.h"
#include "renderer/notice.h"
#include "renderer/resources.h"
#include "renderer/scene_preparation.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"

namespace vindu::app {
namespace {

struct TileCommand {
  std::vector<std::string> tiles;
  std::string wall_file;
  std::string shown_file;
  std::optional<double> scale;
  std::optional<int> device;
  std::optional<double> refresh_hz;
  double refresh_phase = 0;
  bool headless = false;
};

std::uint64_t random_id() {
  std::random_device device;
  return std::uint64_t{device()} << 32 | device() | 1;
}

/// The wall with these tiles alone. Throws Error for a name that it lacks.
Wall part_of(const Wall& wall, const std::vector<std::string>& names) {
  Wall part = wall;
  part.tiles.clear();
  for (const std::string& name : names) {
    const auto tile = std::ranges::find(wall.tiles, name, &Tile::name);
    if (tile == wall.tiles.end())
      throw Error({"is no tile of the wall", name,
                   fmt::format("name one of {} to {}, or start it on a host of that name",
                               wall.tiles.front().name, wall.tiles.back().name)});
    part.tiles.push_back(*tile);
  }
  return part;
}

/// A scene that is read beside the frames that go on.
class Loading {
 public:
  void start(const SceneMessage& scene) {
    revision_ = scene.revision;
    reading_.start([scene](const std::stop_token& stop) {
      const std::string file = model_file(scene.path);
      if (!scene.sha256.empty() && sha256_of_file(file).value_or(scene.sha256) != scene.sha256)
        throw Error({"is not what the master has there", file,
                     "bring its file to all hosts: vindu deploy"});
      return read_model(file, stop);
    });
  }
  bool done() const { return reading_.done(); }
  bool running() const { return reading_.running(); }
  std::uint64_t revision() const { return revision_; }
  /// Throws what loading threw.
  PackedScene take() { return reading_.take(); }

 private:
  std::uint64_t revision_ = 0;
  Background<PackedScene> reading_;
};

/// On CPUs without shadows: each process would draw the whole scene anew for its own map.
Look tile_look() {
  Look look = live_look();
  if (draws_in_software()) look.shadows = Shadows::none;
  return look;
}

/// The pictures of this process' tiles, and what they show when there is no scene.
class TilePainter {
 public:
  TilePainter(const Site& site, const Wall& part, double scale, Surface& surface)
      : part_(part),
        surface_(surface),
        renderer_(part, scale, tile_look(), site.wall),
        statistics_(site, part) {
    if (const auto* const window = dynamic_cast<const Window*>(&surface))
      monitors_ = window->monitor_places();
  }

  WallRenderer& renderer() { return renderer_; }
  TileStatistics& statistics() { return statistics_; }

  void note(const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < part_.tiles.size(); ++i) {
      const RectPx& place = renderer_.layout().tiles[i];
      renderer_.picture().write(draw_notice({part_.tiles[i].name, lines}, place.size), place.x,
                                place.y);
    }
  }

  /// `words` stand where the frame wants a scene and there is none to show.
  void draw(const FrameState& state, const std::vector<std::string>& words) {
    const Time began = std::chrono::steady_clock::now();
    WallFrame frame;
    if (words.empty() || !shows_model(state)) {
      timer_.begin();
      frame = renderer_.draw(state);
      timer_.end();
    } else {
      note(words);
    }
    if (state.overlays & kStatistics && !state.blank) statistics_.draw_over(renderer_);
    renderer_.draw_numbers(state);
    renderer_.finish();
    statistics_.drew(frame, std::chrono::steady_clock::now() - began, timer_.newest());
  }

  void present() {
    if (const SizePx size = surface_.size(); size.width > 0 && size.height > 0) {
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      if (monitors_.size() == part_.tiles.size())
        present_on_monitors();
      else
        present_together(size);
    }
    surface_.present();
  }

 private:
  void present_on_monitors() {
    if (monitors_.size() > 1) glClear(GL_COLOR_BUFFER_BIT);  // monitors need not fill their window
    for (std::size_t i = 0; i < monitors_.size(); ++i) {
      const auto& [x, y, size] = monitors_[i];
      glViewport(x, y, size.width, size.height);
      renderer_.renderer().present(renderer_.picture(), part_.tiles[i].mount,
                                   renderer_.layout().tiles[i]);
    }
  }
  /// As they hang beside each other, in a window.
  void present_together(SizePx size) {
    glViewport(0, 0, size.width, size.height);
    const bool one = part_.tiles.size() == 1;
    renderer_.renderer().present(renderer_.picture(),
                                 one ? part_.tiles.front().mount : TileMount{});
  }

  Wall part_;
  Surface& surface_;
  std::vector<RectPx> monitors_;  // of the tiles, in framebuffer 0; empty where it has none
  WallRenderer renderer_;
  GpuTimer timer_;
  TileStatistics statistics_;
};

/// The monitors that the tiles of this process are to cover; empty where none is named. Throws
/// Error where only some are, or two share one.
std::vector<std::string> monitors_of(const Wall& part) {
  std::vector<std::string> monitors;
  for (const Tile& tile : part.tiles) {
    if (tile.monitor.empty()) continue;
    if (std::ranges::find(monitors, tile.monitor) != monitors.end())
      throw Error({"shares the monitor " + tile.monitor + " with another tile", tile.name,
                   "give each tile of a host a monitor of its own in its [[tile]]"});
    monitors.push_back(tile.monitor);
  }
  const auto without = std::ranges::find(part.tiles, std::string(), &Tile::monitor);
  if (!monitors.empty() && without != part.tiles.end())
    throw Error({"names no monitor, but other tiles of this process do", without->name,
                 "give each tile of a host a monitor in its [[tile]]"});
  return monitors;
}

std::unique_ptr<Surface> surface_for(const TileCommand& command, const Wall& part) {
  if (command.headless || !has_display()) {
    HeadlessOptions options{.device = command.device};
    if (command.refresh_hz) options.refresh = {*command.refresh_hz, command.refresh_phase};
    return make_headless_surface(options);
  }
  const WallLayout layout = layout_of(part, command.scale.value_or(1));
  return make_window({.size = layout.size,
                      .title = part.tiles.front().name,
                      .fullscreen = part.tiles.size() == 1 && !command.scale,
                      .monitors = command.scale ? std::vector<std::string>{} : monitors_of(part)});
}

/// What a step of bringing a scene to the GPU may take.
constexpr Duration kStep = std::chrono::milliseconds(3);

class TileRun {
 public:
  TileRun(const TileCommand& command, const Site& site)
      : site_(site),
        part_(part_of(site.wall, command.tiles)),
        transport_(network_of(site, Role::tile, command.tiles.front())),
        bus_(transport_.join({this_participant(Role::tile, command.tiles.front(), site),
                              WallTile::publishes(), hears(site, part_)})),
        tile_(*bus_,
              {.host = host_name(),
               .incarnation = random_id(),
               .version = VINDU_VERSION,
               .process = static_cast<std::uint32_t>(getpid())},
              command.tiles),
        shown_(command.shown_file, command.tiles.front()) {
    tile_.poll(clock_.now());  // "loading", before anything that takes its time
    surface_ = surface_for(command, part_);
    tile_.renders_with(gl_description());
    painter_.emplace(site_, part_, command.scale.value_or(1), *surface_);
    log_info(command.tiles.front(), gl_description());
    if (site.cluster.swap_group) join_group(command.tiles.front());
  }

  void run(const StopSignals& signals) {
    while (!signals.came_within(Duration::zero()) && !surface_->close_wanted()) {
      sign_of_life_.give(clock_.now());
      step();
    }
  }

 private:
  void join_group(const std::string& tile) {
    const SwapGroupState state = join_swap_group(surface_->swap_group());
    if (state.bound)
      log_info(tile, state.text);
    else
      log_warning(tile, state.text);
  }

  /// A scene that was read, on its way to the GPU.
  struct Coming {
    std::uint64_t revision = 0;
    ScenePreparation scene;
  };

  static Topics hears(const Site& site, const Wall& part) {
    Topics topics = WallTile::hears();
    if (TileStatistics::hears(site, part)) topics.add(Topic::report);
    return topics;
  }

  void step() {
    const Time now = clock_.now();
    tile_.poll(now);
    painter_->statistics().hear(*bus_);
    handle_scenes();
    switch (tile_.next(now, surface_->free())) {
      case WallTile::Next::show:
        return show();
      case WallTile::Next::draw:
        return draw(now);
      case WallTile::Next::wait:
        return wait(now);
    }
  }

  void wait(Time now) {
    if (tile_.alone(now)) notice(now);
    const Time wake = tile_.wake_time(now);
    if (coming_ && coming_->scene.free() && wake - now > kStep) return bring_to_gpu();
    // A display's refresh and a scene that is on its way wake nobody.
    const bool poll = !surface_->free() || loading_.running() || coming_;
    bus_->wait(WallTile::hears(), poll ? std::min(wake, now + std::chrono::milliseconds(1)) : wake);
  }

  void draw(Time now) {
    frame_ = *tile_.to_draw();
    const bool another_scene = prepared_ == frame_.scene_revision && prepared_ != 0;
    if (another_scene) {
      painter_->renderer().show_prepared();
      has_scene_ = true;
      failed_.clear();
      prepared_ = 0;
    }
    if (failed_revision_ == frame_.scene_revision && !failed_.empty()) has_scene_ = false;
    std::vector<std::string> words = has_scene_ ? std::vector<std::string>{} : notice_lines(now);
    if (another_scene || words != drawn_words_ || !tile_.drawn_already()) {
      painter_->draw(frame_.newest, words);
      tile_.measured(painter_->statistics().figures());
      drawn_words_ = std::move(words);
    }
    tile_.drew(frame_.newest.number, now, clock_.now());
    if (frame_.newest.overlays & kKeepPicture) keep_pictures();
  }

  void keep_pictures() {
    for (std::size_t i = 0; i < part_.tiles.size(); ++i)
      captures_.keep(site_.cluster, {.epoch = frame_.epoch, .number = frame_.newest.number},
                     part_.tiles[i].name, painter_->renderer().read_tile(i));
  }

  void show() {
    const Time began = clock_.now();
    painter_->present();
    const Time now = clock_.now();
    tile_.showed(began, now);
    painter_->statistics().showed(
        now, tile_.presented_frame(from_seconds(1e-3 * site_.viewer.display_latency_ms)));
    if (shown_.wanted())
      for (std::size_t i = 0; i < part_.tiles.size(); ++i)
        shown_.add(now, frame_, part_.tiles[i].name, painter_->renderer().read_tile(i));
    if (coming_ && coming_->scene.free()) bring_to_gpu();  // where there is never time to wait
  }

  void handle_scenes() {
    if (auto scene = tile_.take_scene()) wanted_ = std::move(scene);
    if (loading_.done()) take_loaded();
    if (!wanted_ || loading_.running()) return;
    loading_.start(*wanted_);
    wanted_.reset();
  }

  void take_loaded() {
    coming_.reset();  // its memory, before more is taken
    const std::uint64_t revision = loading_.revision();
    try {
      coming_.emplace(Coming{revision, {loading_.take(), painter_->renderer().renderer().look()}});
    } catch (const Error& error) {
      could_not_load(revision, error);
    }
  }

  /// A short step: frames go on. The last one, with what drivers do at first, is a long one, for
  /// which nobody waits.
  void bring_to_gpu() {
    const std::uint64_t revision = coming_->revision;
    try {
      if (!coming_->scene.step()) return;
      tile_.loads(clock_.now());
      painter_->renderer().prepare(coming_->scene.take());
      prepared_ = revision;
      tile_.loaded(revision);
    } catch (const Error& error) {
      could_not_load(revision, error);
    }
    coming_.reset();
  }

  void could_not_load(std::uint64_t revision, const Error& error) {
    failed_ = error.what();
    failed_revision_ = revision;
    log_warning(part_.tiles.front().name, failed_);
    tile_.could_not_load(revision, failed_);
  }

  std::vector<std::string> notice_lines(Time now) const {
    if (tile_.alone(now))
      return {"on " + host_name(), "waits for the master of \"" + site_.cluster.name + "\""};
    if (!failed_.empty()) return {"on " + host_name(), failed_};
    return {"on " + host_name(), "loading"};
  }

  /// Where no frames come: twice a second.
  void notice(Time now) {
    if (now - noticed_ < std::chrono::milliseconds(500) || !surface_->free()) return;
    noticed_ = now;
    painter_->note(notice_lines(now));
    painter_->present();
    tile_.spoiled();
  }

  MonotonicClock clock_;
  const Site& site_;
  Wall part_;
  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
  WallTile tile_;
  ShownFile shown_;
  CaptureWriter captures_;
  std::unique_ptr<Surface> surface_;
  std::optional<TilePainter> painter_;
  Loading loading_;
  std::optional<SceneMessage> wanted_;
  FrameMessage frame_;
  std::optional<Coming> coming_;
  std::uint64_t prepared_ = 0, failed_revision_ = 0;
  std::string failed_;
  bool has_scene_ = false;
  std::vector<std::string> drawn_words_;  // in place of a scene
  Time noticed_{};
  SignOfLife sign_of_life_;
};

int tile(const TileCommand& command) {
  const Site site = load_site(command.wall_file);
  TileCommand own = command;
  if (own.tiles.empty()) own.tiles = {host_name()};
  const StopSignals signals;
  TileRun run(own, site);
  run.run(signals);
  return 0;
}

}  // namespace

void add_tile(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<TileCommand>();
  CLI::App* app = parent.add_subcommand(
      "tile", "A tile of the wall, or several of one host: draws what the master says");
  app->add_option("TILE", command->tiles, "tile-X-Y, one or more (default: this host's name)");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_flag("--headless", command->headless, "Without a display, by EGL");
  app->add_option("--device", command->device, "EGL device without a display (a GPU's index)");
  app->add_option("--scale", command->scale,
                  "Of the tile's pixels, for slow machines; in a window of that size")
      ->check(between(0.01, 1.0));
  app->add_option("--refresh-hz", command->refresh_hz,
                  "Without a display: refreshes of the one that is played")
      ->check(between(1.0, 1000.0));
  app->add_option("--refresh-phase", command->refresh_phase, "And their phase, 0 to 1")
      ->check(between(0.0, 1.0));
  app->add_option("--shown", command->shown_file,
                  "Writes for each swap when it was, which frame it showed, and the number\n"
                  "that it shows in its pixels (vindu pattern counter, or bar); into a new file\n"
                  "for each start where this is a folder")
      ->type_name("FILE|DIR/");
  app->footer(
      "\nExamples:\n"
      "  vindu tile --wall wall.toml                     on the host tile-3-0: that tile\n"
      "  vindu tile tile-0-0 tile-1-0 --wall wall.toml   two of them\n"
      "  vindu tile tile-0-0 --headless --scale 0.1      without a display\n");
  app->callback([command, &chosen] { chosen = [command] { return tile(*command); }; });
}

}  // namespace vindu::app
