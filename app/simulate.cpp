// vindu simulate: the whole chain on this machine alone. Emulated Wiimotes watch a walking person,
// the tracker finds the head, all tiles draw head-coupled; in a window where there is a display,
// else as pictures; then a table.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/contact_sheet.h"
#include "app/emulation.h"
#include "app/eye_source.h"
#include "app/fluid_scale.h"
#include "app/frame_csv.h"
#include "app/frame_loop.h"
#include "app/report.h"
#include "app/window_statistics.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/eye_picture.h"
#include "renderer/resources.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"
#include "simulator/room_view.h"

namespace vindu::app {
namespace {

constexpr double kSheetScale = 0.25;  // of the wall in the pictures that are kept
constexpr SizePx kRoomPicture{1280, 800};
constexpr int kColumn_px = 620;

struct SimulateOptions {
  std::string model;
  std::string wall_file;
  std::string mode = "track";
  std::string path_file;
  std::optional<std::string> method;
  std::string clock = "real";
  std::string out = "out";
  std::string csv_file;
  std::string clip;
  std::optional<Placement> place;
  std::optional<double> seconds;
  std::optional<double> scale;
  std::optional<int> device;
  Pattern pattern = Pattern::none;
  std::uint64_t seed = 52;  // a walk that soon goes to both sides
  double noise_px = 0.3;
  EmulationOptions emulation;
  bool headless = false;
  bool json = false;
};

/// Everything of one run, assembled here and nowhere else. Members are in the order in which they
/// need each other.
struct Run {
  SimulateOptions options;
  Site site;
  LoadedScene loaded;
  std::unique_ptr<Clock> clock;
  std::unique_ptr<EmulatedRoom> room;
  std::unique_ptr<EyeSource> eyes;
  const Tracker* tracker = nullptr;
  const Cameras* cameras = nullptr;
  std::unique_ptr<Surface> surface;
  std::unique_ptr<WallRenderer> wall;
};

/// A camera's times are the real clock's.
void check_clock(const SimulateOptions& options, const Site& site) {
  if (options.clock != "manual" || options.mode != "track") return;
  for (const CameraConfig& camera : site.cameras)
    if (camera.source == CameraSource::wiimote ||
        (camera.source == CameraSource::video && !camera.video.device.empty()))
      throw Error({"a real camera cannot follow --clock manual", "camera " + camera.name,
                   "leave --clock out, or use emulated cameras or video files"});
}

EmulatedRoomOptions room_options(const SimulateOptions& options, const Site& site,
                                 const Clock& clock) {
  EmulatedRoomOptions room = walking_room(options.emulation, site, options.seed, clock.now());
  room.wiimote.noise_px = options.noise_px;
  return room;
}

/// What a frame of the wall takes at a scale while the eye moves: the median of a few.
double frame_s(const Run& run, double scale) {
  constexpr int kWarmUp = 3, kFrames = 9;
  WallRenderer trial(run.site.wall, scale, live_look());
  trial.show(run.loaded.packed);
  const MonotonicClock clock;
  FrameState state{.eye_in_wall = run.site.viewer.default_eye_in_wall,
                   .navigation = run.loaded.navigation,
                   .clip = run.loaded.clip};
  std::vector<double> times_s;
  for (int frame = 0; frame < kWarmUp + kFrames; ++frame) {
    state.eye_in_wall.x() += 0.05;
    const Time begin = clock.now();
    trial.draw(state);
    trial.finish();
    if (frame >= kWarmUp) times_s.push_back(seconds(clock.now() - begin));
  }
  std::ranges::nth_element(times_s, times_s.begin() + kFrames / 2);
  return times_s[kFrames / 2];
}

std::unique_ptr<EyeSource> make_eyes(Run& run) {
  const SimulateOptions& options = run.options;
  if (options.mode == "loop")
    return follow_path(read_camera_path(options.path_file.empty() ? find_asset("paths/sweep.toml")
                                                                  : options.path_file));
  auto tracked = std::make_unique<TrackedEye>(
      run.site, *run.room, *run.clock,
      TrackedEyeOptions{.cameras = {.threads = options.clock != "manual", .tap = {}},
                        .on_frame = {}});
  run.tracker = &tracked->tracker();
  run.cameras = &tracked->cameras();
  return tracked;
}

Run assemble(const SimulateOptions& options) {
  Run run{.options = options,
          .site = load_site(options.wall_file),
          .loaded = {},
          .clock = {},
          .room = {},
          .eyes = {},
          .surface = {},
          .wall = {}};
  if (options.method) run.site.tracking.method = *options.method;
  if (run.site.cameras.empty() && options.mode == "track")
    throw Error({"names no [[camera]]", options.wall_file,
                 "add cameras with source = \"emulated\", or use --mode loop"});
  check_clock(options, run.site);
  run.loaded = load_scene(options.model, options.place, run.site, options.clip);
  const bool manual = options.clock == "manual";
  if (manual)
    run.clock = std::make_unique<ManualClock>();
  else
    run.clock = std::make_unique<MonotonicClock>();
  const bool windowed = !options.headless && !manual && has_display();
  if (windowed)
    run.surface = make_window({.size = {1280, 900}, .title = "Vindu"});
  else
    run.surface = make_headless_surface({.device = options.device});
  log_info("simulate", gl_description());
  const double budget_s = windowed ? 0.014 : 0.028;  // 30 a second; in a window half for the room
  const double scale = options.scale ? *options.scale
                       : manual
                           ? 0.1
                           : fluid_scale([&](double at) { return frame_s(run, at); }, budget_s);
  run.wall = std::make_unique<WallRenderer>(run.site.wall, scale, live_look());
  run.wall->show(run.loaded.packed);
  run.room = std::make_unique<EmulatedRoom>(run.site, *run.clock,
                                            room_options(options, run.site, *run.clock));
  run.eyes = make_eyes(run);
  return run;
}

/// The picture in the middle of a box of the window, as large as fits.
void present_in(const WallRenderer& wall, const Picture& picture, int x, int y, SizePx box) {
  const double scale = std::min(static_cast<double>(box.width) / picture.size().width,
                                static_cast<double>(box.height) / picture.size().height);
  const int width = static_cast<int>(picture.size().width * scale),
            height = static_cast<int>(picture.size().height * scale);
  glViewport(x + (box.width - width) / 2, y + (box.height - height) / 2, width, height);
  wall.renderer().present(picture, {});
}

/// Where the room's picture shows the head: the person's own, or on a path one that faces the wall
/// with its eye there.
Rigid3 head_in_picture(const Run& run, const FrameRecord& frame) {
  if (run.tracker && all_emulated(run.site))
    return followed_person(*run.room, frame).room_from_head(frame.state.photon_time);
  const Rigid3& room_from_wall = run.site.wall.room_from_wall;
  return {Quat::Identity(),
          room_from_wall * frame.state.eye_in_wall - run.site.heads.front().eye_in_head};
}

/// The window: the room above, the wall's picture below.
class WindowPainter {
 public:
  WindowPainter(Run& run, Window& window)
      : run_(run),
        room_(run.site, {960, 540}, live_look()),
        statistics_(window, run.site.rate_hz) {}
  WindowStatistics& statistics() { return statistics_; }
  void paint(const FrameRecord& record) {
    room_.draw(*run_.wall, head_in_picture(run_, record));
    const SizePx size = run_.surface->size();
    const int strip = size.height * 2 / 5;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    room_.picture().make_mipmaps();
    present_in(*run_.wall, room_.picture(), 0, strip, {size.width, size.height - strip});
    present_in(*run_.wall, run_.wall->picture(), 0, 0, {size.width, strip});
    statistics_.draw_over(run_.wall->renderer());
  }

 private:
  Run& run_;
  RoomView room_;
  WindowStatistics statistics_;
};

/// As a wall of processes has it, but for the tiles' names.
FrameLine line_of(const FrameRecord& record, std::size_t tiles) {
  return {.number = record.state.number,
          .tick = record.tick,
          .level = record.pose ? std::optional(record.pose->level) : std::nullopt,
          .tiles = tiles,
          .parts = record.parts};
}

LoopResult play(Run& run) {
  LoopOptions loop{.rate_hz = run.site.rate_hz,
                   .display_latency = from_seconds(1e-3 * run.site.viewer.display_latency_ms),
                   .length = {},
                   .navigation = run.loaded.navigation,
                   .pattern = run.options.pattern,
                   .clip = run.loaded.clip};
  auto* const window = dynamic_cast<Window*>(run.surface.get());
  if (run.options.seconds || !window) loop.length = from_seconds(run.options.seconds.value_or(15));
  std::optional<WindowPainter> painter;
  if (window) painter.emplace(run, *window);
  std::optional<FrameCsv> csv;
  if (!run.options.csv_file.empty()) csv.emplace(run.options.csv_file);
  const auto draw = [&](const FrameState& state) {
    const Time began = run.clock->now();
    if (painter) painter->statistics().timer().begin();
    const WallFrame frame = run.wall->draw(state);
    if (painter) painter->statistics().timer().end();
    run.wall->finish();
    if (painter) painter->statistics().drew(frame.count, run.clock->now() - began);
    return static_cast<int>(frame.black_tiles.size());
  };
  const auto present = [&](const FrameRecord& record) {
    if (painter) painter->paint(record);
    run.surface->present();
    return !run.surface->close_wanted();
  };
  const auto shown = [&](const FrameRecord& record) {
    if (painter) painter->statistics().showed(record);
    if (csv) csv->add(line_of(record, run.site.wall.tiles.size()));
  };
  return run_frames(loop, *run.clock, *run.eyes, {draw, present, shown});
}

/// The moments worth a picture: farthest left, in the middle between both, farthest right; among
/// frames that show the tracked eye.
std::vector<std::pair<std::string, const FrameRecord*>> choose_moments(
    const std::vector<FrameRecord>& frames) {
  std::vector<const FrameRecord*> candidates;
  for (const FrameRecord& frame : frames)
    if (!frame.pose || frame.shows_the_tracked_eye) candidates.push_back(&frame);
  if (candidates.empty())
    for (const FrameRecord& frame : frames) candidates.push_back(&frame);
  if (candidates.empty()) return {};
  const auto x = [](const FrameRecord* frame) { return frame->state.eye_in_wall.x(); };
  const auto [left, right] = std::ranges::minmax(candidates, {}, x);
  const double middle = 0.5 * (x(left) + x(right));
  const FrameRecord* between = *std::ranges::min_element(
      candidates, {}, [&](const FrameRecord* frame) { return std::abs(x(frame) - middle); });
  return {{"To the left", left}, {"In between", between}, {"To the right", right}};
}

Image shrunk(const Run& run, const Picture& picture, int width_px) {
  const int height_px =
      static_cast<int>(std::lround(1.0 * picture.size().height * width_px / picture.size().width));
  Picture small({width_px, height_px}, Style::lit);
  glBindFramebuffer(GL_FRAMEBUFFER, small.framebuffer());
  present_in(*run.wall, picture, 0, 0, small.size());
  return small.read();
}

Moment picture_moment(Run& run, WallRenderer& wall, RoomView& room, const std::string& title,
                      const FrameRecord& frame) {
  wall.draw(frame.state);
  const Vec3& eye = frame.state.eye_in_wall;
  room.draw(wall, head_in_picture(run, frame));
  room.picture().make_mipmaps();
  return {.title = title,
          .caption = fmt::format("eye {:.2f} m {} of the middle, {:.2f} m before the wall",
                                 std::abs(eye.x()), eye.x() < 0 ? "left" : "right", eye.z()),
          .room = shrunk(run, room.picture(), kColumn_px),
          .wall = shrunk(run, wall.picture(), kColumn_px),
          .eye = picture_from_eye(wall, eye, {kColumn_px, kColumn_px * 9 / 16})};
}

/// "Two emulated Wiimotes behind the person track the helmet."
std::string trackers_in_words(const Site& site) {
  if (!all_emulated(site)) return "The wall file's cameras track the head";
  constexpr const char* kWords[] = {"No", "One", "Two", "Three", "Four", "Five", "Six"};
  const std::size_t count = site.cameras.size();
  const auto towards_wall = std::ranges::count_if(site.cameras, [](const CameraConfig& camera) {
    return (camera.room_from_camera.rotation * Vec3::UnitZ()).z() < 0;
  });
  const char* const place = towards_wall == std::ssize(site.cameras) ? " behind the person"
                            : towards_wall == 0                      ? " before the person"
                                                                     : "";
  return fmt::format("{} emulated Wiimote{}{} track{} the helmet",
                     count < std::size(kWords) ? kWords[count] : std::to_string(count),
                     count == 1 ? "" : "s", place, count == 1 ? "s" : "");
}

void save_sheet(Run& run, const LoopResult& result) {
  const auto moments = choose_moments(result.frames);
  if (moments.empty()) return;
  WallRenderer wall(run.site.wall, kSheetScale, Look{});
  wall.show(run.loaded.packed);
  RoomView room(run.site, kRoomPicture, Look{});
  std::vector<Moment> pictures;
  for (const auto& [title, frame] : moments)
    pictures.push_back(picture_moment(run, wall, room, title, *frame));
  const std::string source =
      run.options.mode == "loop" ? "The eye follows a path" : trackers_in_words(run.site);
  const Image sheet =
      contact_sheet({"Vindu: the wall is a window",
                     source + "; each tile draws what that eye would see through it."},
                    pictures);
  write_png(sheet, run.options.out + "/contact-sheet.png");
  for (std::size_t index = 0; index < moments.size(); ++index) {
    const std::string base = run.options.out + "/moment-" + std::to_string(index + 1);
    wall.draw(moments[index].second->state);
    write_png(wall.picture().read(), base + "-wall.png");
  }
  std::printf("%s/contact-sheet.png\n", run.options.out.c_str());
}

int simulate(const SimulateOptions& options) {
  Run run = assemble(options);
  make_folder(options.out);  // what cannot be made is said before the run
  const LoopResult result = play(run);
  save_sheet(run, result);
  const RunReport report{
      .loop = result,
      .truth = run.tracker && all_emulated(run.site) ? run.room.get() : nullptr,
      .tracker = run.tracker,
      .cameras = run.cameras ? run.cameras->states() : std::vector<CameraState>{},
      .scale = static_cast<double>(run.wall->layout().tiles.front().size.width) /
               run.site.wall.tiles.front().width_px,
      .wall_px = run.wall->layout().size,
      .gl = gl_description()};
  std::fputs((options.json ? json_of(report) : table_of(report)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_simulate(CLI::App& parent, Action& chosen) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* app = parent.add_subcommand("simulate",
                                        "The whole wall on this machine alone: a walking person, "
                                        "emulated Wiimotes, tracker, all tiles");
  app->add_option("MODEL", options->model,
                  "Any model that Assimp reads (default: the wall file's, or the show)");
  app->add_option("--wall", options->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  add_place(*app, options->place);
  add_pattern_choice(*app, options->pattern);
  add_clip(*app, options->clip);
  app->add_option("--mode", options->mode, "track: the eye is tracked; loop: it follows a path")
      ->check(CLI::IsMember({"track", "loop"}));
  app->add_option("--path", options->path_file, "Camera path of loop mode")->type_name("FILE");
  app->add_option(
         "--method", options->method,
         "Tracking method: joint, or the thesis' own to compare (default: the wall file's)")
      ->check(CLI::IsMember({"joint", "thesis"}));
  app->add_option("--seconds", options->seconds,
                  "Length of the run (default: 15; in a window: until it is closed)")
      ->check(between(0.05, 1e6));
  app->add_option("--scale", options->scale,
                  "Pixels per pixel of the wall (default: what this machine draws fluidly)")
      ->check(between(0.005, 4.0));
  app->add_option("--seed", options->seed, "Of the walk and of the cameras' noise")
      ->capture_default_str();
  app->add_option("--noise-px", options->noise_px, "Noise of the emulated cameras")
      ->check(between(0.0, 20.0));
  add_emulation(*app, options->emulation);
  app->add_option("--clock", options->clock,
                  "manual: time moves by frames alone, so that runs are bit-equal")
      ->check(CLI::IsMember({"real", "manual"}));
  app->add_flag("--headless", options->headless, "No window, also where there is a display");
  app->add_flag("--json", options->json, "Figures as JSON");
  app->add_option("--csv", options->csv_file,
                  "Writes a line for each frame: its parts and motion to photon")
      ->type_name("FILE");
  app->add_option("--device", options->device, "EGL device (GPU) by its index, without a window");
  app->add_option("--out", options->out, "Folder for the pictures (default: out)")
      ->type_name("DIR");
  app->footer(
      "\nIn the window F1 shows figures of the frames; Escape ends.\n"
      "\nExamples:\n"
      "  vindu simulate\n"
      "  vindu simulate model.glb --seconds 30 --out pictures\n"
      "  vindu simulate --mode loop --path path.toml --clock manual --seconds 5\n");
  app->callback([options, &chosen] {
    refuse_late_presses(options->emulation, options->seconds);
    chosen = [options] { return simulate(*options); };
  });
}

}  // namespace vindu::app
