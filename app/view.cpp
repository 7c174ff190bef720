// vindu view: a model on one screen, head-coupled: a window that looks through the screen into the
// scene. The frustum follows the window when it is moved.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/eye_source.h"
#include "app/frame_loop.h"
#include "app/report.h"
#include "app/still_eye.h"
#include "app/viewer.h"
#include "core/error.h"
#include "core/log.h"

namespace vindu::app {
namespace {

constexpr SizePx kPicture{1280, 720};  // without a display

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

/// --eye, or the default. Throws Error for one that cannot see the screen.
Vec3 checked_eye(const ViewOptions& options, const Site& site) {
  Vec3 eye_in_wall = options.eye.value_or(site.viewer.default_eye_in_wall);
  if (!tile_view(site.wall.tiles.front().corners, eye_in_wall))
    throw Error({fmt::format("{:.3f},{:.3f},{:.3f} is at or behind the screen's plane",
                             eye_in_wall.x(), eye_in_wall.y(), eye_in_wall.z()),
                 options.eye ? "--eye" : "viewer.default_eye_m", "give one before it: z > 0"});
  return eye_in_wall;
}

void check_cameras(const Site& site) {
  if (site.cameras.empty())
    throw Error({"no cameras are known", "--track",
                 "name a wall file of one screen with [[camera]] tables, as "
                 "assets/walls/desk.toml: --wall FILE"});
}

/// Where no window can be opened: the eye of the one picture, and what is left out.
Vec3 eye_of_picture(const ViewOptions& options, const Site& site) {
  if (options.track) check_cameras(site);
  for (const auto& [given, name] :
       {std::pair(options.track, "--track"), std::pair(options.mouse, "--mouse"),
        std::pair(options.seconds.has_value(), "--seconds"),
        std::pair(options.fullscreen, "--fullscreen"), std::pair(options.json, "--json")})
    if (given) log_warning(name, "needs a display: it is left out");
  if (!options.path_file.empty()) return read_camera_path(options.path_file).eye_at(0);
  return checked_eye(options, site);
}

std::unique_ptr<EyeSource> choose_eyes(const ViewOptions& options, Window& window, const Site& site,
                                       const EmulatedRoom& room, Clock& clock) {
  if (options.eye) return stay(checked_eye(options, site));
  if (options.mouse) return follow_pointer(window, site.wall, site.viewer.default_eye_in_wall);
  if (!options.path_file.empty()) return follow_path(read_camera_path(options.path_file));
  if (!options.track) return follow_person(room.person());
  check_cameras(site);
  return std::make_unique<TrackedEye>(site, room, clock, TrackedEyeOptions{});
}

/// The eyes of a source, without their trembling: a window before which nobody moves rests.
class RestingEye final : public EyeSource {
 public:
  /// The source and the viewer must outlive it.
  RestingEye(EyeSource& eyes, const Viewer& viewer)
      : eyes_(eyes), viewer_(viewer), still_(viewer.site()) {}

  EyeNow at(Time now, Time photon) override {
    EyeNow eye = eyes_.at(now, photon);
    eye.eye_in_wall = still_.at(eye, viewer_.stage().corners_in_wall(), now);
    return eye;
  }

 private:
  EyeSource& eyes_;
  const Viewer& viewer_;
  StillEye still_;
};

/// Where there is no display: one picture of the model on a screen of 0.53 m.
int view_as_picture(const ViewOptions& options) {
  const Site site = screen_site(
      options, {.name = "picture", .size = kPicture, .width_mm = 527, .height_mm = 296});
  const Vec3 eye = eye_of_picture(options, site);
  const auto surface = make_headless_surface({.device = options.device});
  const LoadedScene loaded =
      load_before(options.model, options, site, site.wall.tiles.front().corners);
  GpuScene scene = uploaded(loaded.packed, Look{});
  pose_on(stage_of(loaded), 0, scene);
  const SceneRenderer renderer(Look{});
  ShadowMap shadow(Look{});
  Canvas canvas(kPicture, Look{});
  Picture picture(kPicture, Style::lit);
  const Tile& tile = site.wall.tiles.front();
  const FrameState state{.eye_in_wall = eye, .pattern = options.pattern};
  auto view = tile_view(tile.corners, eye);
  if (!view) throw Error({"begins at or behind the screen's plane", options.path_file, "z > 0"});
  view->detail = detail_need(tile.corners, kPicture, eye);
  const GpuScene* scenes[] = {&scene};
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
  apply(options.emulation, clock.now(), room_options);
  const EmulatedRoom room(viewer.site(), clock, room_options);
  const auto eyes = choose_eyes(options, *window, viewer.site(), room, clock);
  LoopOptions loop{.rate_hz = viewer.site().rate_hz,
                   .display_latency = from_seconds(1e-3 * viewer.site().viewer.display_latency_ms),
                   .length = {},
                   .navigation = {},
                   .pattern = options.pattern};
  if (options.seconds) loop.length = from_seconds(*options.seconds);
  RestingEye resting(*eyes, viewer);
  const LoopResult result = run_frames(loop, clock, resting,
                                       {[&](const FrameState& state) { return viewer.draw(state); },
                                        [&](const FrameRecord&) {
                                          window->present();
                                          return !window->close_wanted();
                                        },
                                        [&](const FrameRecord& record) {
                                          viewer.statistics().showed(record);
                                          viewer.follow_wishes();
                                        },
                                        [&](const FrameState& state) { return viewer.due(state); },
                                        [&] {
                                          window->handle_events();
                                          viewer.follow_wishes();
                                          return !window->close_wanted();
                                        }});
  viewer.finish();
  const auto* tracked = dynamic_cast<const TrackedEye*>(eyes.get());
  const RunReport report{
      .loop = result,
      .truth = tracked && all_emulated(viewer.site()) ? &room : nullptr,
      .tracker = tracked ? &tracked->tracker() : nullptr,
      .cameras = tracked ? tracked->cameras().states() : std::vector<CameraState>{},
      .wall_px = window->size(),
      .gl = gl_description()};
  std::fputs((options.json ? json_of(report) : table_of(report)).c_str(), stdout);
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
  app->add_flag("--json", options->json, "Figures as JSON");
  app->add_option("--seconds", options->seconds, "End by itself")->check(between(0.05, 1e6));
  app->add_option("--seed", options->seed, "Of the simulated walk")->capture_default_str();
  add_emulation(*app, options->emulation);
  for (const char* name : {"--link", "--kernel", "--press"}) app->get_option(name)->needs(track);
  app->add_option("--device", options->device, "EGL device (GPU) by its index, without a display");
  app->add_option(
      "--out", options->out,
      "Folder for pictures (default: out): those that F12 asks for, and the one that is\n"
      "drawn where there is no display");
  app->footer(
      "\nWithout --eye, --mouse, --track or --path the eye is that of a simulated person who walks "
      "to and fro.\n"
      "Drop another model on the window to see it. F1 shows figures of the frames, F12\n"
      "saves a picture. Escape ends.\n"
      "\nExamples:\n"
      "  vindu view model.glb --mouse\n"
      "  vindu view scan.ply --eye 0,0.1,0.6 --screen-mm 527 296\n"
      "  vindu view --track --wall assets/walls/desk.toml --fullscreen\n");
  app->callback([options, &chosen] {
    refuse_late_presses(options->emulation, options->seconds);
    chosen = [options] { return view(*options); };
  });
}

}  // namespace vindu::app
