// vindu record: writes every report of the wall file's cameras to a recording, until Ctrl-C; one
// reader thread a camera.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/cameras.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/emulation.h"
#include "app/stop_signals.h"
#include "core/calibration.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/resources.h"
#include "tracker/recording_devices.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {
namespace {

struct RecordCommand {
  std::string wall_file;
  std::string out;
  std::optional<double> seconds;
  double rotate_mb = 100;
  std::uint64_t seed = 52;
  EmulationOptions emulation;
};

/// Program and machine, as a bug report needs them.
std::string program_text() {
  utsname machine{};
  uname(&machine);
  return fmt::format("vindu {} on {} {} {}, hidapi {}", VINDU_VERSION, machine.sysname,
                     machine.release, machine.machine, hidapi_version());
}

RecordingInfo describe(const std::string& wall_file, const Site& site, const Clock& clock) {
  RecordingInfo info{
      .program = program_text(),
      .started_utc_ns = Duration(std::chrono::system_clock::now().time_since_epoch()).count(),
      .started = clock.now(),
      .wall_file = wall_file,
      .wall_text = site_text(wall_file),
      .devices = {}};
  for (const CameraConfig& camera : site.cameras)
    info.devices.push_back({static_cast<int>(info.devices.size()), camera.name});
  return info;
}

std::string default_name() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("recording-{:%Y%m%d-%H%M%S}.vrec", fmt::gmtime(now));
}

/// One line that is written over, on a terminal only.
class Progress {
 public:
  explicit Progress(const RecordingInfo& info) : info_(info), before_(info.devices.size()) {}
  ~Progress() {
    if (shown_) std::fputs("\n", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const RecordingStatus& status, Time now) {
    if (!terminal_ || (shown_ && now - shown_at_ < std::chrono::seconds(1))) return;
    std::string line = "\r\x1b[K";
    for (std::size_t i = 0; i < info_.devices.size(); ++i) {
      const double span_s = shown_ ? seconds(now - shown_at_) : 1;
      line += fmt::format("{}: {} ({:.0f}/s)   ", info_.devices[i].name, status.reports[i],
                          static_cast<double>(status.reports[i] - before_[i]) / span_s);
    }
    if (status.dropped) line += fmt::format("dropped: {}   ", status.dropped);
    std::fputs((line + fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(status.bytes))).c_str(),
               stderr);
    before_ = status.reports;
    shown_ = true;
    shown_at_ = now;
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) == 1;
  const RecordingInfo& info_;
  std::vector<std::uint64_t> before_;
  bool shown_ = false;
  Time shown_at_{};
};

/// Notes in the recording which device each camera has, what is wrong with it, and when it goes and
/// comes back.
class CameraNotes {
 public:
  void take(const std::vector<CameraState>& states, Time now, RecordingWriter& writer) {
    noted_.resize(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const std::string text = text_of(states[i]);
      if (text == noted_[i]) continue;
      writer.note(now, states[i].name + ": " + (text.empty() ? "gone" : text));
      noted_[i] = text;
    }
  }

 private:
  static std::string text_of(const CameraState& state) {
    if (!state.connected || state.trouble.empty())
      return state.connected ? state.device : state.trouble;
    return state.device + ": " + state.trouble;
  }
  std::vector<std::string> noted_;
};

/// Until the time is over, a signal comes, or nothing can be written.
void wait_for_end(const RecordCommand& command, const StopSignals& signals, const Cameras& cameras,
                  RecordingWriter& writer, const RecordingInfo& info) {
  const MonotonicClock clock;
  const Time end = command.seconds ? clock.now() + from_seconds(*command.seconds) : Time::max();
  Progress progress(info);
  CameraNotes notes;
  while (clock.now() < end && writer.status().failure.empty()) {
    progress.show(writer.status(), clock.now());
    notes.take(cameras.states(), clock.now(), writer);
    for (const auto& camera : cameras.sources())
      while (camera->next(Time::max())) continue;  // the recording has them
    const Duration rest = end - clock.now();
    if (signals.came_within(std::clamp<Duration>(rest, {}, std::chrono::milliseconds(100)))) return;
  }
}

void refuse_video(const Site& site) {
  for (const CameraConfig& camera : site.cameras)
    if (camera.source == CameraSource::video)
      throw Error({"is a video camera, whose pictures are not recorded", "camera " + camera.name,
                   "record it by ffmpeg; a video file is a camera too: source = \"video\""});
}

int record(const RecordCommand& command) {
  const std::string wall_file =
      command.wall_file.empty() ? find_asset("walls/tromso.toml") : command.wall_file;
  const Site site = read_site(wall_file);
  if (site.cameras.empty())
    throw Error({"names no [[camera]]", wall_file, "add the cameras that are to be recorded"});
  refuse_video(site);
  const StopSignals signals;
  MonotonicClock clock;
  const EmulatedRoom room(site, clock,
                          walking_room(command.emulation, site, command.seed, clock.now()));
  const RecordingInfo info = describe(wall_file, site, clock);
  const std::string file = command.out.empty() ? default_name() : command.out;
  RecordingWriter writer(file, info,
                         {.rotate_bytes = static_cast<std::uint64_t>(1e6 * command.rotate_mb)});
  const Time begin = clock.now();
  {
    const Cameras cameras(
        site, room, clock, {.tap = [&](std::unique_ptr<HidDevice> device, int camera) {
          return std::make_unique<RecordingHidDevice>(std::move(device), writer, camera);
        }});
    wait_for_end(command, signals, cameras, writer, info);
  }
  writer.flush();
  const RecordingStatus status = writer.status();
  if (!status.failure.empty()) throw Error(status.failure);
  std::uint64_t reports = 0;
  for (const std::uint64_t of_device : status.reports) reports += of_device;
  fmt::print("{}: {} reports of {} cameras in {:.1f} s, {} dropped, {} file(s)\n", file, reports,
             site.cameras.size(), seconds(clock.now() - begin), status.dropped, status.files);
  return 0;
}

}  // namespace

void add_record(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<RecordCommand>();
  CLI::App* app = parent.add_subcommand(
      "record", "Write every report of the cameras, with its arrival time, to a file");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_option("--seconds", command->seconds, "Length (default: until Ctrl-C)")
      ->check(between(0.05, 1e8));
  app->add_option("--out", command->out, "File (default: recording-DATE-TIME.vrec)")
      ->type_name("FILE");
  app->add_option("--rotate-mb", command->rotate_mb,
                  "Go on in FILE.1, FILE.2 ... when a file has grown to this; 0: never "
                  "(default: 100)")
      ->check(between(0.0, 1e6));
  app->add_option("--seed", command->seed, "Of the emulated cameras and the person before them")
      ->capture_default_str();
  add_emulation(*app, command->emulation);
  app->footer(
      "\nExamples:\n"
      "  vindu record --wall wall.toml --out walk.vrec\n"
      "  vindu record --seconds 10\n"
      "  vindu replay walk.vrec\n");
  app->callback([command, &chosen] {
    refuse_late_presses(command->emulation, command->seconds);
    chosen = [command] { return record(*command); };
  });
}

}  // namespace vindu::app
