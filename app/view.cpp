// vindu view: a model on one screen, head-coupled: a window that looks through the screen into the
// scene. The frustum follows the window when it is moved.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/background.h"
#include "app/caption.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/emulation.h"
#include "app/eye_source.h"
#include "app/frame_loop.h"
#include "app/report.h"
#include "app/window_statistics.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/clips.h"
#include "renderer/notice.h"
#include "renderer/pattern.h"
#include "renderer/resources.h"
#include "renderer/scene_renderer.h"
#include "renderer/surface.h"

namespace vindu::app {
namespace {

constexpr SizePx kPicture{1280, 720};  // without a display

struct ViewOptions {
  std::string model;
  std::string wall_file;
  std::string path_file;
  std::string out = "out";
  std::string clip;
  std::optional<Placement> place;
  std::optional<Vec3> eye;
  std::optional<double> seconds;
  std::optional<int> device;
  std::vector<double> screen_mm;
  std::uint64_t seed = 1;
  Pattern pattern = Pattern::none;
  bool mouse = false;
  bool track = false;
  bool fullscreen = false;
  EmulationOptions emulation;
};

/// The screen as the monitor reports it, checked for sense, or as it was typed or written down.
/// Metres.
Vec2 screen_size_m(const ViewOptions& options, const ScreenReport& screen, const Site* site) {
  if (options.screen_mm.size() == 2) return 1e-3 * Vec2(options.screen_mm[0], options.screen_mm[1]);
  if (site) return {site->wall.grid.width_m, site->wall.grid.height_m};
  const std::string doubt = doubt_about(screen);
  if (doubt.empty()) return 1e-3 * Vec2(screen.width_mm, screen.height_mm);
  Vec2 assumed = 25.4e-3 / 96 * Vec2(screen.size.width, screen.size.height);
  log_warning("screen " + screen.name, doubt + "; taken as " +
                                           std::to_string(std::lround(1e3 * assumed.x())) + " x " +
                                           std::to_string(std::lround(1e3 * assumed.y())) +
                                           " mm; measure it and say --screen-mm WIDTH HEIGHT");
  return assumed;
}

/// The site of one screen: the file's, or made from the screen's size.
Site screen_site(const ViewOptions& options, const ScreenReport& screen) {
  std::optional<Site> written;
  if (!options.wall_file.empty()) written = read_site(options.wall_file);
  if (written && written->wall.tiles.size() != 1)
    throw Error(
        {"has " + std::to_string(written->wall.tiles.size()) + " tiles, but view shows one screen",
         options.wall_file, "use vindu simulate, or vindu render"});
  const Vec2 size_m = screen_size_m(options, screen, written ? &*written : nullptr);
  Site site = written.value_or(Site{});
  const TileMount mount = written ? written->wall.tiles.front().mount : TileMount{};
  const double height_m = written ? written->wall.room_from_wall.translation.y() : 1.2;
  site.wall = single_screen(size_m.x(), size_m.y(), screen.size.width, screen.size.height);
  site.wall.tiles.front().mount = mount;
  site.wall.room_from_wall = room_from_wall_at(height_m, 0);
  if (!written) site.viewer.default_eye_in_wall = {0, 0.15 * size_m.x(), 1.3 * size_m.x()};
  return site;
}

/// A walk before a screen of this width: as wide as the screen twice, one to two widths away.
PersonOptions walk_before(const Wall& wall, Time start, std::uint64_t seed) {
  const double width_m = wall.grid.width_m, height_m = wall.room_from_wall.translation.y();
  PersonOptions person;
  person.seed = seed;
  person.start = start;
  person.least_eye_in_room = {-0.9 * width_m, height_m - 0.05 * width_m, 0.9 * width_m};
  person.largest_eye_in_room = {0.9 * width_m, height_m + 0.4 * width_m, 1.8 * width_m};
  person.peak_walk_m_s = std::min(0.5, 0.6 * width_m);
  return person;
}

/// A model on the GPU, and where it stands.
struct Shown {
  GpuScene scene;
  Navigation navigation;
  int clip = 0;
  bool plays = false;  // something else at every moment
};

Shown shown_of(const LoadedScene& loaded) {
  return {.scene = GpuScene(loaded.packed, live_look()),
          .navigation = loaded.navigation,
          .clip = loaded.clip,
          .plays = static_cast<std::size_t>(loaded.clip) < clip_names(loaded.packed.scene).size()};
}

/// `model` may be another one than the options', whose clip it then need not have.
LoadedScene load_before(const std::string& model, const ViewOptions& options, const Site& site,
                        const TileCorners& content, const std::stop_token& stop = {}) {
  Site place_before = site;  // fitted to the window, not to the screen
  place_before.wall = single_screen(content.width_m(), content.height_m(), 1, 1);
  LoadedScene loaded = load_scene(model, options.place, place_before,
                                  model == options.model ? options.clip : "", stop);
  const bool own_place = options.place == Placement::as_is;
  if (!own_place) loaded.navigation.wall_from_scene.translation += content.centre_in_wall();
  return loaded;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

class Viewer {
 public:
  Viewer(const ViewOptions& options, Window& window)
      : options_(options),
        window_(window),
        site_(screen_site(options, window.screen())),
        renderer_(live_look()),
        patterns_(site_.wall, Style::lit),
        statistics_(window, site_.rate_hz),
        shadow_(live_look()) {}

  const Site& site() const { return site_; }

  WindowStatistics& statistics() { return statistics_; }

  /// Reads the first model while the window stays alive; false: it was closed before. Throws Error
  /// for a model that cannot be read.
  bool load_first() {
    const Time began = std::chrono::steady_clock::now();
    start(options_.model);
    for (WaitingPage shown; !reading_.done();) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const Duration waited = std::chrono::steady_clock::now() - began;
      const WaitingPage page{picture_size(), std::chrono::floor<std::chrono::seconds>(waited)};
      const bool due = window_.take_damaged() || page != shown;
      if (due && waited > std::chrono::milliseconds(300))
        draw(shown = page);
      else
        window_.handle_events();
      if (window_.close_wanted()) return false;
    }
    shown_.emplace(shown_of(reading_.take()));
    return true;
  }

  /// Whether a frame would look other than the one that is shown.
  bool due(FrameState state) {
    if (!shown_->plays) state.animation_time_s = 0;
    const TileCorners content = content_corners(site_.wall.tiles.front(), window_);
    Showing next{.content_hash = content_hash_of(state),
                 .models = models_,
                 .size = window_.size(),
                 .lower_left_in_wall = content.lower_left_in_wall,
                 .caption = caption_.words(std::chrono::steady_clock::now()),
                 .statistics = statistics_.on()};
    const bool changed = window_.take_damaged() || next.statistics || next != showing_;
    showing_ = std::move(next);
    return changed;
  }

  int draw(const FrameState& state) {
    const SizePx size = picture_size();
    if (size.width < 1 || size.height < 1) return 0;  // minimised
    if (!canvas_ || canvas_->size() != size) {
      canvas_ = std::make_unique<Canvas>(size, live_look());
      picture_ = std::make_unique<Picture>(size, Style::lit);
    }
    const Tile content = content_tile(size);
    auto view = tile_view(content.corners, state.eye_in_wall);
    if (view) view->detail = detail_need(content.corners, size, state.eye_in_wall);
    shown_->scene.pose(matrix_of(shown_->navigation.wall_from_scene, shown_->navigation.scale),
                       state.animation_time_s, shown_->clip);
    const GpuScene* scenes[] = {&shown_->scene};
    shadow_.update(scenes, shadow_region(site_.wall));
    canvas_->begin();
    const Time began = std::chrono::steady_clock::now();
    statistics_.timer().begin();
    const bool model = view && shows_model(state);
    const DrawCount count = model ? renderer_.draw(*view, scenes, {}, &shadow_) : DrawCount{};
    canvas_->resolve(*picture_);
    if (!shows_model(state)) patterns_.draw(state, content, {0, 0, size}, *picture_);
    PatternPainter::draw_number(state, {0, 0, size}, *picture_);
    statistics_.timer().end();
    caption_.draw(*picture_, began);
    put_into_window(*picture_);
    statistics_.draw_over(renderer_);
    glFinish();
    statistics_.drew(count, std::chrono::steady_clock::now() - began);
    return view ? 0 : 1;
  }

  /// A model dropped on the window replaces the shown one when it is read; one that cannot be read
  /// changes nothing. The one that is dropped last counts.
  void follow_drops() {
    if (auto file = window_.take_dropped_file()) {
      dropped_ = std::move(file);
      reading_.stop();
    }
    if (reading_.done()) change();
    if (!dropped_ || reading_.running()) return;
    caption_.say(file_name(*dropped_) + " is being read");
    start(*std::exchange(dropped_, std::nullopt));
  }

 private:
  /// While the first model is read.
  struct WaitingPage {
    SizePx size;
    std::chrono::seconds waited{-1};

    bool operator==(const WaitingPage&) const = default;
  };

  /// What a picture in the window depends on.
  struct Showing {
    std::uint64_t content_hash = 0;
    int models = -1;
    SizePx size;
    Vec3 lower_left_in_wall = Vec3::Zero();
    std::string caption;
    bool statistics = false;

    bool operator==(const Showing&) const = default;
  };

  void start(const std::string& model) {
    name_ = model.empty() ? "the scene" : file_name(model);
    const TileCorners content = content_corners(site_.wall.tiles.front(), window_);
    reading_.start([this, model, content](const std::stop_token& stop) {
      return load_before(model, options_, site_, content, stop);
    });
  }

  void change() {
    try {
      shown_.emplace(shown_of(reading_.take()));
      ++models_;
      caption_.say("");
    } catch (const Error& error) {
      if (dropped_) return;  // stopped for it
      log_warning("view", std::string(error.what()) + " (the scene before it stays)");
      caption_.say(name_ + " cannot be shown: see the terminal",
                   std::chrono::steady_clock::now() + std::chrono::seconds(8));
    }
  }

  void draw(const WaitingPage& page) {
    if (page.size.width < 1 || page.size.height < 1) return window_.handle_events();  // minimised
    Picture picture(page.size, Style::lit);
    picture.write(draw_notice(
        {.title = "Vindu", .lines = {"reads " + name_, fmt::format("{} s", page.waited.count())}},
        page.size));
    put_into_window(picture);
    window_.present();
  }

  /// Of what the viewer sees: a screen may be turned.
  SizePx picture_size() const {
    const SizePx size = window_.size();
    const bool turned = site_.wall.tiles.front().mount.rotate_deg % 180 == 90;
    return turned ? SizePx{size.height, size.width} : size;
  }

  void put_into_window(Picture& picture) {
    picture.make_mipmaps();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, window_.size().width, window_.size().height);
    renderer_.present(picture, site_.wall.tiles.front().mount);
  }

  /// The window's content as a tile of its own.
  Tile content_tile(SizePx size) const {
    Tile tile = site_.wall.tiles.front();
    tile.corners = content_corners(tile, window_);
    tile.width_px = size.width;
    tile.height_px = size.height;
    return tile;
  }

  const ViewOptions& options_;
  Window& window_;
  Site site_;
  SceneRenderer renderer_;
  PatternPainter patterns_;
  WindowStatistics statistics_;
  ShadowMap shadow_;
  std::optional<Shown> shown_;
  int models_ = 0;  // that have been shown
  Showing showing_;
  Caption caption_;
  std::string name_;  // of what is being read
  std::optional<std::string> dropped_;
  Background<LoadedScene> reading_;
  std::unique_ptr<Canvas> canvas_;
  std::unique_ptr<Picture> picture_;
};

std::unique_ptr<EyeSource> choose_eyes(const ViewOptions& options, Window& window, const Site& site,
                                       const EmulatedRoom& room, Clock& clock) {
  if (options.eye) return stay(*options.eye);
  if (options.mouse) return follow_pointer(window, site.wall, site.viewer.default_eye_in_wall);
  if (!options.path_file.empty()) return follow_path(read_camera_path(options.path_file));
  if (!options.track) return follow_person(room.person());
  if (site.cameras.empty())
    throw Error({"no cameras are known", "--track",
                 "name a wall file of one screen with [[camera]] tables, as "
                 "assets/walls/desk.toml: --wall FILE"});
  return std::make_unique<TrackedEye>(site, room, clock, TrackedEyeOptions{});
}

/// Where there is no display: one picture of the model on a screen of 0.53 m.
int view_as_picture(const ViewOptions& options) {
  const Site site = screen_site(
      options, {.name = "picture", .size = kPicture, .width_mm = 527, .height_mm = 296});
  const auto surface = make_headless_surface({.device = options.device});
  Shown shown =
      shown_of(load_before(options.model, options, site, site.wall.tiles.front().corners));
  shown.scene.pose(matrix_of(shown.navigation.wall_from_scene, shown.navigation.scale), 0,
                   shown.clip);
  const SceneRenderer renderer(Look{});
  ShadowMap shadow(Look{});
  Canvas canvas(kPicture, Look{});
  Picture picture(kPicture, Style::lit);
  const Vec3 eye = options.eye.value_or(site.viewer.default_eye_in_wall);
  const Tile& tile = site.wall.tiles.front();
  const FrameState state{.eye_in_wall = eye, .pattern = options.pattern};
  auto view = tile_view(tile.corners, eye);
  if (!view) throw Error({"is at or behind the screen's plane", "--eye", "give an eye with z > 0"});
  view->detail = detail_need(tile.corners, kPicture, eye);
  const GpuScene* scenes[] = {&shown.scene};
  shadow.update(scenes, shadow_region(site.wall));
  canvas.begin();
  renderer.draw(*view, scenes, {}, &shadow);
  canvas.resolve(picture);
  if (!shows_model(state))
    PatternPainter(site.wall, Style::lit).draw(state, tile, {0, 0, kPicture}, picture);
  PatternPainter::draw_number(state, {0, 0, kPicture}, picture);
  make_folder(options.out);
  write_png(picture.read(), options.out + "/view.png");
  log_info("view", "there is no display, so one picture was drawn");
  std::printf("%s/view.png\n", options.out.c_str());
  return 0;
}

int view(const ViewOptions& options) {
  if (!has_display()) return view_as_picture(options);
  const auto window =
      make_window({.size = {1280, 720}, .title = "Vindu", .fullscreen = options.fullscreen});
  MonotonicClock clock;
  Viewer viewer(options, *window);
  if (!viewer.load_first()) return 0;
  EmulatedRoomOptions room_options;
  room_options.person = walk_before(viewer.site().wall, clock.now(), options.seed);
  apply(options.emulation, room_options.wiimote);
  const EmulatedRoom room(viewer.site(), clock, room_options);
  const auto eyes = choose_eyes(options, *window, viewer.site(), room, clock);
  LoopOptions loop{.rate_hz = viewer.site().rate_hz,
                   .display_latency = from_seconds(1e-3 * viewer.site().viewer.display_latency_ms),
                   .length = {},
                   .navigation = {},
                   .pattern = options.pattern};
  if (options.seconds) loop.length = from_seconds(*options.seconds);
  const LoopResult result =
      run_frames(loop, clock, *eyes,
                 {[&](const FrameState& state) { return viewer.draw(state); },
                  [&](const FrameRecord&) {
                    window->present();
                    viewer.follow_drops();
                    return !window->close_wanted();
                  },
                  [&](const FrameRecord& record) { viewer.statistics().showed(record); },
                  [&](const FrameState& state) { return viewer.due(state); },
                  [&] {
                    window->handle_events();
                    viewer.follow_drops();
                    return !window->close_wanted();
                  }});
  const auto* tracked = dynamic_cast<const TrackedEye*>(eyes.get());
  const RunReport report{
      .loop = result,
      .truth = tracked && all_emulated(viewer.site()) ? &room.person() : nullptr,
      .tracker = tracked ? &tracked->tracker() : nullptr,
      .cameras = tracked ? tracked->cameras().states() : std::vector<CameraState>{},
      .wall_px = window->size(),
      .gl = gl_description()};
  std::fputs(table_of(report).c_str(), stdout);
  return 0;
}

}  // namespace

void add_view(CLI::App& parent, Action& chosen) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* app = parent.add_subcommand(
      "view", "A model on one screen, in the perspective of the head before it");
  app->add_option("MODEL", options->model,
                  "Any model that Assimp reads (default: the wall file's, or the show)");
  app->add_option("--wall", options->wall_file, "Wall file of one screen, with its cameras")
      ->type_name("FILE");
  auto* eye = add_vec3(*app, "--eye", options->eye,
                       "A fixed eye: metres from the screen's centre, +z towards the viewer");
  auto* mouse =
      app->add_flag("--mouse", options->mouse, "The pointer moves the eye, the wheel its distance");
  auto* track = app->add_flag("--track", options->track,
                              "The eye is tracked by the cameras that the wall file names");
  auto* path = app->add_option("--path", options->path_file, "The eye follows a camera path")
                   ->type_name("FILE");
  mouse->excludes(eye)->excludes(track)->excludes(path);
  track->excludes(eye)->excludes(path);
  path->excludes(eye);
  app->add_option("--screen-mm", options->screen_mm,
                  "The screen's visible size, where it reports a wrong one")
      ->expected(2)
      ->check(between(20.0, 50000.0))
      ->type_name("WIDTH HEIGHT");
  add_place(*app, options->place);
  add_pattern_choice(*app, options->pattern);
  add_clip(*app, options->clip);
  app->add_flag("--fullscreen", options->fullscreen, "Cover the screen");
  app->add_option("--seconds", options->seconds, "End by itself")->check(between(0.05, 1e6));
  app->add_option("--seed", options->seed, "Of the simulated walk");
  add_emulation(*app, options->emulation);
  for (const char* name : {"--link", "--kernel"}) app->get_option(name)->needs(track);
  app->add_option("--device", options->device, "EGL device (GPU) by its index, without a display");
  app->add_option("--out", options->out,
                  "Folder for the picture where there is no display (default: out)");
  app->footer(
      "\nWithout --eye, --mouse, --track or --path the eye is that of a simulated person who walks "
      "to and fro.\n"
      "Drop another model on the window to see it. F1 shows figures of the frames. Escape ends.\n"
      "\nExamples:\n"
      "  vindu view model.glb --mouse\n"
      "  vindu view scan.ply --eye 0,0.1,0.6 --screen-mm 527 296\n"
      "  vindu view --track --wall assets/walls/desk.toml --fullscreen\n");
  app->callback([options, &chosen] { chosen = [options] { return view(*options); }; });
}

}  // namespace vindu::app
