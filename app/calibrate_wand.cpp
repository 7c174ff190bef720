// vindu calibrate wand: all cameras at once, from a waved wand.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/calibrate.h"
#include "app/common.h"
#include "core/error.h"

namespace vindu::app {
namespace {

struct WandCommand {
  CalibrateOptions common;
  std::vector<double> leds_mm = {0, 150, 500};
  int poses = 1000;
  bool ignore_places = false;
};

WandOptions wand_options(const WandCommand& command) {
  WandOptions options;
  options.leds_m.clear();
  for (const double led_mm : command.leds_mm) options.leds_m.push_back(1e-3 * led_mm);
  options.max_poses = command.poses;
  options.trust_wall_file = !command.ignore_places;
  return options;
}

/// Waved about where the cameras look, in the middle of what they see.
LedBody emulated_wand(const std::vector<double>& leds_m, const Site& truth, std::uint64_t seed) {
  Vec3 middle = Vec3::Zero();
  for (const CameraConfig& camera : truth.cameras)
    middle += camera.room_from_camera * Vec3(0, 0, 3.0) / static_cast<double>(truth.cameras.size());
  std::vector<Vec3> leds;
  for (const double along_m : leds_m) leds.emplace_back(along_m - 0.5 * leds_m.back(), 0, 0);
  WaveOptions wave;
  wave.seed = seed;
  wave.room_from_rest.translation = middle;
  wave.reach_m = {0.9, 0.7, 0.7};
  return bare_leds(leds, waved(wave));
}

/// The same place, seen from the first camera: all that a wand can know.
Rigid3 from_first(const Rigid3& first, const Rigid3& camera) { return inverse(first) * camera; }

std::string table_of(const WandResult& result) {
  std::string text =
      fmt::format("{:<12}{:>16}{:>17}{:>16}{:>25}{:>10}{:>12}{:>12}{:>8}\n", "camera", "focal px",
                  "centre px", "k1", "place in room m", "to mm", "lag ms", "rms/held px", "covers");
  for (const WandCamera& camera : result.cameras) {
    const Vec3& place = camera.room_from_camera.translation;
    text += fmt::format(
        "{:<12}{:>8.1f} +- {:<4.1f}{:>8.1f} {:>8.1f}{:>8.3f} +- {:<4.3f}{:>9.3f}{:>8.3f}{:>8.3f}"
        "{:>10.1f}{:>6.1f} +- {:<3.1f}{:>6.2f}/{:<5.2f}{:>6.0f} %\n",
        camera.name, camera.intrinsics.fx_px, camera.focal_sigma_px, camera.intrinsics.cx_px,
        camera.intrinsics.cy_px, camera.intrinsics.distortion[0], camera.k1_sigma, place.x(),
        place.y(), place.z(), camera.position_sigma_mm.norm(), camera.lag_ms, camera.lag_sigma_ms,
        camera.rms_px, camera.held_out_px, 100 * camera.coverage.share());
  }
  text += fmt::format(
      "{} poses of the wand; its length is {:+.2f} mm off, {:.2f} mm rms where the dots' noise "
      "makes "
      "{:.2f} (held-out poses); {:.1f} % of the dots left out\n",
      result.poses, result.length_mean_mm, result.length_rms_mm, result.predicted_length_rms_mm,
      100 * result.outliers);
  if (!result.level) text += "No accelerometer at rest: not levelled.\n";
  return text;
}

/// What is true of one camera, as a wand can know it, and how far off what was found is.
struct WandTruth {
  const CameraConfig& camera;
  double lag_ms = 0;  ///< of the first camera
  double off_mm = 0;
  double turned_deg = 0;
};

/// Against the first camera, whose own place and lag the wall file says.
WandTruth truth_of(const WandResult& result, const HiddenTruth& truth, std::size_t camera) {
  const Rigid3 off =
      inverse(
          from_first(truth.cameras[0].room_from_camera, truth.cameras[camera].room_from_camera)) *
      from_first(result.cameras[0].room_from_camera, result.cameras[camera].room_from_camera);
  return {.camera = truth.cameras[camera],
          .lag_ms = truth.cameras[0].lag_ms + milliseconds(truth.late[camera] - truth.late[0]),
          .off_mm = 1e3 * off.translation.norm(),
          .turned_deg = degrees(Eigen::AngleAxisd(off.rotation).angle())};
}

/// Thesis 3.4.2: in virtual mode what was found stands beside what is true.
std::string truth_table(const WandResult& result, const HiddenTruth& truth) {
  std::string text = fmt::format("\n{:<12}{:>22}{:>18}{:>18}{:>22}{:>14}{:>16}\n", "the truth",
                                 "focal px (found)", "centre px off", "k1 (found)",
                                 "place off mm (sigma)", "turned deg", "lag ms (found)");
  for (std::size_t i = 0; i < result.cameras.size(); ++i) {
    const WandCamera& found = result.cameras[i];
    const WandTruth known = truth_of(result, truth, i);
    const Intrinsics& lens = known.camera.intrinsics;
    text += fmt::format(
        "{:<12}{:>13.1f} ({:.1f}){:>10.1f} {:>7.1f}{:>9.3f} ({:>6.3f}){:>16.1f} "
        "({:.1f}){:>14.3f}{:>9.1f} ({:.1f})\n",
        found.name, lens.fx_px, found.intrinsics.fx_px, found.intrinsics.cx_px - lens.cx_px,
        found.intrinsics.cy_px - lens.cy_px, lens.distortion[0], found.intrinsics.distortion[0],
        known.off_mm, found.position_sigma_mm.norm(), known.turned_deg, known.lag_ms, found.lag_ms);
  }
  return text +
         "Places, turns and lags are against the first camera, whose own the wall file says.\n";
}

std::string truth_json(const WandResult& result, const HiddenTruth& truth) {
  std::string cameras;
  for (std::size_t i = 0; i < result.cameras.size(); ++i) {
    const WandTruth known = truth_of(result, truth, i);
    const Intrinsics& lens = known.camera.intrinsics;
    cameras +=
        (cameras.empty() ? "" : ",") +
        fmt::format(R"({{"name":{},"focal_px":[{},{}],"centre_px":[{},{}],"k1":{},)"
                    R"("lag_ms":{},"position_off_mm":{},"turned_deg":{}}})",
                    json_text(known.camera.name), lens.fx_px, lens.fy_px, lens.cx_px, lens.cy_px,
                    lens.distortion[0], known.lag_ms, known.off_mm, known.turned_deg);
  }
  return "[" + cameras + "]";
}

std::string wand_json(const WandResult& result, const std::string& truth) {
  std::string cameras;
  for (const WandCamera& camera : result.cameras) {
    const auto& [k1, k2, p1, p2, k3] = camera.intrinsics.distortion;
    const Vec3& place = camera.room_from_camera.translation;
    const Quat& turn = camera.room_from_camera.rotation;
    cameras +=
        (cameras.empty() ? "" : ",") +
        fmt::format(R"({{"name":{},"focal_px":[{},{}],"focal_sigma_px":{},"centre_px":[{},{}],)"
                    R"("distortion":[{},{},{},{},{}],"position_m":[{},{},{}],)"
                    R"("position_sigma_mm":[{},{},{}],"rotation_xyzw":[{},{},{},{}],)"
                    R"("rotation_sigma_deg":{},"lag_ms":{},"lag_sigma_ms":{},"rms_px":{},)"
                    R"("held_out_px":{},"views":{},"coverage":{}}})",
                    json_text(camera.name), camera.intrinsics.fx_px, camera.intrinsics.fy_px,
                    camera.focal_sigma_px, camera.intrinsics.cx_px, camera.intrinsics.cy_px, k1, k2,
                    p1, p2, k3, place.x(), place.y(), place.z(), camera.position_sigma_mm.x(),
                    camera.position_sigma_mm.y(), camera.position_sigma_mm.z(), turn.x(), turn.y(),
                    turn.z(), turn.w(), camera.rotation_sigma_deg, camera.lag_ms,
                    camera.lag_sigma_ms, camera.rms_px, camera.held_out_px, camera.views,
                    camera.coverage.share());
  }
  return fmt::format(
      R"({{"cameras":[{}],"poses":{},"outliers":{},"length_mean_mm":{},"length_rms_mm":{},)"
      R"("predicted_length_rms_mm":{},"level":{},{}}})"
      "\n",
      cameras, result.poses, result.outliers, result.length_mean_mm, result.length_rms_mm,
      result.predicted_length_rms_mm, result.level, end_of_json(result.remarks, truth));
}

std::vector<CameraCalibration> calibrations_of(const WandResult& result,
                                               const std::string& recording) {
  std::vector<CameraCalibration> found;
  for (const WandCamera& camera : result.cameras)
    found.push_back({.camera = camera.name,
                     .intrinsics = camera.intrinsics,
                     .room_from_camera = camera.room_from_camera,
                     .lag_ms = camera.lag_ms,
                     .note = {.method = "wand",
                              .date = date_now(),
                              .recording = recording,
                              .rms_px = camera.rms_px,
                              .focal_sigma_px = camera.focal_sigma_px,
                              .position_sigma_mm = camera.position_sigma_mm.norm(),
                              .rotation_sigma_deg = camera.rotation_sigma_deg}});
  return found;
}

std::vector<CoveragePanel> panels_of(const WandResult& result) {
  std::vector<CoveragePanel> panels;
  for (const WandCamera& camera : result.cameras)
    panels.push_back(covered_panel(camera.name, camera.coverage));
  return panels;
}

void tell(const WandResult& result, const std::optional<HiddenTruth>& truth, bool json) {
  if (json) {
    fmt::print("{}", wand_json(result, truth ? truth_json(result, *truth) : ""));
    return;
  }
  fmt::print("{}", table_of(result));
  print_warnings(result.remarks);
  if (truth) fmt::print("{}", truth_table(result, *truth));
}

int wand(const WandCommand& command) {
  const WandOptions options = wand_options(command);
  const Site site = load_site(command.common.wall_file);
  const CaptureWish wish{
      .name = "wand",
      .seconds = 60,
      .request = "Wave the wand through all that the cameras see, near and far, turned all ways",
      .body =
          [&](const Site& truth) {
            return emulated_wand(options.leds_m, truth, command.common.seed);
          },
      .progress = {.of_camera = [&](const Capture& so_far, std::size_t camera) {
        return covered_so_far(so_far, camera, site);
      }}};
  return calibrate(command.common, site, wish, [&](const Calibrating& run) {
    const WandResult result = calibrate_wand(run.capture, run.site.cameras, options);
    tell(result, run.truth, command.common.json);
    draw(command.common, panels_of(result));
    write(command.common, calibrations_of(result, run.recording));
  });
}

}  // namespace

void add_calibrate_wand(CLI::App& calibrate, Action& chosen) {
  auto command = std::make_shared<WandCommand>();
  CLI::App* app = calibrate.add_subcommand(
      "wand", "Places, lenses and lags of all cameras, from a waved wand with two or three LEDs");
  add_calibrate_options(*app, command->common);
  app->add_option("--leds-mm", command->leds_mm,
                  "Places of the LEDs along the wand, from the first on (default: 0,150,500)")
      ->delimiter(',')
      ->expected(2, 3)
      ->type_name("0,A[,B]");
  app->add_option("--poses", command->poses, "At most so many are used (default: 1000)")
      ->check(CLI::Range(60, 20000));
  app->add_flag("--ignore-places", command->ignore_places,
                "The cameras' places in the wall file are guesses: any size is believed");
  add_picture_option(*app, command->common, "What each camera has seen of its view");
  app->footer(
      "\nExamples:\n"
      "  vindu calibrate wand --wall wall.toml --leds-mm 0,150,500 --picture seen.png\n"
      "  vindu record --wall wall.toml --out wave.vrec\n"
      "  vindu calibrate wand --wall wall.toml --from wave.vrec\n");
  app->callback([command, &chosen] { chosen = [command] { return wand(*command); }; });
}

}  // namespace vindu::app
