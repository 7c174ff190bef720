// vindu wiimote watch: what the Wiimotes see, live: in the terminal, in a window where there is a
// display, or as a line of JSON a report.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>

#include "app/buttons.h"
#include "app/cameras.h"
#include "app/common.h"
#include "app/stop_signals.h"
#include "app/wiimote.h"
#include "app/wiimote_findings.h"
#include "app/wiimote_screen.h"
#include "core/log.h"
#include "renderer/scene_renderer.h"
#include "renderer/surface.h"
#include "tracker/wiimote/find.h"

namespace vindu::app {
namespace {

struct WatchOptions {
  std::vector<std::string> which;
  std::string format = "extended";
  std::string sensitivity = kDefaultSensitivity;
  std::optional<double> seconds;
  bool emulated = false;
  EmulationOptions emulation;
  bool json = false;
  bool no_window = false;
};

WiimoteSettings settings_of(const WatchOptions& options, int number) {
  return {.format = *ir_format_from(options.format),
          .sensitivity = *sensitivity_from(options.sensitivity),
          .player = number};
}

/// What is wrong with it; empty when it is one.
std::string check_sensitivity(const std::string& text) {
  if (sensitivity_from(text)) return {};
  return "\"" + text + "\" is not known; allowed: " + sensitivity_names() +
         ", or 22 hexadecimal digits (blocks 1 and 2)";
}

std::string slots_json(const std::optional<IrSlots>& slots) {
  if (!slots) return "null";
  std::string text;
  for (const auto& slot : *slots) {
    text += text.empty() ? "[" : ",";
    text += slot ? fmt::format(R"({{"x":{},"y":{},"size":{}}})", slot->x_px, slot->y_px, slot->size)
                 : "null";
  }
  return text + "]";
}

std::string buttons_json(Buttons buttons) {
  std::string text = text_of(buttons);
  if (text == "-") return "[]";
  for (std::size_t at = 0; (at = text.find('+', at)) != std::string::npos; at += 3)
    text.replace(at, 1, "\",\"");
  return "[\"" + text + "\"]";
}

std::string sample_json(int device, const WiimoteSample& sample) {
  const auto& raw = sample.data.acceleration_raw;
  return fmt::format(
      R"({{"device":{},"sequence":{},"t_ns":{},"slots":{},"buttons":{},"acceleration_raw":{}}})"
      "\n",
      device, sample.sequence, sample.arrival.time_since_epoch().count(),
      slots_json(sample.data.slots), buttons_json(sample.data.buttons),
      raw ? fmt::format("[{},{},{}]", (*raw)[0], (*raw)[1], (*raw)[2]) : "null");
}

std::string counts_json(int device, const LiveWiimoteState& state) {
  const WiimoteHealth& health = state.health;
  return fmt::format(
      R"({{"device":{},"samples":{},"starts":{},"repeated":{},"refused":{},"lone":{},"dropped":{},)"
      R"("gaps":{},"trouble":{}}})"
      "\n",
      device, health.samples, health.starts, health.repeated, health.refused, health.lone,
      state.dropped, json_of(health.gaps), json_text(state.trouble));
}

/// One device and what it showed last. The reader's thread writes, the screen reads.
class Watched {
 public:
  Watched(WiimoteBus& devices, WiimoteClaims& claims, const NumberedWiimote& wiimote,
          const WatchOptions& options)
      : number_(wiimote.number),
        title_(fmt::format("{}  {}", wiimote.number, label_of(wiimote.info))),
        counted_at_(devices.clock().now()),
        live_(devices.bus(), devices.clock(), claims,
              {.camera = wiimote.number - 1,
               .name = "Wiimote " + std::to_string(wiimote.number),
               .address = wiimote.info.address,
               .path = wiimote.info.path,
               .settings = settings_of(options, wiimote.number),
               .on_sample =
                   [this, json = options.json](const WiimoteSample& sample) { take(json, sample); },
               .tap = {}}) {}

  int number() const { return number_; }
  LiveWiimoteState state() const { return live_.state(); }
  WatchedWiimote seen_at(Time now) {
    while (live_.next(Time::max())) continue;  // nobody else takes them
    const LiveWiimoteState state = live_.state();
    const std::lock_guard lock(mutex_);
    if (const double span_s = seconds(now - counted_at_); span_s >= 1) {
      rate_ = static_cast<double>(count_ - std::exchange(counted_, count_)) / span_s;
      counted_at_ = now;
    }
    return {title_, state, data_, rate_};
  }

 private:
  void take(bool json, const WiimoteSample& sample) {
    if (json) std::fputs(sample_json(number_, sample).c_str(), stdout);
    const std::lock_guard lock(mutex_);
    data_ = sample.data;
    ++count_;
  }

  int number_;
  std::string title_;
  std::mutex mutex_;
  std::optional<DataReport> data_;
  std::uint64_t count_ = 0;
  std::uint64_t counted_ = 0;
  Time counted_at_;
  double rate_ = 0;
  LiveWiimote live_;  // last: its thread uses the others
};

/// A window that shows pictures of one size.
class PictureWindow {
 public:
  explicit PictureWindow(SizePx size)
      : window_(make_window({.size = size, .title = "Vindu: Wiimotes"})),
        renderer_(Style::unlit),
        picture_(size, Style::unlit) {}

  SizePx picture_size() const { return picture_.size(); }
  /// False when it was closed.
  bool show(const Image& image) {
    picture_.write(image);
    picture_.make_mipmaps();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, window_->size().width, window_->size().height);
    renderer_.present(picture_, {});
    window_->present();
    return !window_->close_wanted();
  }

 private:
  std::unique_ptr<Window> window_;
  SceneRenderer renderer_;
  Picture picture_;
};

/// Where people see them: the terminal, or a line a second where there is none, and a window where
/// there is a display. Nowhere beside lines of JSON.
class WatchScreen {
 public:
  WatchScreen(const WatchOptions& options, Time now)
      : windowed_(!options.json && !options.no_window && has_display()),
        terminal_(!options.json && isatty(STDOUT_FILENO)),
        lines_(!options.json && !terminal_),
        lines_at_(now) {}

  /// False when its window was closed.
  bool show(const std::vector<WatchedWiimote>& seen, Time now) {
    if (terminal_ && !seen.empty()) fmt::print("\x1b[H\x1b[2J{}", screen_text(seen));
    if (lines_ && now - lines_at_ >= std::chrono::seconds(1)) {
      for (const WatchedWiimote& each : seen) fmt::print("{}  {}\n", each.title, summary_of(each));
      lines_at_ = now;
    }
    std::fflush(stdout);
    return !windowed_ || show_picture(screen_picture(seen));
  }

 private:
  bool show_picture(const Image& image) {
    const SizePx size{image.width_px, image.height_px};
    if (!window_ || window_->picture_size() != size) window_.emplace(size);
    return window_->show(image);
  }

  bool windowed_, terminal_, lines_;
  Time lines_at_;
  std::optional<PictureWindow> window_;
};

/// The devices that are watched; where none was named, also those that connect later.
class Watch {
 public:
  explicit Watch(const WatchOptions& options)
      : options_(options), devices_(options.emulated, options.emulation) {
    for (const std::string& which : options_.which) add(choose_wiimote(devices_.bus(), which));
    look_for_more(now());
    if (known_.empty())
      log_warning("wiimote",
                  "none is connected yet: press a button on a paired one, or try "
                  "--emulated");
  }

  Time now() { return devices_.clock().now(); }

  /// What each stream was like, a line each.
  std::string counts_json() const {
    std::string lines;
    for (const auto& each : watched_) lines += app::counts_json(each->number(), each->state());
    return lines;
  }

  std::vector<WatchedWiimote> seen_at(Time now) {
    if (now - looked_at_ >= kLookEvery) look_for_more(now);
    std::vector<WatchedWiimote> seen;
    for (const auto& each : watched_) seen.push_back(each->seen_at(now));
    return seen;
  }

 private:
  static constexpr Duration kLookEvery = std::chrono::seconds(1);

  void look_for_more(Time now) {
    looked_at_ = now;
    if (!options_.which.empty()) return;
    for (const NumberedWiimote& each : newcomers(devices_.bus(), devices_.clock(), known_))
      add(each);
  }
  void add(const NumberedWiimote& wiimote) {
    known_.push_back(wiimote);
    watched_.push_back(std::make_unique<Watched>(devices_, claims_, wiimote, options_));
  }

  const WatchOptions& options_;
  WiimoteBus devices_;
  WiimoteClaims claims_;
  std::vector<NumberedWiimote> known_;
  std::vector<std::unique_ptr<Watched>> watched_;
  Time looked_at_{};
};

int watch(const WatchOptions& options) {
  const StopSignals signals;
  Watch watched(options);
  const Time begin = watched.now();
  WatchScreen screen(options, begin);
  constexpr Duration kPeriod = std::chrono::milliseconds(50);
  while (!signals.came_within(kPeriod)) {
    const Time now = watched.now();
    if (options.seconds && seconds(now - begin) >= *options.seconds) break;
    if (!screen.show(watched.seen_at(now), now)) break;
  }
  if (options.json) fmt::print("{}", watched.counts_json());
  return 0;
}

}  // namespace

void add_wiimote_watch(CLI::App& wiimote, Action& chosen) {
  auto options = std::make_shared<WatchOptions>();
  CLI::App* app = wiimote.add_subcommand("watch", "Live dots, buttons and accelerometer");
  app->add_option("WIIMOTE", options->which,
                  "Numbers as list shows them, or addresses (default: all, also later ones)");
  app->add_option("--format", options->format,
                  "Of the dots; full has blobs and half the rate (default: extended)")
      ->check(CLI::IsMember({"basic", "extended", "full"}));
  app->add_option("--sensitivity", options->sensitivity,
                  "wii-1 to wii-5, marcan, inio, maximum, or 22 hexadecimal digits\n"
                  "(default: " +
                      std::string(kDefaultSensitivity) + ")")
      ->check(check_sensitivity);
  app->add_option("--seconds", options->seconds, "Length (default: until Ctrl-C)")
      ->check(between(0.05, 1e6));
  app->add_flag("--json", options->json,
                "A line of JSON a report, and at the end one a device with its counts");
  app->add_flag("--no-window", options->no_window, "No window, also where there is a display");
  add_emulated(*app, options->emulated);
  add_emulation(*app, options->emulation);
  for (const char* name : {"--link", "--kernel"})
    app->get_option(name)->needs(app->get_option("--emulated"));
  app->footer(
      "\nExamples:\n"
      "  vindu wiimote watch\n"
      "  vindu wiimote watch 2 --sensitivity wii-5\n"
      "  vindu wiimote watch --emulated --json --seconds 2\n"
      "  vindu wiimote watch --emulated --link bad --kernel\n");
  app->callback([options, &chosen] {
    refuse_late_presses(options->emulation, options->seconds);
    chosen = [options] { return watch(*options); };
  });
}

}  // namespace vindu::app
