// vindu replay: plays a recording through driver and tracker, as fast as it can or in real time,
// and says what is in it: figures, a line of JSON for each report or pose, or its text form.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "app/camera_warnings.h"
#include "app/cameras.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/pose_lines.h"
#include "app/replay_json.h"
#include "app/replay_parts.h"
#include "app/replay_summary.h"
#include "core/camera_path.h"
#include "core/error.h"
#include "core/log.h"
#include "tracker/eye_ease.h"
#include "tracker/recording_devices.h"
#include "tracker/tracker.h"
#include "tracker/wiimote/reader.h"

namespace vindu::app {
namespace {

/// After this long without a report no pose can change any more; ticks are left out.
constexpr Duration kQuiet = kPoseHeldFor + std::chrono::seconds(1);

struct ReplayCommand {
  std::string file;
  std::string wall_file;
  std::string speed = "max";
  std::string path_file;
  bool track = false;
  bool parts = false;
  bool json = false;
  bool text = false;
  bool skip_damage = false;
  double predict_ms = 0;
  std::vector<std::string> targets;

  DamagePolicy damage() const { return skip_damage ? DamagePolicy::skip : DamagePolicy::refuse; }
};

/// A clock, and how far recorded times are from its own.
struct Pace {
  std::unique_ptr<Clock> clock;
  Duration shift{};
};

Pace pace_of(const ReplayCommand& command, Time first) {
  if (command.speed == "max") return {std::make_unique<ManualClock>(), {}};
  auto clock = std::make_unique<MonotonicClock>();
  const Duration shift = clock->now() - first;
  return {std::move(clock), shift};
}

void put_line(const std::string& line) { std::fputs((line + "\n").c_str(), stdout); }

Site site_for(const ReplayCommand& command, const RecordingInfo& info) {
  if (auto site = site_of(info, command.wall_file)) return std::move(*site);
  throw Error({"holds no wall file", command.file, "name the one to track with: --wall FILE"});
}

std::vector<WiimoteReader> open_readers(const ReplayCommand& command,
                                        const RecordingSummary& summary, const Site& site,
                                        const Pace& pace) {
  std::vector<WiimoteReader> readers;
  for (const RecordedDevice& device : summary.info.devices) {
    const std::string& name = summary.devices.at(device.index).name;
    const auto camera = camera_of(device, site);
    if (!camera) {
      log_warning(name, "is no camera of the wall file and is left out");
      continue;
    }
    readers.emplace_back(
        std::make_unique<ReplayHidDevice>(command.file, device.index, *pace.clock,
                                          ReplayOptions{pace.shift, command.damage()}),
        static_cast<int>(*camera),
        wiimote_settings(site.cameras[*camera], static_cast<int>(*camera)));
  }
  if (readers.empty())
    throw Error({"none of its devices is a camera of the wall file", command.file,
                 "give the wall file that it was recorded with: --wall FILE"});
  return readers;
}

/// Ticks stand at multiples of the wall's period on the recorded clock, so that a run does not
/// depend on which report was the first.
class Ticks {
 public:
  Ticks(double rate_hz, Time first) : rate_hz_(rate_hz) { advance_to(first); }
  Time now() const { return Time{from_seconds(static_cast<double>(number_) / rate_hz_)}; }
  void advance() { ++number_; }
  /// To the first tick that is not before `time`, never back.
  void advance_to(Time time) {
    const double least = seconds(time.time_since_epoch()) * rate_hz_;
    number_ = std::max(number_, static_cast<std::int64_t>(least) - 1);
    while (now() < time) ++number_;
  }

 private:
  double rate_hz_;
  std::int64_t number_ = 0;
};

/// Of the machine's own time, also where recorded time is played; runs from the start.
class Stopwatch {
 public:
  /// Returns the time that it has run.
  Duration pause() { return sum_ += std::chrono::steady_clock::now() - began_; }
  void go_on() { began_ = std::chrono::steady_clock::now(); }

 private:
  Time began_ = std::chrono::steady_clock::now();
  Duration sum_{};
};

/// Knows when the next report comes, so that long silences need not be ticked through.
class Lookahead {
 public:
  Lookahead(const std::string& file, DamagePolicy damage)
      : reader_(file, damage), next_(reader_.next()) {}

  /// Where ticks may go on at once: the next report's arrival after a long silence, else empty.
  std::optional<Time> silent_until(Time now) {
    for (; next_ && next_->arrival <= now; next_ = reader_.next())
      last_ = std::max(last_, next_->arrival);
    if (!next_ || now - last_ < kQuiet) return std::nullopt;
    return next_->arrival;
  }

 private:
  RecordingReader reader_;
  std::optional<RecordedReport> next_;
  Time last_{};
};

/// The eye as a wall would have shown it, tick by tick, as a camera path.
class EyePath {
 public:
  explicit EyePath(const Site& site) : ease_(site.viewer.default_eye_in_wall) {}

  void add(const Tracker& tracker, const std::optional<PoseSample>& pose, Time now) {
    const bool known = pose && pose->level < TrackingLevel::held;
    if (keys_.empty()) start_ = now;
    keys_.push_back(
        {seconds(now - start_),
         ease_.update(known ? std::optional(tracker.eye_in_wall(*pose)) : std::nullopt, now)});
  }
  void write(const std::string& file) const {
    if (keys_.size() < 2)
      throw Error({"is too short for a camera path", "the recording", "record some seconds"});
    write_camera_path(keys_, file);
  }

 private:
  EyeEase ease_;
  Time start_{};
  std::vector<PathKey> keys_;
};

int track(const ReplayCommand& command, const RecordingSummary& summary) {
  const Site site = site_for(command, summary.info);
  const Pace pace = pace_of(command, summary.first);
  std::vector<WiimoteReader> readers = open_readers(command, summary, site, pace);
  Tracker tracker(site.cameras, site.heads, site.wall.room_from_wall, site.tracking);
  Lookahead ahead(command.file, command.damage());
  CameraWarnings warnings(site);
  PoseLines lines(site, targets_from(command.targets));
  ReplayParts parts;
  EyePath path(site);
  const auto end = [&] {
    if (!command.path_file.empty()) path.write(command.path_file);
    if (command.parts) std::fputs(parts.table().c_str(), stdout);
    return 0;
  };
  const Duration predicted = from_seconds(1e-3 * command.predict_ms);
  for (Ticks ticks(site.rate_hz, summary.first);; ticks.advance()) {
    const Time now = ticks.now() + pace.shift;
    Stopwatch solve;
    for (WiimoteReader& reader : readers)
      while (const auto observation = reader.next(now)) tracker.absorb(*observation);
    solve.pause();
    pace.clock->sleep_until(now);
    solve.go_on();
    const auto pose = tracker.track(now, now + predicted);
    warnings.look(tracker, now);
    parts.add(now, pose, solve.pause());
    path.add(tracker, pose, now);
    if (command.track)
      for (const std::string& line : lines.news(tracker, pose, now, -pace.shift)) put_line(line);
    if (ticks.now() >= summary.last) return end();
    if (const auto next = ahead.silent_until(ticks.now())) ticks.advance_to(*next);
  }
}

int print_reports(const ReplayCommand& command, const RecordingSummary& summary) {
  const Pace pace = pace_of(command, summary.first);
  RecordingReader reader(command.file, command.damage());
  while (const auto report = reader.next()) {
    pace.clock->sleep_until(report->arrival + pace.shift);
    const std::string& device = summary.devices.at(report->device).name;
    put_line(command.text ? text_line(device, *report) : app::json_of(*report, device));
  }
  return 0;
}

void print_comments(const RecordingSummary& summary) {
  std::istringstream table(table_of(summary));
  for (std::string line; std::getline(table, line);) put_line("# " + line);
  std::istringstream wall(summary.info.wall_text);
  for (std::string line; std::getline(wall, line);) put_line("# wall: " + line);
}

int replay(const ReplayCommand& command) {
  if (command.speed == "real") std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const RecordingSummary summary = summarize(command.file, command.damage(), command.wall_file);
  for (const std::string& remark : summary.problems.remarks) log_warning("replay", remark);
  if (command.track || command.parts || !command.path_file.empty()) return track(command, summary);
  if (command.text) print_comments(summary);
  if (command.text || command.json) return print_reports(command, summary);
  std::fputs(table_of(summary).c_str(), stdout);
  return 0;
}

}  // namespace

void add_replay(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ReplayCommand>();
  CLI::App* app = parent.add_subcommand(
      "replay", "Play a recording of the cameras' reports through driver and tracker");
  app->add_option(
         "FILE", command->file,
         "What vindu record wrote, or text: a line \"device arrival_ns hex-bytes\" a report")
      ->required();
  auto* track =
      app->add_flag("--track", command->track, "Track, and print the poses as lines of JSON");
  auto* json = app->add_flag("--json", command->json, "A line of JSON for each report");
  auto* parts =
      app->add_flag("--parts", command->parts,
                    "Track, and print how old captures are at the wall's ticks, and what\n"
                    "finding the eye takes");
  parts->excludes(track)->excludes(json);
  app->add_flag("--text", command->text, "The recording in its text form")
      ->excludes(track)
      ->excludes(parts)
      ->excludes(json);
  app->add_option("--path", command->path_file,
                  "Track, and write the eye as a camera path: for the mode loop, and for films\n"
                  "(vindu render --path)")
      ->excludes(json)
      ->type_name("FILE");
  app->add_option("--speed", command->speed,
                  "real: as it was recorded; max: as fast as it can (default)")
      ->check(CLI::IsMember({"real", "max"}));
  app->add_option("--wall", command->wall_file,
                  "Wall file of its cameras (default: the one in the recording)")
      ->type_name("FILE");
  CLI::Option* const predict =
      app->add_option("--predict-ms", command->predict_ms,
                      "With --track: the eye so long after each tick (default: 0)")
          ->check(between(0.0, 1000.0));
  add_targets(*app, command->targets)->needs(track);
  app->add_flag("--skip-damage", command->skip_damage, "Read around what is damaged");
  app->footer(
      "\nExamples:\n"
      "  vindu replay walk.vrec\n"
      "  vindu replay walk.vrec --track > poses.jsonl\n"
      "  vindu replay walk.vrec --parts\n"
      "  vindu replay walk.vrec --path walk.toml\n"
      "  vindu replay walk.vrec --text > walk.txt\n"
      "  vindu replay walk.txt --track --wall wall.toml --speed real\n");
  app->callback([command, predict, &chosen] {
    if (predict->count() > 0 && !command->track && command->path_file.empty())
      throw CLI::RequiresError("--predict-ms", "--track or --path");
    chosen = [command] { return replay(*command); };
  });
}

}  // namespace vindu::app
