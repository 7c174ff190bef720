// vindu wiimote watch: what the Wiimotes see, live: in the terminal, in a window where there is a
// display, or as a line of JSON a report.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>

#include "app/buttons.h"
#include "app/common.h"
#include "app/stop_signals.h"
#include "app/wiimote.h"
#include "app/wiimote_screen.h"
#include "core/error.h"
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

/// One device and what it showed last. The reader's thread writes, the screen reads.
class Watched {
 public:
  Watched(WiimoteBus& devices, WiimoteClaims& claims, const HidInfo& info, int number,
          const WatchOptions& options)
      : title_(fmt::format("{}  {}", number, info.address.empty() ? info.path : info.address)),
        counted_at_(devices.clock().now()),
        live_(devices.bus(), devices.clock(), claims,
              {.camera = number - 1,
               .name = "Wiimote " + std::to_string(number),
               .address = info.address,
               .settings = settings_of(options, number),
               .on_sample = [this, number, json = options.json](
                                const WiimoteSample& sample) { take(number, json, sample); },
               .tap = {}}) {}

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
  void take(int number, bool json, const WiimoteSample& sample) {
    if (json) std::fputs(sample_json(number, sample).c_str(), stdout);
    const std::lock_guard lock(mutex_);
    data_ = sample.data;
    ++count_;
  }

  std::string title_;
  std::mutex mutex_;
  std::optional<DataReport> data_;
  std::uint64_t count_ = 0;
  std::uint64_t counted_ = 0;
  Time counted_at_;
  double rate_ = 0;
  LiveWiimote live_;  // last: its thread uses the others
};

/// A window that shows pictures.
class PictureWindow {
 public:
  explicit PictureWindow(SizePx size)
      : window_(make_window({.size = size, .title = "Vindu: Wiimotes"})), renderer_(Style::unlit) {}
  /// False when it was closed.
  bool show(const Image& image) {
    const SizePx size{image.width_px, image.height_px};
    if (!picture_ || picture_->size() != size)
      picture_ = std::make_unique<Picture>(size, Style::unlit);
    picture_->write(image);
    picture_->make_mipmaps();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, window_->size().width, window_->size().height);
    renderer_.present(*picture_, {});
    window_->present();
    return !window_->close_wanted();
  }

 private:
  std::unique_ptr<Window> window_;
  SceneRenderer renderer_;
  std::unique_ptr<Picture> picture_;
};

std::vector<HidInfo> chosen_devices(HidBus& bus, const WatchOptions& options) {
  if (options.which.empty()) {
    std::vector<HidInfo> all = find_wiimotes(bus);
    if (all.empty())
      throw Error({"no Wiimote is connected", "this machine",
                   "press a button on a paired one, or try --emulated"});
    return all;
  }
  std::vector<HidInfo> found;
  for (const std::string& which : options.which) found.push_back(choose_wiimote(bus, which));
  return found;
}

int watch(const WatchOptions& options) {
  const StopSignals signals;
  WiimoteBus devices(options.emulated, options.emulation);
  WiimoteClaims claims;
  std::vector<std::unique_ptr<Watched>> watched;
  for (const HidInfo& info : chosen_devices(devices.bus(), options))
    watched.push_back(std::make_unique<Watched>(devices, claims, info,
                                                static_cast<int>(watched.size()) + 1, options));
  std::optional<PictureWindow> window;
  if (!options.json && !options.no_window && has_display())
    window.emplace(SizePx{560 * static_cast<int>(watched.size()), 574});
  const bool terminal = !options.json && isatty(STDOUT_FILENO);
  constexpr Duration kPeriod = std::chrono::milliseconds(50);
  const Time begin = devices.clock().now();
  Time summed_up = begin;
  bool open = true;
  while (open && !signals.came_within(kPeriod)) {
    const Time now = devices.clock().now();
    if (options.seconds && seconds(now - begin) >= *options.seconds) break;
    std::vector<WatchedWiimote> seen;
    for (const auto& each : watched) seen.push_back(each->seen_at(now));
    if (window) open = window->show(screen_picture(seen));
    if (terminal) fmt::print("\x1b[H\x1b[2J{}", screen_text(seen));
    if (!terminal && !options.json && now - summed_up >= std::chrono::seconds(1)) {
      for (const WatchedWiimote& each : seen) fmt::print("{}  {}\n", each.title, summary_of(each));
      summed_up = now;
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

void add_wiimote_watch(CLI::App& wiimote, Action& chosen) {
  auto options = std::make_shared<WatchOptions>();
  CLI::App* app = wiimote.add_subcommand("watch", "Live dots, buttons and accelerometer");
  app->add_option("WIIMOTE", options->which,
                  "Numbers as list shows them, or addresses (default: all)");
  app->add_option("--format", options->format, "Of the dots; full has blobs and half the rate")
      ->check(CLI::IsMember({"basic", "extended", "full"}));
  app->add_option("--sensitivity", options->sensitivity,
                  "wii-1 to wii-5, marcan, inio, maximum, or 22 hexadecimal digits")
      ->check(check_sensitivity);
  app->add_option("--seconds", options->seconds, "Length (default: until Ctrl-C)")
      ->check(between(0.05, 1e6));
  app->add_flag("--json", options->json, "A line of JSON a report, nothing else");
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
  app->callback([options, &chosen] { chosen = [options] { return watch(*options); }; });
}

}  // namespace vindu::app
