// vindu calibrate intrinsics and extrinsics: single cameras by a rig of LEDs in a grid, as the
// thesis did it (3.3, 4.2.4, A.4, A.5).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/calibrate.h"
#include "app/cameras.h"
#include "app/common.h"
#include "core/error.h"
#include "tracker/calibration/grid.h"
#include "tracker/calibration/lens.h"
#include "tracker/camera_model.h"

namespace vindu::app {
namespace {

struct RigCommand {
  CalibrateOptions common;
  std::vector<int> grid = {2, 2};
  std::vector<double> spacing_mm = {91.44};
  std::string camera;
  LensOptions lens;
  std::optional<Vec3> rig_in_room;
  double rig_heading_deg = 0;
};

Grid grid_of(const RigCommand& command) {
  return {command.grid[0], command.grid[1], 1e-3 * command.spacing_mm.front(),
          1e-3 * command.spacing_mm.back()};
}

std::size_t camera_named(const std::string& name, const Site& site) {
  const auto camera = std::ranges::find(site.cameras, name, &CameraConfig::name);
  if (camera == site.cameras.end())
    throw Error({"no camera has this name", name, "vindu check shows the wall file's cameras"});
  return static_cast<std::size_t>(camera - site.cameras.begin());
}

/// Waved before one camera, its LEDs towards it.
LedBody waved_rig(const CameraConfig& truth, const Grid& grid, std::uint64_t seed) {
  WaveOptions wave;
  wave.seed = seed;
  wave.room_from_rest =
      truth.room_from_camera * Rigid3{Quat(Eigen::AngleAxisd(kPi, Vec3::UnitX())), {0, 0, 0.75}};
  wave.reach_m = {0.2, 0.15, 0.2};
  wave.turn_rad = {0.9, 0.9, 0.6};
  return bare_leds(grid.leds_in_rig(), waved(wave));
}

std::string lens_line(const std::string& name, const LensResult& lens) {
  return fmt::format(
      "{}: focal length {:.1f} +- {:.1f} px, centre {:.1f} +- {:.1f}, {:.1f} +- {:.1f} px, k1 "
      "{:.3f} "
      "+- {:.3f}; {} views, rms {:.2f} px, {:.0f} % of the picture covered\n",
      name, lens.intrinsics.fx_px, lens.focal_sigma_px, lens.intrinsics.cx_px,
      lens.centre_sigma_px.x(), lens.intrinsics.cy_px, lens.centre_sigma_px.y(),
      lens.intrinsics.distortion[0], lens.k1_sigma, lens.views, lens.rms_px,
      100 * lens.coverage.share());
}

/// Throws Error unless the camera tells of so many dots at once.
void expect_room_for(const Grid& grid, const CameraConfig& camera) {
  const std::size_t leds = grid.leds_in_rig().size(), most = most_dots(camera);
  if (leds > most)
    throw Error({fmt::format("has {} LEDs, and camera {} sees {} at once", leds, camera.name, most),
                 "--grid",
                 camera.source == CameraSource::video
                     ? "raise max_dots of the camera in the wall file, or take a smaller rig"
                     : "take 2,2; larger rigs are for cameras with source = \"video\""});
}

std::string lens_json(const std::string& name, const LensResult& lens, const std::string& rest) {
  const auto& [k1, k2, p1, p2, k3] = lens.intrinsics.distortion;
  return fmt::format(R"({{"name":{},"focal_px":[{},{}],"focal_sigma_px":{},"centre_px":[{},{}],)"
                     R"("distortion":[{},{},{},{},{}],"views":{},"rms_px":{},"coverage":{},{}}})"
                     "\n",
                     json_text(name), lens.intrinsics.fx_px, lens.intrinsics.fy_px,
                     lens.focal_sigma_px, lens.intrinsics.cx_px, lens.intrinsics.cy_px, k1, k2, p1,
                     p2, k3, lens.views, lens.rms_px, lens.coverage.share(), rest);
}

/// What it replaces may have been better, and the camera's place may hold for that alone.
std::vector<std::string> remarks_on_before(const CameraConfig& camera, const LensResult& lens) {
  std::vector<std::string> remarks;
  if (!camera.calibration) return remarks;
  const CalibrationNote& before = *camera.calibration;
  if (before.focal_sigma_px > 0 && before.focal_sigma_px < lens.focal_sigma_px)
    remarks.push_back(fmt::format(
        "{}: its focal length was known better, {:.1f} px to {:.1f} px (by {}, {})", camera.name,
        camera.intrinsics.fx_px, before.focal_sigma_px, before.method, before.date));
  if (before.position_sigma_mm > 0)
    remarks.push_back(camera.name +
                      ": stands where it was found with another lens: find its place again, "
                      "by vindu calibrate wand, wall or extrinsics");
  return remarks;
}

void tell(const CameraConfig& camera, const LensResult& lens, const Intrinsics* truth, bool json) {
  const auto remarks = remarks_on_before(camera, lens);
  if (json) {
    const std::string known =
        truth ? fmt::format(R"({{"focal_px":[{},{}],"centre_px":[{},{}],"k1":{}}})", truth->fx_px,
                            truth->fy_px, truth->cx_px, truth->cy_px, truth->distortion[0])
              : "";
    fmt::print("{}", lens_json(camera.name, lens, end_of_json(remarks, known)));
    return;
  }
  fmt::print("{}", lens_line(camera.name, lens));
  if (truth)
    fmt::print("the truth: focal length {:.1f} px, centre {:.1f}, {:.1f} px, k1 {:.3f}\n",
               truth->fx_px, truth->cx_px, truth->cy_px, truth->distortion[0]);
  print_warnings(remarks);
}

int intrinsics(const RigCommand& command) {
  const Grid grid = grid_of(command);
  const Site site = load_site(command.common.wall_file);
  const std::size_t camera = command.camera.empty() ? 0 : camera_named(command.camera, site);
  expect_room_for(grid, site.cameras.at(camera));
  const CaptureWish wish{
      .name = "intrinsics",
      .seconds = command.lens.views * command.lens.interval_s + 5,
      .request = "Move the rig about before the camera, tilted all ways, into all corners",
      .body =
          [&](const Site& truth) {
            return waved_rig(truth.cameras.at(camera), grid, command.common.seed);
          },
      .progress = {.of_camera = [&](const Capture& so_far, std::size_t other) -> std::string {
        if (other != camera) return "";
        return covered_so_far(so_far, camera, site);
      }}};
  return calibrate(command.common, site, wish, [&](const Calibrating& run) {
    const CameraConfig& of_site = run.site.cameras[camera];
    const LensResult lens =
        calibrate_lens(run.capture, run.site.cameras, camera, grid, command.lens);
    tell(of_site, lens, run.truth ? &run.truth->cameras[camera].intrinsics : nullptr,
         command.common.json);
    draw(command.common, {covered_panel(of_site.name, lens.coverage)});
    CameraCalibration found;
    found.camera = of_site.name;
    found.intrinsics = lens.intrinsics;
    found.note = {"intrinsics", date_now(), run.recording, lens.rms_px, lens.focal_sigma_px, 0, 0};
    write(command.common, {found});
  });
}

Rigid3 room_from_rig(const RigCommand& command, const Site& site) {
  Vec3 place(0, 1.5, 1.5);
  if (command.rig_in_room)
    place = *command.rig_in_room;
  else if (!all_emulated(site))
    throw Error({"its place is not known", "rig", "measure it and say --rig-at x,y,z (room)"});
  return {Quat(Eigen::AngleAxisd(radians(command.rig_heading_deg), Vec3::UnitY())), place};
}

/// How well the focal length is known: as calibrated, else as cameras of its kind differ.
double focal_sigma_px(const CameraConfig& camera) {
  if (camera.calibration && camera.calibration->focal_sigma_px > 0)
    return camera.calibration->focal_sigma_px;
  return lens_prior(camera).sigma[0];
}

/// With what a focal length that is wrong makes of the distance to the rig.
double place_sigma_mm(const PlaceResult& place, const Rigid3& rig, const CameraConfig& camera) {
  const double distance_mm = 1e3 * (place.room_from_camera.translation - rig.translation).norm();
  return std::hypot(place.position_sigma_mm,
                    distance_mm * focal_sigma_px(camera) / camera.intrinsics.fx_px);
}

/// Nobody measures that wrong: more likely the rig or the cameras are not where they were said to
/// be. The place may be right all the same, so it is kept.
std::vector<std::string> remarks_on_place(const CameraConfig& camera, const PlaceResult& place) {
  constexpr double kFar_m = 1;
  constexpr double kTurned_deg = 30;
  const Rigid3 off = inverse(camera.room_from_camera) * place.room_from_camera;
  const double away_m = off.translation.norm();
  const double turned_deg = degrees(Eigen::AngleAxisd(off.rotation).angle());
  if (away_m < kFar_m && turned_deg < kTurned_deg) return {};
  return {fmt::format(
      "{}: was found {:.1f} m from where {} has it, turned by {:.0f} degrees: "
      "check --rig-at, --rig-heading-deg and --spacing-mm, that no two "
      "cameras are exchanged, and the camera's position_m",
      camera.name, away_m, camera.calibration ? "its calibration" : "the wall file", turned_deg)};
}

void tell(const CameraConfig& camera, const PlaceResult& place, double sigma_mm,
          const CameraConfig* truth, bool json) {
  const Vec3& at = place.room_from_camera.translation;
  const auto remarks = remarks_on_place(camera, place);
  const Vec3 true_at = truth ? truth->room_from_camera.translation : Vec3::Zero();
  const double off_mm = 1e3 * (true_at - at).norm();
  if (json) {
    const std::string known = truth ? fmt::format(R"({{"position_m":{},"position_off_mm":{}}})",
                                                  json_vec(true_at), off_mm)
                                    : "";
    fmt::print(R"({{"name":{},"position_m":{},"position_sigma_mm":{},"rms_px":{},{}}})"
               "\n",
               json_text(camera.name), json_vec(at), sigma_mm, place.rms_px,
               end_of_json(remarks, known));
    return;
  }
  fmt::print("{}: at {:.3f} {:.3f} {:.3f} m in room, to {:.0f} mm; rms {:.2f} px of {} pictures\n",
             camera.name, at.x(), at.y(), at.z(), sigma_mm, place.rms_px, place.pictures);
  if (truth)
    fmt::print("  the truth: {:.3f} {:.3f} {:.3f} m, {:.0f} mm away\n", true_at.x(), true_at.y(),
               true_at.z(), off_mm);
  print_warnings(remarks);
}

/// The rig's LEDs by their numbers in the grid, from 1.
CoveragePanel panel_of(const CameraConfig& camera, const PlaceResult& place) {
  constexpr double kDot_px = 5;
  CoveragePanel panel{.title = fmt::format("{}: rms {:.2f} px", camera.name, place.rms_px),
                      .size_px = picture_size_px(camera)};
  for (const Vec2& dot : place.dots_px)
    panel.marks.push_back({dot, kDot_px, std::to_string(panel.marks.size() + 1)});
  return panel;
}

void find_places(const RigCommand& command, const Grid& grid, const Rigid3& rig,
                 const Calibrating& run) {
  std::vector<CameraCalibration> found;
  std::vector<CoveragePanel> panels;
  for (std::size_t i = 0; i < run.site.cameras.size(); ++i) {
    const CameraConfig& camera = run.site.cameras[i];
    if (!command.camera.empty() && camera.name != command.camera) continue;
    const PlaceResult place = calibrate_place(run.capture, run.site.cameras, i, grid, rig);
    const double sigma_mm = place_sigma_mm(place, rig, camera);
    tell(camera, place, sigma_mm, run.truth ? &run.truth->cameras[i] : nullptr,
         command.common.json);
    panels.push_back(panel_of(camera, place));
    panels.back().coverage = coverage_so_far(run.capture, i, run.site);
    CameraCalibration of_camera;
    of_camera.camera = camera.name;
    of_camera.room_from_camera = place.room_from_camera;
    of_camera.note = {"extrinsics", date_now(), run.recording, place.rms_px, focal_sigma_px(camera),
                      sigma_mm,     0};
    found.push_back(std::move(of_camera));
  }
  draw(command.common, panels);
  write(command.common, found);
}

int extrinsics(const RigCommand& command) {
  const Grid grid = grid_of(command);
  const Site site = load_site(command.common.wall_file);
  for (const CameraConfig& camera : site.cameras)
    if (command.camera.empty() || camera.name == command.camera) expect_room_for(grid, camera);
  const Rigid3 rig = room_from_rig(command, site);
  const CaptureWish wish{.name = "extrinsics",
                         .seconds = 3,
                         .request = "Put the rig at its place, its LEDs towards the cameras",
                         .body = [&](const Site&) {
                           return bare_leds(grid.leds_in_rig(),
                                            [pose = rig](Time) { return pose; });
                         }};
  return calibrate(command.common, site, wish,
                   [&](const Calibrating& run) { find_places(command, grid, rig, run); });
}

void add_rig_options(CLI::App& app, RigCommand& command) {
  add_calibrate_options(app, command.common);
  app.add_option("--grid", command.grid, "LEDs across and up, 2 to 4 each (default: 2,2)")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(2, 4))
      ->type_name("N,M");
  app.add_option("--spacing-mm", command.spacing_mm,
                 "From LED to LED, across and up (default: 91.44, the thesis' rig)")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(between(5.0, 5000.0))
      ->type_name("A[,B]");
}

}  // namespace

void add_calibrate_intrinsics(CLI::App& calibrate, Action& chosen) {
  auto command = std::make_shared<RigCommand>();
  CLI::App* app = calibrate.add_subcommand(
      "intrinsics", "One camera's lens, from views of a rig of LEDs in a grid");
  add_rig_options(*app, *command);
  app->add_option("--camera", command->camera, "Its name (default: the wall file's first)");
  app->add_option("--views", command->lens.views, "Default: 30")->check(CLI::Range(10, 300));
  app->add_option("--interval-s", command->lens.interval_s, "Between views (default: 0.5)")
      ->check(between(0.05, 60.0));
  add_picture_option(*app, command->common, "What the camera has seen of its view");
  app->footer(
      "\nExamples:\n"
      "  vindu calibrate intrinsics --wall wall.toml --camera left\n"
      "  vindu calibrate intrinsics --wall wall.toml --camera webcam --grid 4,3 --spacing-mm 60\n");
  app->callback([command, &chosen] { chosen = [command] { return intrinsics(*command); }; });
}

void add_calibrate_extrinsics(CLI::App& calibrate, Action& chosen) {
  auto command = std::make_shared<RigCommand>();
  CLI::App* app = calibrate.add_subcommand(
      "extrinsics", "Where cameras stand, from a rig of LEDs that stands at a known place");
  add_rig_options(*app, *command);
  app->add_option("--camera", command->camera, "Only this one (default: all)");
  add_picture_option(*app, command->common, "Where in its view each camera sees the rig's LEDs");
  add_vec3(*app, "--rig-at", command->rig_in_room, "The rig's middle in room, metres");
  app->add_option("--rig-heading-deg", command->rig_heading_deg,
                  "Its turn about the vertical; 0: its LEDs face away from the wall")
      ->check(between(-360.0, 360.0));
  app->footer(
      "\nExamples:\n"
      "  vindu calibrate extrinsics --wall wall.toml --rig-at 0,1.5,1.5 --spacing-mm 300\n"
      "  vindu calibrate extrinsics --wall wall.toml --camera left --rig-heading-deg 20\n");
  app->callback([command, &chosen] { chosen = [command] { return extrinsics(*command); }; });
}

}  // namespace vindu::app
