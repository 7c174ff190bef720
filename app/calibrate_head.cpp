// vindu calibrate head: where a helmet's LEDs sit, and the eye among them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/calibrate.h"
#include "app/cameras.h"
#include "app/common.h"
#include "app/site_remarks.h"
#include "core/error.h"
#include "tracker/calibration/head.h"
#include "tracker/camera_model.h"

namespace vindu::app {
namespace {

struct HeadCommand {
  CalibrateOptions common;
  std::string name;
  std::optional<int> leds;
  HeadOptions head;
  std::optional<Vec3> eye_in_wall;
};

/// Emulated: the wall file's helmet, its LEDs up to 8 mm off, on somebody who stands still for 3 s.
struct EmulatedWearer {
  HeadConfig head;
  Vec3 place_in_room;

  EmulatedWearer(const Site& site, const HeadConfig& known, std::uint64_t seed) : head(known) {
    Random random(seed);
    for (Vec3& led : head.leds_in_head)
      for (int axis = 0; axis < 3 && !led.isZero(); ++axis)
        led[axis] += random.uniform(-8e-3, 8e-3);
    place_in_room = site.wall.room_from_wall * site.viewer.default_eye_in_wall - head.eye_in_head;
  }

  LedBody body(std::uint64_t seed) const {
    WaveOptions wave;
    wave.seed = seed;
    wave.start = Time{std::chrono::seconds(3)};
    wave.room_from_rest.translation = place_in_room;
    wave.reach_m = {0.4, 0.1, 0.3};
    wave.turn_rad = {0.2, 0.4, 0.2};
    wave.tempo_hz = 0.1;
    const BodyMotion moving = waved(wave);
    return bare_leds(head.leds_in_head, [moving, rest = wave.room_from_rest](Time time) {
      const double t = std::clamp((seconds(time.time_since_epoch()) - 3) / 2, 0.0, 1.0);
      return interpolate(rest, moving(time), t * t * (3 - 2 * t));
    });
  }
};

const HeadConfig& head_named(const std::string& name, const Site& site) {
  if (name.empty()) return site.heads.front();
  const auto head = std::ranges::find(site.heads, name, &HeadConfig::name);
  if (head == site.heads.end())
    throw Error({"no head has this name", name, "vindu check shows the wall file's heads"});
  return *head;
}

std::string list_of(const std::vector<Vec3>& leds_m) {
  std::string list;
  for (const Vec3& led : leds_m)
    list += fmt::format("{}[{:.5f}, {:.5f}, {:.5f}]", list.empty() ? "" : ", ", led.x(), led.y(),
                        led.z());
  return list;
}

/// How far off the worst LED is, each from the one found nearest to it.
double worst_led_mm(const HeadConfig& found, const HeadConfig& truth) {
  double worst_mm = 0;
  for (const Vec3& led : truth.leds_in_head) {
    double nearest_mm = 1e9;
    for (const Vec3& other : found.leds_in_head)
      nearest_mm = std::min(nearest_mm, 1e3 * (other - led).norm());
    worst_mm = std::max(worst_mm, nearest_mm);
  }
  return worst_mm;
}

void tell(const HeadResult& result, const HeadConfig* truth, bool json) {
  const HeadConfig& head = result.head;
  const Vec3& eye = head.eye_in_head;
  std::vector<std::string> remarks{layout_remark(head)};
  std::erase(remarks, "");
  const double led_off_mm = truth ? worst_led_mm(head, *truth) : 0;
  const double eye_off_mm = truth ? 1e3 * (truth->eye_in_head - eye).norm() : 0;
  if (json) {
    const std::string known =
        truth ? fmt::format(R"({{"leds_m":[{}],"eye_m":{},"led_off_mm":{},"eye_off_mm":{}}})",
                            list_of(truth->leds_in_head), json_vec(truth->eye_in_head), led_off_mm,
                            eye_off_mm)
              : "";
    fmt::print(R"({{"leds_m":[{}],"eye_m":{},"rms_px":{},"led_sigma_mm":{},"moments":{},{}}})"
               "\n",
               list_of(head.leds_in_head), json_vec(eye), result.rms_px, result.led_sigma_mm,
               result.moments, end_of_json(remarks, known));
    return;
  }
  fmt::print("leds_m = [{}]\neye_m = [{:.4f}, {:.4f}, {:.4f}]\n", list_of(head.leds_in_head),
             eye.x(), eye.y(), eye.z());
  fmt::print("LEDs to {:.1f} mm, rms {:.2f} px of {} moments\n", result.led_sigma_mm, result.rms_px,
             result.moments);
  if (truth)
    fmt::print("the truth: LEDs at most {:.1f} mm off, eye {:.1f} mm\n", led_off_mm, eye_off_mm);
  print_warnings(remarks);
}

/// Throws Error for an eye where no head has one: wall files take none that is over a metre away.
void expect_eye_at_the_helmet(const Vec3& eye_in_head) {
  constexpr double kFarthest_m = 0.5;
  if (eye_in_head.norm() > kFarthest_m)
    throw Error({fmt::format("lies {:.2f} m from the helmet", eye_in_head.norm()), "--eye-at",
                 "give the point between the wearer's eyes while standing still, in wall: x to the "
                 "right and y up from the wall's middle, z away from it"});
}

/// How many are to be measured. Emulated cameras are shown the wall file's helmet: another one
/// cannot be found there. Throws Error for that, and before anybody looks for what cannot be
/// measured.
int leds_of(const HeadCommand& command, const Site& site, const HeadConfig& known) {
  const bool emulated = command.common.from.empty() && all_emulated(site);
  const int of_known = static_cast<int>(known.leds_in_head.size());
  const int leds = command.leds.value_or(emulated ? of_known : HeadOptions{}.leds);
  if (emulated && leds != of_known)
    throw Error({fmt::format("is {}, and emulated cameras see the {} LEDs of {}", leds, of_known,
                             known.name),
                 "--leds", "leave it out, or give its leds_m in the wall file as many points"});
  expect_measurable(leds, known, site.cameras);
  return leds;
}

/// With what emulated cameras know of it, where those look.
HeadOptions head_options(const HeadCommand& command, int leds, const Calibrating& run,
                         const EmulatedWearer& wearer) {
  HeadOptions options = command.head;
  options.leds = leds;
  if (run.truth) options.eye_in_room = wearer.place_in_room + wearer.head.eye_in_head;
  if (command.eye_in_wall)
    options.eye_in_room = run.site.wall.room_from_wall * *command.eye_in_wall;
  return options;
}

/// Where each camera saw the helmet, not what stood still.
std::vector<CoveragePanel> panels_of(const Calibrating& run) {
  std::vector<CoveragePanel> panels;
  const auto tracks = moving_dots(run.capture, run.site.cameras);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Coverage coverage;
    for (const CameraTrack::Picture& picture : tracks[i].pictures)
      for (const Vec2& dot : picture.dots_px)
        coverage.add(dot, picture_size_px(run.site.cameras[i]));
    panels.push_back(covered_panel(run.site.cameras[i].name, coverage));
  }
  return panels;
}

int calibrate_the_head(const HeadCommand& command) {
  const Site site = load_site(command.common.wall_file);
  const HeadConfig& known = head_named(command.name, site);
  const int leds = leds_of(command, site, known);
  const EmulatedWearer wearer(site, known, command.common.seed);
  const CaptureWish wish{
      .name = "head",
      .seconds = 40,
      .request =
          "Stand still for some seconds, facing the wall; then walk, and turn a little to "
          "all sides",
      .body = [&](const Site&) { return wearer.body(command.common.seed); },
      .known_cameras = true};
  return calibrate(command.common, site, wish, [&](const Calibrating& run) {
    const HeadResult result =
        calibrate_head(run.capture, run.site.cameras, run.site.wall.room_from_wall, known,
                       head_options(command, leds, run, wearer));
    expect_eye_at_the_helmet(result.head.eye_in_head);
    const HeadConfig truth = from_rearmost(wearer.head);
    tell(result, run.truth ? &truth : nullptr, command.common.json);
    draw(command.common, panels_of(run));
    HeadCalibration found;
    found.head = result.head;
    found.note = {"head", date_now(), run.recording, result.rms_px, 0, result.led_sigma_mm, 0};
    write(command.common, found);
  });
}

}  // namespace

void add_calibrate_head(CLI::App& calibrate, Action& chosen) {
  auto command = std::make_shared<HeadCommand>();
  CLI::App* app = calibrate.add_subcommand(
      "head", "Where a helmet's LEDs sit, and where the eye is, by calibrated cameras");
  add_calibrate_options(*app, command->common);
  app->add_option("--head", command->name, "Its name (default: the wall file's first)");
  app->add_option("--leds", command->leds,
                  "How many it has, 3 to 8, Wiimotes tell of 4 (default: 3, of emulated ones as "
                  "the wall file says)")
      ->check(CLI::Range(3, 16).description(""));
  app->add_option("--still-s", command->head.still_s,
                  "So long the wearer stands still at first, facing the wall (default: 2)")
      ->check(between(0.5, 60.0));
  add_picture_option(*app, command->common, "Where in its view each camera saw the helmet");
  add_vec3(*app, "--eye-at", command->eye_in_wall,
           "Where the point between the eyes is meanwhile, in wall (default: where it was from the "
           "rearmost LED)");
  app->footer(
      "\nExamples:\n"
      "  vindu calibrate head --wall wall.toml --eye-at 0,0.1,2\n"
      "  vindu calibrate head --wall wall.toml --from helmet.vrec --leds 4\n");
  app->callback(
      [command, &chosen] { chosen = [command] { return calibrate_the_head(*command); }; });
}

}  // namespace vindu::app
