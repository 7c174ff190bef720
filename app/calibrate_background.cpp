// vindu calibrate background: where lamps, windows and reflections stand in each camera's picture
// while no helmet is in the room, so that they are never taken for LEDs.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/calibrate.h"
#include "app/common.h"
#include "core/error.h"
#include "tracker/camera_model.h"
#include "tracker/joint/static_dots.h"

namespace vindu::app {
namespace {

/// Emulated: two lamps beside the wall.
std::vector<Vec3> lamps_in_wall(const Site& site) {
  const double half_m = 0.4 * site.wall.grid.width_m;
  return {{-half_m, 0.5, 0.2}, {half_m, -0.6, 0.2}};
}

LedBody lamps(const Site& site) {
  return bare_leds(lamps_in_wall(site),
                   [room_from_wall = site.wall.room_from_wall](Time) { return room_from_wall; });
}

/// Raw places of the lamps in an emulated camera's picture.
std::vector<Vec2> lamps_px(const Site& site, const CameraConfig& camera) {
  const CameraModel model(camera);
  const Vec2 size_px = picture_size_px(camera);
  std::vector<Vec2> seen;
  for (const Vec3& lamp : lamps_in_wall(site)) {
    const auto raw_px = model.project(model.camera_from_room() * (site.wall.room_from_wall * lamp));
    if (raw_px && raw_px->minCoeff() >= 0 && (size_px - *raw_px).minCoeff() > 0)
      seen.push_back(*raw_px);
  }
  return seen;
}

/// The largest distance of one of the lamps from the mask that is nearest to it, and how many have
/// none within a mask's radius; and of masks that hide no lamp.
struct MaskTruth {
  std::vector<Vec2> lamps_px;
  double off_px = 0;
  int missed = 0;
  int needless = 0;
};

MaskTruth compare(const std::vector<Vec2>& masks_px, std::vector<Vec2> lamps_px) {
  const double radius_px = StaticDotsOptions{}.mask_px;
  const auto nearest_px = [](const Vec2& place, const std::vector<Vec2>& others) {
    double least_px = 1e9;
    for (const Vec2& other : others) least_px = std::min(least_px, (other - place).norm());
    return least_px;
  };
  MaskTruth truth;
  for (const Vec2& lamp : lamps_px) {
    const double off_px = nearest_px(lamp, masks_px);
    if (off_px > radius_px)
      ++truth.missed;
    else
      truth.off_px = std::max(truth.off_px, off_px);
  }
  for (const Vec2& mask : masks_px) truth.needless += nearest_px(mask, lamps_px) > radius_px;
  truth.lamps_px = std::move(lamps_px);
  return truth;
}

template <class Take>
void for_each_dot(const Capture& capture, std::size_t camera, Take take) {
  for (const Observation& seen : capture.observations)
    if (static_cast<std::size_t>(seen.camera) == camera)
      for (const Dot& dot : seen.dots) take(Vec2(dot.x_px, dot.y_px), seen.arrival);
}

/// What stood still for a second or more. Throws Error where much else was seen: somebody wears a
/// helmet, and stood still now and then.
std::vector<Vec2> still_dots(const Capture& capture, std::size_t camera, const std::string& name) {
  constexpr double kMostMoving = 0.05;
  StaticDots dots({.masked_after = std::chrono::seconds(1)});
  for_each_dot(capture, camera, [&](const Vec2& raw_px, Time at) { dots.watch(raw_px, at); });
  double all = 0, moving = 0;
  for_each_dot(capture, camera, [&](const Vec2& raw_px, Time) {
    ++all;
    moving += !dots.masked(raw_px);
  });
  if (moving > kMostMoving * all)
    throw Error({fmt::format("{:.0f} % of its dots move", 100 * moving / all), name,
                 "hide the helmet, and let nobody carry a light about"});
  return dots.masks_px();
}

std::string list_of(const std::vector<Vec2>& places_px) {
  std::string list;
  for (const Vec2& place : places_px)
    list += fmt::format("{}[{:.0f},{:.0f}]", list.empty() ? "" : ",", place.x(), place.y());
  return list;
}

std::string truth_json(const MaskTruth& truth) {
  return fmt::format(R"({{"lamps_px":[{}],"off_px":{:.1f},"missed":{},"needless":{}}})",
                     list_of(truth.lamps_px), truth.off_px, truth.missed, truth.needless);
}

void tell(const std::string& camera, const std::vector<Vec2>& masks_px,
          const std::optional<MaskTruth>& truth, bool json) {
  if (json) {
    fmt::print(R"({{"camera":{},"masks_px":[{}],{}}})"
               "\n",
               json_text(camera), list_of(masks_px),
               end_of_json({}, truth ? truth_json(*truth) : ""));
    return;
  }
  fmt::print("{}: {} masked {}\n", camera, masks_px.size(), list_of(masks_px));
  if (truth)
    fmt::print(
        "  the truth: {} in view {}, {} missed, the others at most {:.1f} px off; {} masked "
        "in vain\n",
        truth->lamps_px.size() == 1 ? "1 lamp" : fmt::format("{} lamps", truth->lamps_px.size()),
        list_of(truth->lamps_px), truth->missed, truth->off_px, truth->needless);
}

/// Each mask as large as it is.
CoveragePanel panel_of(const CameraConfig& camera, const std::vector<Vec2>& masks_px) {
  CoveragePanel panel{.title = fmt::format("{}: {} masked", camera.name, masks_px.size()),
                      .size_px = picture_size_px(camera)};
  for (const Vec2& mask : masks_px)
    panel.marks.push_back({image_from_raw(camera.source, mask), StaticDotsOptions{}.mask_px,
                           fmt::format("{:.0f},{:.0f}", mask.x(), mask.y())});
  return panel;
}

void find_masks(const CalibrateOptions& options, const Calibrating& run) {
  std::vector<CameraCalibration> found;
  std::vector<CoveragePanel> panels;
  for (std::size_t i = 0; i < run.site.cameras.size(); ++i) {
    CameraCalibration camera;
    camera.camera = run.site.cameras[i].name;
    camera.masks_px = still_dots(run.capture, i, camera.camera);
    camera.note.method = "background";
    camera.note.date = date_now();
    camera.note.recording = run.recording;
    std::optional<MaskTruth> truth;
    if (run.truth) truth = compare(*camera.masks_px, lamps_px(run.site, run.truth->cameras[i]));
    tell(camera.camera, *camera.masks_px, truth, options.json);
    panels.push_back(panel_of(run.site.cameras[i], *camera.masks_px));
    panels.back().coverage = coverage_so_far(run.capture, i, run.site);
    found.push_back(std::move(camera));
  }
  draw(options, panels);
  write(options, found);
}

int learn(const CalibrateOptions& options) {
  return calibrate(
      options, load_site(options.wall_file),
      {.name = "background",
       .seconds = 5,
       .request = "Hide the helmet and leave the room as it will be; some seconds are enough",
       .body = lamps,
       .known_cameras = true},
      [&](const Calibrating& run) { find_masks(options, run); });
}

}  // namespace

void add_calibrate_background(CLI::App& calibrate, Action& chosen) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* app = calibrate.add_subcommand(
      "background", "Which bright spots are no LEDs: with the helmet hidden");
  add_calibrate_options(*app, *options);
  add_picture_option(*app, *options, "What is masked in each camera's view");
  app->footer(
      "\nExamples:\n"
      "  vindu calibrate background --wall wall.toml --seconds 5\n");
  app->callback([options, &chosen] { chosen = [options] { return learn(*options); }; });
}

}  // namespace vindu::app
