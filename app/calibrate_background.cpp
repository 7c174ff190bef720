// vindu calibrate background: where lamps, windows and reflections stand in each camera's picture
// while no helmet is in the room, so that they are never taken for LEDs.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "app/calibrate.h"
#include "app/common.h"
#include "core/error.h"
#include "tracker/joint/static_dots.h"

namespace vindu::app {
namespace {

/// Emulated: two lamps beside the wall.
LedBody lamps(const Site& site) {
  const double half_m = 0.4 * site.wall.grid.width_m;
  return bare_leds({{-half_m, 0.5, 0.2}, {half_m, -0.6, 0.2}},
                   [room_from_wall = site.wall.room_from_wall](Time) { return room_from_wall; });
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

int learn(const CalibrateOptions& options) {
  const Calibrating run = capture(
      options,
      {.name = "background",
       .seconds = 5,
       .request = "Hide the helmet and leave the room as it will be; some seconds are enough",
       .body = lamps,
       .progress =
           [](const Capture& so_far) {
             return fmt::format("{} pictures", so_far.observations.size());
           },
       .known_cameras = true});
  std::vector<CameraCalibration> found;
  for (std::size_t i = 0; i < run.site.cameras.size(); ++i) {
    CameraCalibration camera;
    camera.camera = run.site.cameras[i].name;
    camera.masks_px = still_dots(run.capture, i, camera.camera);
    camera.note.method = "background";
    camera.note.date = date_now();
    camera.note.recording = run.recording;
    std::string places;
    for (const Vec2& mask : *camera.masks_px)
      places += fmt::format("{}[{:.0f},{:.0f}]", places.empty() ? "" : ",", mask.x(), mask.y());
    if (options.json)
      fmt::print(R"({{"camera":{},"masks_px":[{}]}})"
                 "\n",
                 json_text(camera.camera), places);
    else
      fmt::print("{}: {} masked {}\n", camera.camera, camera.masks_px->size(), places);
    found.push_back(std::move(camera));
  }
  write(options, run, found);
  return 0;
}

}  // namespace

void add_calibrate_background(CLI::App& calibrate, Action& chosen) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* app = calibrate.add_subcommand(
      "background", "Which bright spots are no LEDs: with the helmet hidden");
  add_calibrate_options(*app, *options);
  app->footer(
      "\nExamples:\n"
      "  vindu calibrate background --wall wall.toml --seconds 5\n");
  app->callback([options, &chosen] { chosen = [options] { return learn(*options); }; });
}

}  // namespace vindu::app
