// vindu master: ticks at the wall's rate, asks for the eye once a frame, tells all tiles, and holds
// them together. Consoles ask it for another scene, mode or place on the running wall.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/asked_file.h"
#include "app/captures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/emulation.h"
#include "app/eye_source.h"
#include "app/remote_eye.h"
#include "app/service.h"
#include "app/still_eye.h"
#include "app/stop_signals.h"
#include "app/touch_eye.h"
#include "app/tracker_events.h"
#include "app/wall_console.h"
#include "app/wall_figures.h"
#include "app/wall_scenes.h"
#include "cluster/console.h"
#include "cluster/dds.h"
#include "cluster/wall_master.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/resources.h"

namespace vindu::app {
namespace {

struct MasterCommand {
  Asked asked;
  std::string wall_file;
  std::string path_file;
  std::optional<double> seconds;
  std::uint64_t seed = 52;
  EmulationOptions emulation;
  bool tracker_elsewhere = false;
  std::string csv_file;
  std::vector<std::string> targets;
  std::string session;
  bool json = false;
};

/// So long a master listens whether there is an older one, before it says anything: keys take time.
/// One that is started again after a crash has done so before.
constexpr Duration kListen = std::chrono::seconds(1), kListenWithKeys = std::chrono::seconds(3);
/// One that finds an older one within this time gives way.
constexpr Duration kYoung = std::chrono::seconds(10);
/// After this time of its life what it goes on with is not what the one before died of.
constexpr Duration kSettled = std::chrono::seconds(10);
/// An exit code for whoever starts it again when it ends: that would be of no use.
constexpr int kInVain = 3;

/// Larger than that of any master before, as long as the host's clock goes forward.
std::uint64_t new_epoch() {
  return static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch() /
                                    std::chrono::nanoseconds(1));
}

class MasterRun {
 public:
  MasterRun(const MasterCommand& command, const Site& site)
      : site_(site),
        room_(site, clock_, walking_room(command.emulation, site, command.seed, clock_.now())),
        transport_(network_of(site, Role::master)),
        bus_(transport_.join({self_, kTells, kJoins})),
        wall_(*bus_, {.epoch = epoch_,
                      .self = self_,
                      .tiles = tile_names(site.wall),
                      .barrier = {.lock = site.cluster.lock}}),
        eye_in_wall_(site.viewer.default_eye_in_wall),
        gestures_(site, targets_from(command.targets)),
        path_file_(command.path_file),
        elsewhere_(command.tracker_elsewhere),
        asked_(command.asked),
        launched_(command.asked),
        kept_(site.cluster, command.session),
        figures_(tile_names(site.wall), display_latency(), command.csv_file) {
    if (const auto before = kept_.take()) {
      asked_ = *before;
      was_before_ = true;
      log_info("master", asked_ == launched_ ? "begins again as it was launched"
                                             : "goes on with what was asked for before it ended");
      keep(launched_);  // for the next one, should it die of that
    }
    enter_mode();
    scenes_.emplace(site_, wall_, desk_, asked_, launched_);
  }

  /// Throws Error when the first scene cannot be read.
  const WallFigures& run(const StopSignals& signals, std::optional<double> seconds_long) {
    const Time start = clock_.now(), speaks = start + listens();
    Time tick = speaks;
    while (!stopped_ && !signals.came_within(Duration::zero())) {
      const Time now = clock_.now();
      sign_of_life_.give(now);
      if (seconds_long && seconds(now - speaks) > *seconds_long) break;
      wall_.poll(now);
      if (gives_way(now - start)) break;
      note_events();
      if (now >= speaks) {
        scenes_->follow();
        for (const CommandMessage& command : desk_.take()) answer(command);
      }
      answer_captures();
      if (wall_.open() && now >= tick) {
        on_tick(now);
        const auto passed = static_cast<std::int64_t>(seconds(now - speaks) * site_.rate_hz + 1e-6);
        tick = speaks + from_seconds(static_cast<double>(passed + 1) / site_.rate_hz);
      }
      Time wake = wall_.open() ? tick : wall_.wake_time();
      if (scenes_->reading()) wake = std::min(wake, now + std::chrono::milliseconds(5));
      bus_->wait(kHears, wake);
      remember(now - start);
    }
    if (!older_) kept_.remove();
    figures_.length = std::max(clock_.now() - speaks, Duration::zero());
    if (stopped_) answer_stragglers();
    figures_.tiles = wall_.tiles();
    figures_.end();
    return figures_;
  }

  /// A master to which it gave way.
  const std::optional<Participant>& older() const { return older_; }

 private:
  static constexpr Topics kHears = {Topic::ready, Topic::tile_status, Topic::presence,
                                    Topic::command};
  static constexpr Topics kTells = {Topic::frame,  Topic::scene,  Topic::report,
                                    Topic::camera, Topic::answer, Topic::event};
  static constexpr Topics kJoins = {Topic::ready,   Topic::tile_status, Topic::presence,
                                    Topic::command, Topic::pose,        Topic::event};

  /// Whoever asked it to stop may not be heard of by the time of the answer: he asks again.
  void answer_stragglers() {
    const Time end = clock_.now() + 2 * kAskAgain + std::chrono::milliseconds(100);
    while (clock_.now() < end) {
      bus_->wait({Topic::command}, end);
      for (const CommandMessage& command : desk_.take())
        reply(command, command.verb == Verb::stop, "the wall is ending");
    }
  }

  Duration listens() const {
    if (was_before_) return Duration::zero();
    return site_.cluster.keys.empty() ? kListen : kListenWithKeys;
  }

  /// To a master that was there before: it is not to be disturbed by one that is started by
  /// mistake.
  bool gives_way(Duration age) {
    if (age < kYoung) older_ = wall_.older_master();
    return older_.has_value();
  }

  /// Kept as it was asked for last; of a master that was started again not before it has settled.
  void remember(Duration age) {
    if (kept_as_ == asked_ || (was_before_ && age < kSettled)) return;
    keep(asked_);
  }

  void keep(const Asked& asked) {
    kept_.keep(asked);
    kept_as_ = asked;
  }

  /// As the one before had it. A camera may not be there any more.
  void enter_mode() {
    try {
      set_mode(asked_.mode);
    } catch (const Error& error) {
      if (asked_.mode == launched_.mode) throw;
      log_warning("master",
                  fmt::format("{}; it begins in the mode {}", error.what(), launched_.mode));
      set_mode(asked_.mode = launched_.mode);
    }
  }

  void set_mode(const std::string& mode) {
    if (mode == "touch") {
      touch_.start_from(eye_in_wall_);
      eyes_ = &touch_;
      return;
    }
    if (mode != "loop" && mode != "track")
      throw Error({"there is no mode \"" + mode + "\"", "mode", "choose track, touch or loop"});
    if (mode == "loop") {
      path_ = follow_path(
          read_camera_path(path_file_.empty() ? find_asset("paths/sweep.toml") : path_file_));
      eyes_ = path_.get();
      return;
    }
    if (!tracked_) tracked_ = make_tracked();
    eyes_ = tracked_.get();
  }

  std::unique_ptr<RemoteEye> make_tracked() {
    std::unique_ptr<EyeSource> own;
    if (!site_.cameras.empty() && !elsewhere_)
      own = std::make_unique<TrackedEye>(
          site_, room_, clock_,
          TrackedEyeOptions{.cameras = {.threads = true, .tap = {}},
                            .on_frame = [this](const Tracker& tracker) { tell(tracker); }});
    return std::make_unique<RemoteEye>(*bus_, site_, std::move(own));
  }

  /// Elsewhere, whose poses the eye is of; empty: none.
  std::string tracker() const {
    return tracked_ && eyes_ == tracked_.get() ? tracked_->tracker() : "";
  }

  /// What people do before its own cameras, to all who listen.
  void tell(const Tracker& tracker) {
    for (const GestureEvent& event : gestures_.news(tracker))
      bus_->publish(message_of(event, host_name()));
    for (const ButtonChange& change : tracker.button_changes())
      bus_->publish(message_of(change, site_, host_name()));
  }

  /// Finds the eye, and begins a frame where one is due.
  void on_tick(Time now) {
    const Stage& stage = scenes_->at(now);
    const Time photon = now + figures_.to_light() + display_latency();
    touch_.hear(now);
    const EyeNow eye = eyes_->at(now, photon);
    eye_in_wall_ = eye.eye_in_wall;
    const std::optional<TouchPage>& page = page_.at(now);
    const FrameState state = {
        .photon_time = photon,
        .eye_in_wall = still_.at(eye, stage.corners_in_wall(), now),
        .navigation = stage.navigation,
        .animation_time_s = stage.plays() ? seconds(now - stage.clip_start) : 0,
        .clip = stage.clip,
        .mode = eye.mode,
        .overlays = (asked_.overlay && !page ? std::uint32_t{kStatistics} : 0) |
                    (captures_.empty() ? 0 : std::uint32_t{kKeepPicture}),
        .pattern = asked_.pattern,
        .blank = asked_.blank && !page,
        .touch_page = page};
    if (wall_.due(state, now))
      begin(state, eye, now);
    else
      figures_.rested();
    if (auto report = figures_.report(now, wall_.tiles())) {
      if (report->tile.empty()) report->tracker = tracker();
      wall_.report(*report);
    }
  }

  void begin(const FrameState& state, const EyeNow& eye, Time now) {
    const FrameOrigin origin = origin_of(eye, now, clock_.now());
    const bool drawn = !wall_.shows(state);
    wall_.begin(state, now, origin);
    figures_.begun(origin, {.level = eye.pose ? std::optional(eye.pose->level) : std::nullopt,
                            .drawn = drawn});
    publish_camera(state.eye_in_wall);
    if (captures_.empty()) return;
    captured_ = {.frame = {epoch_, wall_.newest(), state.eye_in_wall},
                 .asked = std::exchange(captures_, {})};
  }

  /// When all tiles have drawn the frame whose pictures they were to keep.
  void answer_captures() {
    if (captured_.asked.empty() || !wall_.open()) return;
    for (const CommandMessage& command : std::exchange(captured_.asked, {}))
      reply(command, true, text_of(captured_.frame));
  }

  void publish_camera(const Vec3& eye_in_wall) {
    const double half_width = site_.wall.grid.width_m / 2,
                 half_height = site_.wall.grid.height_m / 2;
    bus_->publish(CameraMessage{
        .number = figures_.frames(),
        .position_in_wall = eye_in_wall,
        .room_from_wall = site_.wall.room_from_wall.rotation,
        .frustum_m = {-half_width - eye_in_wall.x(), half_width - eye_in_wall.x(),
                      -half_height - eye_in_wall.y(), half_height - eye_in_wall.y()}});
  }

  void note_events() {
    for (const FrameSkew& skew : wall_.take_skews()) figures_.add(skew, clock_.now());
    for (const MemberEvent& event : wall_.take_events()) {
      figures_.add(event);
      const std::string what = fmt::format("{} at frame {}", name_of(event.change), event.number);
      if (event.change == MemberChange::evicted)
        log_warning(event.tile, fmt::format("{} after {:.0f} ms: the others go on", what,
                                            1e3 * seconds(event.waited)));
      else
        log_info(event.tile, what);
    }
  }

  void reply(const CommandMessage& command, bool done, const std::string& text) {
    if (command.request != 0) desk_.answer(command, done, text);
  }

  void answer(const CommandMessage& command) {
    try {
      obey(command);
    } catch (const Error& error) {
      reply(command, false, error.what());
    }
  }

  void obey(const CommandMessage& command) {
    switch (command.verb) {
      case Verb::show:
        return scenes_->show(command);
      case Verb::clip:
        scenes_->play(command.argument, clock_.now());
        break;
      case Verb::mode:
        set_mode(command.argument);
        asked_.mode = command.argument;
        break;
      case Verb::stop:
        stopped_ = true;
        break;
      case Verb::go_to:
        scenes_->go_to(command.argument, clock_.now());
        break;
      case Verb::capture:
        return captures_.push_back(command);
      case Verb::pattern:
      case Verb::overlay:
      case Verb::blank:
        note(command, asked_);
        break;
      case Verb::touch_page:
        page_.hear(command, clock_.now());
        break;
    }
    reply(command, true, "");
  }

  Duration display_latency() const { return from_seconds(1e-3 * site_.viewer.display_latency_ms); }

  MonotonicClock clock_;
  const Site& site_;
  const std::uint64_t epoch_ = new_epoch();
  const Participant self_{this_participant(Role::master, "master", site_, epoch_)};
  EmulatedRoom room_;
  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
  CommandDesk desk_{*bus_, "master"};
  WallMaster wall_;
  Vec3 eye_in_wall_;
  TouchEye touch_{*bus_, site_};
  HeadGestures gestures_;
  std::unique_ptr<EyeSource> path_;
  std::unique_ptr<RemoteEye> tracked_;  // cameras are opened once, by the mode track
  EyeSource* eyes_ = nullptr;
  StillEye still_{site_};
  PageOfConsole page_;
  std::vector<CommandMessage> captures_;  // for the next frame
  struct Captured {
    CapturedFrame frame;
    std::vector<CommandMessage> asked;  // answered when all tiles have drawn it
  } captured_;
  std::string path_file_;
  bool elsewhere_;
  Asked asked_;
  const Asked launched_;
  std::optional<WallScenes> scenes_;
  AskedFile kept_;
  bool was_before_ = false;  // a master of this launch, which crashed
  std::optional<Asked> kept_as_;
  std::optional<Participant> older_;  // to which it gives way
  bool stopped_ = false;
  SignOfLife sign_of_life_;
  WallFigures figures_;
};

int master(const MasterCommand& command) {
  const Site site = load_site(command.wall_file);
  const StopSignals signals;
  MasterRun run(command, site);
  const WallFigures& figures = run.run(signals, command.seconds);
  if (run.older()) {
    log_warning("master",
                fmt::format("another master of the wall \"{}\" runs on {}: end that one (vindu "
                            "stop), or give this wall another name in its [cluster]",
                            site.cluster.name, run.older()->host));
    return kInVain;
  }
  std::fputs((command.json ? figures.json() : figures.table()).c_str(), stdout);
  const bool in_time = command.seconds && seconds(figures.length) >= *command.seconds;
  if (!in_time || figures.shown()) return 0;
  log_warning("master", "no tile has shown anything: see what tiles say, or vindu status");
  return kInVain;
}

}  // namespace

void add_master(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<MasterCommand>();
  CLI::App* app = parent.add_subcommand(
      "master", "The wall's master: finds the eye, ticks, and holds the tiles together");
  app->add_option("MODEL", command->asked.model,
                  "Any model that Assimp reads (default: the wall file's, or the show)");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  add_place(*app, command->asked.place);
  add_clip(*app, command->asked.clip);
  app->add_option("--mode", command->asked.mode,
                  "track: the eye is tracked; touch: it follows a hand (vindu touch);\n"
                  "loop: it follows a path")
      ->check(CLI::IsMember({"track", "touch", "loop"}));
  app->add_option("--path", command->path_file, "Camera path of the mode loop")->type_name("FILE");
  app->add_option("--seconds", command->seconds, "Length (default: until it is stopped)")
      ->check(between(0.05, 1e8));
  app->add_option("--seed", command->seed, "Of the emulated cameras and the person before them")
      ->capture_default_str();
  app->add_flag("--tracker-elsewhere", command->tracker_elsewhere,
                "Leaves the wall file's cameras to vindu track --publish on another host;\n"
                "without it they are asked while no such tracker is heard");
  add_targets(*app, command->targets);
  add_pattern_choice(*app, command->asked.pattern);
  app->add_flag("--overlay", command->asked.overlay, "Tiles show their figures (vindu overlay on)");
  app->add_option("--csv", command->csv_file,
                  "Writes a line for each frame: its parts, motion to photon, skew")
      ->type_name("FILE");
  app->add_flag("--json", command->json, "Figures as JSON");
  app->add_option("--session", command->session,
                  "Of what starts a master again after a crash (vindu launch does): one with the\n"
                  "name of the one before goes on with what consoles asked of that")
      ->type_name("NAME");
  add_emulation(*app, command->emulation);
  app->footer(
      "\nExamples:\n"
      "  vindu master --wall wall.toml\n"
      "  vindu master model.glb --mode loop --seconds 60 --csv frames.csv\n");
  app->callback([command, &chosen] {
    refuse_late_presses(command->emulation, command->seconds);
    chosen = [command] { return master(*command); };
  });
}

}  // namespace vindu::app
