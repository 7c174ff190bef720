// vindu calibrate wall: ties the cameras to the wall by points of it that somebody touches with an
// LED.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/calibrate.h"
#include "app/common.h"
#include "app/touch_screen.h"
#include "app/touch_wall.h"
#include "app/wiimote_findings.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/surface.h"
#include "tracker/calibration/wall_touch.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {
namespace {

struct WallCommand {
  CalibrateOptions common;
  int targets = 5;
  std::string draw;  ///< folder
};

LedBody touching_led(const std::vector<WallTarget>& targets, const Rigid3& room_from_wall) {
  std::vector<Vec3> points_in_room;
  for (const WallTarget& target : targets)
    points_in_room.push_back(room_from_wall * target.x_in_wall);
  return touching(std::move(points_in_room));
}

std::string progress_text(const TouchProgress& progress, const std::vector<WallTarget>& targets) {
  const std::size_t done = progress.touches.size();
  if (done >= targets.size()) return "all points are touched";
  const std::string request =
      fmt::format("{} of {}: hold the LED to the {}", done + 1, targets.size(), targets[done].name);
  return progress.remark.empty() ? request : request + " (" + progress.remark + ")";
}

TouchPage first_page(const Site& site, const std::vector<WallTarget>& targets) {
  constexpr double kRingShare = 0.16;  // of the least side of any tile
  TouchPage page;
  for (const WallTarget& target : targets) page.points.push_back({target.x_in_wall, target.tile});
  double least_m = 1e300;
  for (const Tile& tile : site.wall.tiles)
    least_m = std::min({least_m, tile.corners.width_m(), tile.corners.height_m()});
  page.ring_m = kRingShare * least_m;
  return page;
}

/// The tiles of the wall where it runs. A wall that cannot be used ends nothing.
ShowPage show_on_wall(const Site& site, const TouchPage& first) {
  try {
    ShowPage tiles = page_on_running_wall(site, first);
    if (tiles) log_info("wall", "it runs: its tiles show the points");
    return tiles;
  } catch (const Error& error) {
    log_warning("wall", std::string(error.what()) + " (its tiles do not show the points)");
    return {};
  }
}

/// A window where there is a display. One that cannot be used ends nothing: the terminal says it
/// all, too.
ShowPage show_in_window(const Wall& wall) {
  if (!has_display()) return {};
  try {
    ShowPage window = page_window(wall);
    if (wall.tiles.size() > 1)
      log_info("wall", "the window shows all tiles together, small: touch the wall's own corners");
    return window;
  } catch (const Error& error) {
    log_warning("wall", std::string(error.what()) + " (the points are named here)");
    return {};
  }
}

/// Pictures where asked for; else, where somebody touches points now, the wall itself, or a window.
ShowPage choose_show(const WallCommand& command, const Site& site, const TouchPage& first) {
  if (!command.draw.empty()) return page_folder(site.wall, command.draw);
  ShowPage show;
  if (command.common.from.empty()) show = show_on_wall(site, first);
  if (!show && command.common.from.empty()) show = show_in_window(site.wall);
  return show ? show : [](const TouchPage&) { return true; };
}

/// A running wall may read the very cameras.
void warn_of_other_readers(const WallCommand& command, const Site& site) {
  const bool live = std::ranges::any_of(site.cameras, [](const CameraConfig& camera) {
    return camera.source == CameraSource::wiimote;
  });
  if (!live || !command.common.from.empty()) return;
  MonotonicClock clock;
  for (const std::string& line : wiimotes_in_use(*make_hidapi_bus(clock), site))
    log_warning("wall", line +
                            ": they disturb each other; end it, or begin the wall by vindu "
                            "launch --mode loop");
}

/// Follows who touches the targets, and shows the page.
class Touching {
 public:
  Touching(const Site& site, std::vector<WallTarget> targets, TouchPage page, ShowPage show)
      : site_(site), targets_(std::move(targets)), page_(std::move(page)), show_(std::move(show)) {
    show_(page_);
  }

  const TouchProgress& progress() const { return progress_; }
  /// False when all are touched, or the window was closed.
  bool see(const Capture& so_far) {
    progress_ = follow_touches(so_far, site_.cameras, targets_);
    page_.done = progress_.touches.size();
    page_.held = progress_.held;
    page_.remark = progress_.remark;
    return show_(page_) && page_.done < targets_.size();
  }

 private:
  const Site& site_;
  std::vector<WallTarget> targets_;
  TouchPage page_;
  ShowPage show_;
  TouchProgress progress_;
};

void refuse_unfinished(const TouchProgress& progress, const std::vector<WallTarget>& targets) {
  if (progress.touches.size() >= targets.size() || progress.remark.empty()) return;
  throw Error({fmt::format("{} of {} points were touched; then: {}", progress.touches.size(),
                           targets.size(), progress.remark),
               "wall",
               "touch them in the order shown; where the cameras have no wand calibration, make "
               "one first"});
}

std::vector<std::string> remarks_on_scale(const WallFit& fit) {
  constexpr double kUsualScale = 0.02;
  if (std::abs(fit.scale - 1) <= kUsualScale) return {};
  return {"the cameras' scale is off: was the wand's length right?"};
}

/// How far one camera, as it was found, is from where it truly stands.
struct PlaceTruth {
  std::string camera;
  double off_mm = 0;
  double turned_deg = 0;
};

std::vector<PlaceTruth> truth_of(const std::vector<CameraCalibration>& found,
                                 const HiddenTruth& truth) {
  std::vector<PlaceTruth> all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Rigid3 off = inverse(truth.cameras[i].room_from_camera) * *found[i].room_from_camera;
    all.push_back({found[i].camera, 1e3 * off.translation.norm(),
                   degrees(Eigen::AngleAxisd(off.rotation).angle())});
  }
  return all;
}

void print(const std::vector<WallTarget>& targets, const WallFit& fit,
           const std::vector<PlaceTruth>& truth) {
  for (std::size_t i = 0; i < targets.size(); ++i)
    fmt::print("{:<36}{:>8.1f} mm off\n", targets[i].name, fit.residuals_mm[i]);
  fmt::print("rms {:.1f} mm; the wall is {:.2f} % {} than the cameras see it\n", fit.rms_mm,
             100 * std::abs(fit.scale - 1), fit.scale < 1 ? "smaller" : "larger");
  print_warnings(remarks_on_scale(fit));
  for (const PlaceTruth& known : truth)  // thesis 3.4.2: beside what was found
    fmt::print("the truth: {} is {:.1f} mm and {:.2f} degrees off\n", known.camera, known.off_mm,
               known.turned_deg);
}

void print_json(const WallFit& fit, const std::vector<std::string>& remarks,
                const std::vector<PlaceTruth>& truth) {
  std::string known;
  for (const PlaceTruth& of_camera : truth)
    known += fmt::format(R"({}{{"name":{},"position_off_mm":{},"turned_deg":{}}})",
                         known.empty() ? "" : ",", json_text(of_camera.camera), of_camera.off_mm,
                         of_camera.turned_deg);
  fmt::print(R"({{"rms_mm":{},"scale":{},"residuals_mm":[{}],{}}})"
             "\n",
             fit.rms_mm, fit.scale, fmt::join(fit.residuals_mm, ","),
             end_of_json(remarks, truth.empty() ? "" : "[" + known + "]"));
}

/// How the cameras stand to each other must be known: the points tell where they stand together.
void expect_placed_cameras(const Site& site) {
  if (std::ranges::none_of(site.cameras, [](const CameraConfig& camera) {
        return camera.calibration && camera.calibration->position_sigma_mm > 0;
      }))
    throw Error({"no camera's place is calibrated", "wall",
                 "make a wand calibration first: vindu calibrate wand"});
}

/// All cameras, moved as one.
std::vector<CameraCalibration> moved_cameras(const Site& site, const WallFit& fit) {
  std::vector<CameraCalibration> found;
  for (const CameraConfig& camera : site.cameras) {
    CameraCalibration moved;
    moved.camera = camera.name;
    moved.room_from_camera = fit.room_from_before * camera.room_from_camera;
    moved.note = camera.calibration.value_or(CalibrationNote{});
    moved.note.method += moved.note.method.empty() ? "wall" : " + wall";
    moved.note.date = date_now();
    moved.note.position_sigma_mm = std::hypot(moved.note.position_sigma_mm,
                                              fit.sigma_mm_at(moved.room_from_camera->translation));
    found.push_back(std::move(moved));
  }
  return found;
}

/// As many as asked for, or what there are with a remark. Throws Error for fewer than three.
std::vector<WallTarget> targets_of(const WallCommand& command, const Site& site,
                                   std::vector<std::string>& remarks) {
  auto targets = choose_targets(site, command.targets);
  if (targets.size() < 3)
    throw Error({fmt::format("two cameras see {} tile corners together", targets.size()), "wall",
                 "turn the cameras so that views of two overlap on the wall"});
  if (targets.size() < static_cast<std::size_t>(command.targets)) {
    remarks.push_back(fmt::format("two cameras see {} tile corners together, not {}",
                                  targets.size(), command.targets));
    fmt::print(stderr, "warning: {}\n", remarks.back());
  }
  fmt::print(stderr, "Hold the only LED still for two seconds at each, in this order:\n");
  for (const WallTarget& target : targets) fmt::print(stderr, "  {}\n", target.name);
  return targets;
}

int calibrate_wall(const WallCommand& command) {
  const Site site = load_site(command.common.wall_file);
  expect_placed_cameras(site);
  std::vector<std::string> remarks;
  const auto targets = targets_of(command, site, remarks);
  warn_of_other_readers(command, site);
  const TouchPage page = first_page(site, targets);
  Touching touching(site, targets, page, choose_show(command, site, page));
  const CaptureWish wish{
      .name = "wall",
      .seconds = 3.0 * static_cast<double>(targets.size()) + 1,
      .request = "Hold the LED to the first point",
      .body = [&](const Site& truth) { return touching_led(targets, truth.wall.room_from_wall); },
      .progress = {.of_all =
                       [&](const Capture&) { return progress_text(touching.progress(), targets); }},
      .watching = [&](const Capture& so_far) { return touching.see(so_far); }};
  return calibrate(command.common, site, wish, [&](const Calibrating& run) {
    touching.see(run.capture);
    refuse_unfinished(touching.progress(), targets);
    const WallFit fit =
        fit_wall(touching.progress().touches, targets, run.site.wall.room_from_wall);
    const auto found = moved_cameras(run.site, fit);
    const auto truth = run.truth ? truth_of(found, *run.truth) : std::vector<PlaceTruth>{};
    if (command.common.json) {
      for (std::string& remark : remarks_on_scale(fit)) remarks.push_back(std::move(remark));
      print_json(fit, remarks, truth);
    } else {
      print(targets, fit, truth);
    }
    write(command.common, found);
  });
}

}  // namespace

void add_calibrate_wall(CLI::App& calibrate, Action& chosen) {
  auto command = std::make_shared<WallCommand>();
  CLI::App* app = calibrate.add_subcommand(
      "wall", "Where the wall is for the cameras: hold an LED to corners of its tiles");
  add_calibrate_options(*app, command->common);
  app->add_option("--targets", command->targets, "So many corners (default: 5)")
      ->check(CLI::Range(3, static_cast<int>(kMostTouchPoints)));
  app->add_option("--draw", command->draw,
                  "Pictures of what the wall shows, instead of that: touch-N.png, wall-N.png")
      ->type_name("DIR");
  app->footer(
      "\nWhere a master of the wall runs, its tiles show the points; else a window does, or the\n"
      "terminal names them. The cameras are this command's: begin the wall by vindu launch --mode\n"
      "loop, which does not open them.\n"
      "\nExamples, after a wand calibration:\n"
      "  vindu calibrate wall --wall wall.toml\n"
      "  vindu calibrate wall --wall wall.toml --targets 8 --draw pictures\n");
  app->callback([command, &chosen] { chosen = [command] { return calibrate_wall(*command); }; });
}

}  // namespace vindu::app
