// vindu calibrate: the parent of the calibrations, and what they share.
#include "app/calibrate.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/cameras.h"
#include "app/common.h"
#include "app/stop_signals.h"
#include "core/error.h"
#include "tracker/camera_model.h"
#include "tracker/recording_devices.h"

namespace vindu::app {
namespace {

std::string stamp(const char* format) {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format(fmt::runtime(format), fmt::gmtime(now));
}

std::string recording_name(const CalibrateOptions& options, const CaptureWish& wish) {
  std::string name = wish.name + stamp("-{:%Y%m%d-%H%M%S}.vrec");
  if (options.wall_file.empty()) return name;
  const std::string folder = calibration_folder(options.wall_file);
  make_folder(folder);
  return folder + "/" + name;
}

void watch_emulated(const CalibrateOptions& options, const CaptureWish& wish, Calibrating& run) {
  run.truth = wish.known_cameras
                  ? HiddenTruth{run.site.cameras, {}}
                  : hide_truth(load_uncalibrated_site(options.wall_file).cameras, options.seed);
  Site truth = run.site;
  truth.cameras = run.truth->cameras;
  ManualClock clock;
  EmulatedRoomOptions room;
  room.body = wish.body(truth);
  room.late = run.truth->late;
  room.wiimote.seed = options.seed;
  room.wiimote.noise_px = options.noise_px;
  const EmulatedRoom emulated(truth, clock, room);
  run.capture = watch(emulated, truth.cameras.size(), clock, options.seconds.value_or(wish.seconds),
                      wish.watching);
}

/// On a terminal only, over and over on one line.
class ProgressLine {
 public:
  ~ProgressLine() {
    if (shown_) std::fputs("\n", stderr);
  }
  void show(const std::string& text) {
    if (!terminal_) return;
    fmt::print(stderr, "\r\x1b[K{}", text);
    shown_ = true;
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) == 1;
  bool shown_ = false;
};

bool is_video(const CameraConfig& camera) { return camera.source == CameraSource::video; }

RecordingInfo recording_info(const CalibrateOptions& options, const Site& site, Time now) {
  RecordingInfo info{
      .program = "vindu " VINDU_VERSION,
      .started_utc_ns = Duration(std::chrono::system_clock::now().time_since_epoch()).count(),
      .started = now,
      .wall_file = options.wall_file,
      .wall_text = options.wall_file.empty() ? "" : site_text(options.wall_file),
      .devices = {}};
  for (const CameraConfig& camera : site.cameras)
    info.devices.push_back({static_cast<int>(info.devices.size()), camera.name});
  return info;
}

/// The recording goes where no Wiimote has sent anything.
void drop_if_empty(Calibrating& run) {
  const bool recorded = std::ranges::any_of(run.capture.observations, [&](const auto& seen) {
    return !is_video(run.site.cameras[static_cast<std::size_t>(seen.camera)]);
  });
  if (run.recording.empty() || recorded) return;
  std::filesystem::remove(run.recording);
  run.recording.clear();
}

/// Until --seconds, Ctrl-C or enough was seen.
void look(const CalibrateOptions& options, const CaptureWish& wish, const Cameras& cameras,
          Clock& clock, Capture& capture) {
  const StopSignals signals;
  ProgressLine line;
  const Time end = options.seconds ? clock.now() + from_seconds(*options.seconds) : Time::max();
  line.show(wish.request);
  for (int round = 0; clock.now() < end; ++round) {
    for (const auto& camera : cameras.sources())
      while (const auto seen = camera->next(clock.now())) capture.observations.push_back(*seen);
    if (wish.watching && !wish.watching(capture)) break;
    if (round % 5 == 4)
      line.show(progress_line(wish.progress, capture, cameras.states()) + "   (Ctrl-C: enough)");
    if (signals.came_within(std::chrono::milliseconds(100))) break;
  }
}

void watch_live(const CalibrateOptions& options, const CaptureWish& wish, Calibrating& run) {
  MonotonicClock clock;
  EmulatedRoomOptions beside;
  beside.body = wish.body(run.site);
  const EmulatedRoom room(run.site, clock, beside);  // for those that are emulated
  std::optional<RecordingWriter> writer;
  if (!std::ranges::all_of(run.site.cameras, is_video)) {
    run.recording = recording_name(options, wish);
    writer.emplace(run.recording, recording_info(options, run.site, clock.now()));
  }
  {
    const Cameras cameras(
        run.site, room, clock, {.tap = [&](std::unique_ptr<HidDevice> device, int camera) {
          return std::make_unique<RecordingHidDevice>(std::move(device), *writer, camera);
        }});
    look(options, wish, cameras, clock, run.capture);
  }
  if (writer) writer->flush();
  drop_if_empty(run);
  if (run.capture.observations.empty())
    throw Error(
        {"none of them sent anything", "cameras", "vindu wiimote list shows what is there"});
  run.capture.up_in_camera.assign(run.site.cameras.size(), std::nullopt);
  if (!run.recording.empty())
    run.capture.up_in_camera = read_capture(run.recording, run.site).up_in_camera;
}

/// How to go on after `error`: with what live cameras have sent.
Error with_recording(const Error& error, const Calibrating& run) {
  const bool whole = std::ranges::none_of(run.site.cameras, is_video);
  return Error(fmt::format("{}; what {} sent is kept: --from {} calibrates by it", error.what(),
                           whole ? "the cameras" : "the Wiimotes (no video cameras)",
                           run.recording));
}

bool may_write(const CalibrateOptions& options) {
  if (!options.dry_run && options.wall_file.empty())
    fmt::print(stderr, "Nothing is written: name your wall file by --wall FILE.\n");
  return !options.dry_run && !options.wall_file.empty();
}

/// `name` of the file: what it said before goes to another.
template <class Found>
void write_beside(const CalibrateOptions& options, const std::string& name, const Found& found) {
  if (!may_write(options)) return;
  const bool replaced = std::filesystem::exists(
      fmt::format("{}/{}.toml", calibration_folder(options.wall_file), name));
  fmt::print(stderr, "Written to {}{}\n", write_calibration(options.wall_file, found),
             replaced ? fmt::format("; what it said is kept as {}.previous.toml", name) : "");
}

}  // namespace

void add_calibrate_options(CLI::App& app, CalibrateOptions& options) {
  app.add_option("--wall", options.wall_file,
                 "Wall file, beside which the result is written (default: the Tromsø wall, and "
                 "nothing is written)")
      ->type_name("FILE");
  app.add_option("--from", options.from, "A recording, instead of live cameras")->type_name("FILE");
  app.add_option("--seconds", options.seconds, "Length (default: until Ctrl-C)")
      ->check(between(0.5, 1e6));
  app.add_option("--seed", options.seed, "Of emulated cameras, and of where they truly stand")
      ->capture_default_str();
  app.add_option("--noise-px", options.noise_px, "Of emulated cameras (default: 0.6)")
      ->check(between(0.0, 20.0));
  app.add_flag("--json", options.json, "Figures as JSON");
  app.add_flag("--dry-run", options.dry_run, "Write no calibration");
}

void add_picture_option(CLI::App& app, CalibrateOptions& options, const std::string& what) {
  app.add_option("--picture", options.picture, what)->type_name("")->check(png_name());
}

int calibrate(const CalibrateOptions& options, const Site& site, const CaptureWish& wish,
              const std::function<void(const Calibrating&)>& by_what_was_seen) {
  if (site.cameras.empty())
    throw Error({"names no [[camera]]", options.wall_file, "add the cameras to be calibrated"});
  Calibrating run{.site = site};
  const bool live = options.from.empty() && !all_emulated(site);
  try {
    if (live) {
      watch_live(options, wish, run);
    } else if (options.from.empty()) {
      watch_emulated(options, wish, run);
    } else {
      run.capture = read_capture(options.from, site);
      run.recording = options.from;
    }
    by_what_was_seen(run);
  } catch (const Error& error) {
    if (!live) throw;
    drop_if_empty(run);
    if (run.recording.empty()) throw;
    throw with_recording(error, run);
  }
  return 0;
}

std::string date_now() { return stamp("{:%Y-%m-%d %H:%M} UTC"); }

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
}

std::string end_of_json(const std::vector<std::string>& warnings, const std::string& truth) {
  std::string texts;
  for (const std::string& warning : warnings)
    texts += (texts.empty() ? "" : ",") + json_text(warning);
  return fmt::format(R"("warnings":[{}])", texts) + (truth.empty() ? "" : ",\"truth\":" + truth);
}

void write(const CalibrateOptions& options, const std::vector<CameraCalibration>& cameras) {
  write_beside(options, "cameras", cameras);
}

void write(const CalibrateOptions& options, const HeadCalibration& head) {
  write_beside(options, "heads", head);
}

Coverage coverage_so_far(const Capture& capture, std::size_t camera, const Site& site) {
  const CameraConfig& config = site.cameras[camera];
  Coverage coverage;
  for (const Observation& seen : capture.observations)
    if (static_cast<std::size_t>(seen.camera) == camera)
      for (const Dot& dot : seen.dots)
        coverage.add(image_from_raw(config.source, raw_px_of(dot)), picture_size_px(config));
  return coverage;
}

std::string covered_so_far(const Capture& capture, std::size_t camera, const Site& site) {
  return fmt::format("{:.0f} % covered", 100 * coverage_so_far(capture, camera, site).share());
}

void draw(const CalibrateOptions& options, const std::vector<CoveragePanel>& panels) {
  if (options.picture.empty()) return;
  write_png(coverage_picture(panels), options.picture);
  fmt::print(stderr, "{}\n", options.picture);
}

void add_calibrate(CLI::App& parent, Action& chosen) {
  CLI::App* app = parent.add_subcommand(
      "calibrate", "Where cameras stand, what their lenses are, where helmets' LEDs sit");
  app->require_subcommand(1);
  add_calibrate_wand(*app, chosen);
  add_calibrate_wall(*app, chosen);
  add_calibrate_head(*app, chosen);
  add_calibrate_background(*app, chosen);
  add_calibrate_intrinsics(*app, chosen);
  add_calibrate_extrinsics(*app, chosen);
  app->footer(
      "\nvindu calibrate wand finds cameras and lenses at once, from a waved wand.\n"
      "\nExamples, in the order of a new site:\n"
      "  vindu calibrate background --wall wall.toml\n"
      "  vindu calibrate wand --wall wall.toml\n"
      "  vindu calibrate wall --wall wall.toml\n"
      "  vindu calibrate head --wall wall.toml\n");
}

}  // namespace vindu::app
