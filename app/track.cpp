// vindu track: the tracking server without a picture. Cameras in, poses out: on a terminal as a
// line that is written over, as lines of JSON for other programs, and at the end as a table.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/camera_warnings.h"
#include "app/cameras.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/emulation.h"
#include "app/pose_lines.h"
#include "app/stop_signals.h"
#include "app/wall_console.h"
#include "cluster/dds.h"
#include "core/error.h"
#include "core/log.h"
#include "tracker/wiimote/gaps.h"

namespace vindu::app {
namespace {

struct TrackCommand {
  std::string wall_file;
  std::optional<std::string> method, mode, follow;
  std::optional<double> seconds, rate_hz;
  double predict_ms = 0;
  std::vector<std::string> targets;
  std::uint64_t seed = 52;
  EmulationOptions emulation;
  bool json = false;
  bool publish = false;
  int strength = 10;
};

Site site_for(const TrackCommand& command) {
  Site site = load_site(command.wall_file);
  if (site.cameras.empty())
    throw Error({"names no [[camera]]", command.wall_file, "add the cameras that are to track"});
  TrackingConfig& tracking = site.tracking;
  tracking.method = command.method.value_or(tracking.method);
  tracking.mode = command.mode.value_or(tracking.mode);
  tracking.follow = command.follow.value_or(tracking.follow);
  const auto named = [&](const HeadConfig& head) { return head.name == tracking.follow; };
  if (tracking.follow != "nearest" && tracking.follow != "first" &&
      std::ranges::none_of(site.heads, named))
    throw Error({"there is no head \"" + tracking.follow + "\" to follow", "--follow",
                 "use nearest, first, or the name of a [[head]] of the wall file"});
  site.rate_hz = command.rate_hz.value_or(site.rate_hz);
  return site;
}

/// The state of things, in one line of a terminal.
std::string status_line(const std::optional<PoseSample>& pose, const Tracker& tracker,
                        const Cameras& cameras, const Site& site) {
  std::string line = "\r\x1b[K";
  if (pose) {
    const Vec3 eye = tracker.eye_in_wall(*pose);
    line += fmt::format("{:<8} eye {:+.3f} {:+.3f} {:+.3f} m  {:.2f} m/s", name_of(pose->level),
                        eye.x(), eye.y(), eye.z(), pose->velocity_in_room_m_s.norm());
    if (site.heads.size() > 1)
      line += "  " + site.heads[static_cast<std::size_t>(pose->object)].name;
  } else {
    line += "nobody found yet";
  }
  const auto health = tracker.camera_health();
  const auto states = cameras.states();
  for (std::size_t i = 0; i < health.size(); ++i) {
    if (health[i].moved)
      line += fmt::format("  {} was moved!", site.cameras[i].name);
    else if (stands_aside(health[i]))
      line += fmt::format("  {} stands {:.0f} px aside!", site.cameras[i].name, health[i].aside_px);
    if (health[i].masks)
      line += fmt::format("  {}: {} masked", site.cameras[i].name, health[i].masks);
  }
  if (tracker.nothing_fits()) line += "  the dots fit no head!";
  if (const double px = tracker.disagreement_px(); px >= 1)
    line += fmt::format("  cameras contradict each other by {:.0f} px!", px);
  if (const double larger = tracker.heads_look_larger(); std::abs(larger) > size_that_counts(site))
    line += fmt::format("  sizes are off by {:.1f} %!", 100 * larger);
  for (const CameraState& state : states)
    if (!state.trouble.empty()) line += fmt::format("  {}: {}", state.name, state.trouble);
  return line;
}

/// Heads that are seen now, on the topic pose, and what people tell. What is held or lost is not
/// said: then a weaker tracker is heard.
class Publisher {
 public:
  Publisher(const Site& site, int strength)
      : name_("tracker-" + host_name() + "-" + std::to_string(getpid())),
        strength_(strength),
        transport_(network_of(site, Role::tracker)),
        bus_(transport_.join({this_participant(Role::tracker, name_, site),
                              {Topic::pose, Topic::event},
                              {},
                              strength})) {}

  void publish(const Tracker& tracker, const std::optional<PoseSample>& followed, Time now) {
    for (const PoseSample& pose : tracker.poses())
      if (pose.level < TrackingLevel::held)
        bus_->publish(PoseMessage{.pose = pose,
                                  .sent_time = now,
                                  .followed = followed && followed->object == pose.object,
                                  .tracker = name_,
                                  .strength = static_cast<std::uint32_t>(strength_)});
  }
  void publish(const EventMessage& event) { bus_->publish(event); }

 private:
  std::string name_;
  int strength_;
  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
};

std::string words_of(const GestureEvent& event, const Site& site) {
  const std::string& who = site.heads[static_cast<std::size_t>(event.object)].name;
  const std::string what = event.target.empty()
                               ? std::string(name_of(event.gesture))
                               : fmt::format("{} at {}", name_of(event.gesture), event.target);
  return fmt::format("{}: {} ({:.0f} %)", who, what, 100 * event.confidence);
}

std::string words_of(const CameraHealth& camera) {
  if (camera.moved) return ", was MOVED: calibrate it again";
  if (!stands_aside(camera)) return "";
  return fmt::format(
      ", stands {:.0f} px aside of where the others expect its dots: calibrate it again",
      camera.aside_px);
}

void print_table(const Tracker& tracker, const Cameras& cameras, const Site& site,
                 const std::string& misfit, Duration length) {
  const TrackerCounts& counts = tracker.counts();
  const double frames = static_cast<double>(std::max<std::uint64_t>(counts.frames, 1));
  fmt::print("\n{} frames in {:.1f} s, {} reports of {} cameras\n", counts.frames, seconds(length),
             counts.reports, site.cameras.size());
  for (std::size_t level = 0; level < counts.frames_by_level.size(); ++level)
    if (counts.frames_by_level[level])
      fmt::print("  {:<10} {:>5.1f} %\n", name_of(static_cast<TrackingLevel>(level)),
                 100 * static_cast<double>(counts.frames_by_level[level]) / frames);
  const auto health = tracker.camera_health();
  for (std::size_t i = 0; i < health.size(); ++i)
    fmt::print("  {:<9} {}, {} reflections masked{}\n", site.cameras[i].name,
               health[i].device_time ? "times by its own clock" : "times by arrival",
               health[i].masks, words_of(health[i]));
  if (!misfit.empty()) fmt::print("  {}\n", misfit);
  for (const CameraState& camera : cameras.states())
    if (camera.gaps)
      fmt::print("  {:<9} gaps: {}; {}{}\n", camera.name, vindu::text_of(*camera.gaps),
                 camera.counts, camera.trouble.empty() ? "" : "; " + camera.trouble);
}

int track(const TrackCommand& command) {
  if (command.json) std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const Site site = site_for(command);
  const auto targets = targets_from(command.targets);
  const StopSignals signals;
  MonotonicClock clock;
  const EmulatedRoom room(site, clock,
                          walking_room(command.emulation, site, command.seed, clock.now()));
  const Cameras cameras(site, room, clock);
  Tracker tracker(site.cameras, site.heads, site.wall.room_from_wall, site.tracking);
  CameraWarnings warnings(site);
  PoseLines lines(site, targets);
  std::optional<Publisher> publisher;
  if (command.publish) publisher.emplace(site, command.strength);
  const Duration ahead = from_seconds(1e-3 * command.predict_ms);
  const bool terminal = !command.json && isatty(STDERR_FILENO) == 1;
  const Time begin = clock.now();
  Time shown = begin;
  for (std::int64_t tick = 1;; ++tick) {
    const Time due = begin + from_seconds(static_cast<double>(tick) / site.rate_hz);
    if (command.seconds && seconds(due - begin) > *command.seconds) break;
    if (signals.came_within(std::max(due - clock.now(), Duration::zero()))) break;
    const Time now = clock.now();
    for (const auto& camera : cameras.sources())
      while (const auto seen = camera->next(now)) tracker.absorb(*seen);
    const auto pose = tracker.track(now, now + ahead);
    if (!terminal) warnings.look(tracker, now);  // else they stand in the status line
    if (publisher) publisher->publish(tracker, pose, clock.now());
    for (const std::string& line : lines.news(tracker, pose, now, {}))
      if (command.json) std::puts(line.c_str());
    for (const GestureEvent& event : lines.events()) {
      if (publisher) publisher->publish(message_of(event, host_name()));
      if (!command.json) fmt::print("{}{}\n", terminal ? "\r\x1b[K" : "", words_of(event, site));
    }
    for (const ButtonChange& change : tracker.button_changes())
      if (publisher) publisher->publish(message_of(change, site, host_name()));
    if (terminal && now - shown > std::chrono::milliseconds(100)) {
      std::fputs(status_line(pose, tracker, cameras, site).c_str(), stderr);
      shown = now;
    }
  }
  if (terminal) std::fputs("\n", stderr);
  if (!command.json)
    print_table(tracker, cameras, site, warnings.misfit(tracker), clock.now() - begin);
  return 0;
}

}  // namespace

void add_track(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<TrackCommand>();
  CLI::App* app = parent.add_subcommand(
      "track", "The tracking server without a picture: cameras in, poses and gestures out");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_flag(
      "--json", command->json,
      "A line of JSON for each pose, gesture, press of a button, change of a camera, and of what\n"
      "does not fit: disagreement_px between cameras, and the share that heads look larger");
  app->add_flag("--publish", command->publish,
                "Poses go to the wall's master, by [cluster] of the wall file; gestures and\n"
                "presses of buttons to all who listen (vindu events)");
  app->add_option("--strength", command->strength,
                  "Of several trackers that publish the stronger is heard (default: 10)")
      ->check(CLI::Range(2, 1000));
  app->add_option("--predict-ms", command->predict_ms,
                  "The eye so long after each tick (default: 0)")
      ->check(between(0.0, 1000.0));
  app->add_option("--method", command->method, "Tracking method (default: the wall file's)")
      ->check(CLI::IsMember({"joint", "thesis"}));
  app->add_option("--mode", command->mode,
                  "The least that is good enough (default: the wall file's)")
      ->check(CLI::IsMember({"auto", "six-dof", "hybrid", "position"}));
  app->add_option("--follow", command->follow,
                  "Whom the status line follows: nearest, first, or a head's name");
  app->add_option("--rate", command->rate_hz, "Poses a second (default: the wall's rate)")
      ->check(between(1.0, 1000.0));
  app->add_option("--seconds", command->seconds, "Length (default: until Ctrl-C)")
      ->check(between(0.05, 1e8));
  app->add_option("--seed", command->seed, "Of the emulated cameras and the person before them")
      ->capture_default_str();
  add_targets(*app, command->targets);
  add_emulation(*app, command->emulation);
  app->footer(
      "\nExamples:\n"
      "  vindu track --wall wall.toml\n"
      "  vindu track --json --predict-ms 40 > poses.jsonl\n"
      "  vindu track --target globe,0.5,0.2,-1,0.3 --seconds 60\n");
  app->callback([command, &chosen] {
    refuse_late_presses(command->emulation, command->seconds);
    chosen = [command] { return track(*command); };
  });
}

}  // namespace vindu::app
