// vindu wiimote emulate: emulated Wiimotes as real HID devices of this machine, that watch the
// simulated person from where the wall file's cameras stand. Any program can use them, Vindu's own
// driver among them, with the kernel's hid-wiimote in between. Needs Linux' /dev/uhid.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <thread>

#include "app/common.h"
#include "app/stop_signals.h"
#include "app/wiimote.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/resources.h"
#include "simulator/emulated_wiimote.h"
#include "tracker/wiimote/uhid_device.h"

namespace vindu::app {
namespace {

using namespace std::chrono_literals;

constexpr Duration kAway = 2s;  ///< between unplugging and returning

struct EmulateOptions {
  std::string wall_file;
  std::string product = "0306";
  std::optional<int> count;
  std::optional<double> seconds;
  std::optional<double> unplug_every_s;
  std::uint64_t seed = 52;
};

std::vector<std::uint8_t> read_asset(const std::string& name) {
  const std::string path = find_asset("wiimote/" + name);
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(file), {});
  if (bytes.empty()) throw Error({"cannot be read", path, "install Vindu again"});
  return bytes;
}

/// What all of them share; immutable.
struct Room {
  Room(const EmulateOptions& wanted)
      : options(wanted),
        site(load_site(wanted.wall_file)),
        person(site.heads.front(), site.wall.room_from_wall,
               {.seed = wanted.seed, .start = MonotonicClock().now()}),
        descriptor(read_asset("rdesc.bin")),
        eeprom(read_asset("eeprom.bin")) {
    if (site.cameras.empty())
      throw Error({"names no [[camera]]", wanted.wall_file,
                   "add one for each Wiimote, with its place in the room"});
  }

  EmulateOptions options;
  Site site;
  Person person;
  std::vector<std::uint8_t> descriptor;
  std::vector<std::uint8_t> eeprom;
};

/// The first ones stand where the site's cameras do, further ones beside them again.
HidInfo identity_of(const Room& room, int index) {
  const CameraConfig& camera = room.site.cameras[index % room.site.cameras.size()];
  const bool own = !camera.address.empty() && index < std::ssize(room.site.cameras);
  const bool tr = room.options.product == "0330";
  return {.path = {},
          .vendor_id = 0x057e,
          .product_id = static_cast<std::uint16_t>(tr ? 0x0330 : 0x0306),
          .name = tr ? "Nintendo RVL-CNT-01-TR" : "Nintendo RVL-CNT-01",
          .address = own ? camera.address : fmt::format("00:1f:c5:00:00:{:02x}", index + 1)};
}

WiimoteEmulator switch_on(const Room& room, int index) {
  const CameraConfig& camera = room.site.cameras[index % room.site.cameras.size()];
  constexpr double kNoise_px = 0.3;
  EmulatedSensor sensor(camera, room.site.heads.front(), kNoise_px, room.options.seed + index + 1);
  return WiimoteEmulator(
      {.eeprom = room.eeprom,
       .motion_plus = room.options.product == "0330",
       .start = MonotonicClock().now()},
      [&room, sensor](Time time) mutable { return sensor.view(room.person.room_from_head(time)); });
}

/// Plugged in from here until it is unplugged by plan, or all end.
void play_once(const Room& room, int index, Time until, const std::stop_token& stop) {
  const MonotonicClock clock;
  const HidInfo identity = identity_of(room, index);
  WiimoteEmulator wiimote = switch_on(room, index);
  UhidDevice device(identity, room.descriptor);
  log_info(identity.address, "plugged in");
  const auto tap = [&](std::span<const std::uint8_t> report) {
    log_debug(identity.address, fmt::format("is told {:02x}", fmt::join(report, " ")));
  };
  while (!stop.stop_requested() && clock.now() < until)
    if (!serve(wiimote, device, std::min(until, clock.now() + 50ms), tap)) break;
  log_info(identity.address, "unplugged");
}

/// They are unplugged in turn, not all at once.
void play(const Room& room, int index, int count, const std::stop_token& stop) {
  MonotonicClock clock;
  if (!room.options.unplug_every_s) return play_once(room, index, Time::max(), stop);
  const Duration every = from_seconds(*room.options.unplug_every_s);
  Time unplugged = clock.now() + (index + 1) * every;
  while (!stop.stop_requested()) {
    play_once(room, index, unplugged, stop);
    const Time back = clock.now() + kAway;
    while (!stop.stop_requested() && clock.now() < back) clock.sleep_until(clock.now() + 50ms);
    unplugged += std::max(count * every, every + kAway);
  }
}

int emulate(const EmulateOptions& options) {
  const StopSignals signals;
  const Room room(options);
  const int count = options.count.value_or(static_cast<int>(room.site.cameras.size()));
  std::exception_ptr failure;
  std::atomic<bool> failed = false;
  {
    std::vector<std::jthread> wiimotes;
    for (int index = 0; index < count; ++index)
      wiimotes.emplace_back([&, index](const std::stop_token& stop) {
        try {
          play(room, index, count, stop);
        } catch (...) {
          if (!failed.exchange(true)) failure = std::current_exception();
        }
      });
    const Time end =
        options.seconds ? MonotonicClock().now() + from_seconds(*options.seconds) : Time::max();
    while (!failed && MonotonicClock().now() < end && !signals.came_within(100ms)) {
    }
    for (std::jthread& wiimote : wiimotes) wiimote.request_stop();
  }
  if (failure) std::rethrow_exception(failure);
  return 0;
}

}  // namespace

void add_wiimote_emulate(CLI::App& wiimote, Action& chosen) {
  auto options = std::make_shared<EmulateOptions>();
  CLI::App* app = wiimote.add_subcommand(
      "emulate", "Emulated Wiimotes as real HID devices of this machine, until Ctrl-C");
  app->add_option("--count", options->count,
                  "How many (default: one for each camera of the wall file)")
      ->check(CLI::Range(1, 16));
  app->add_option("--product", options->product, "0306: RVL-CNT-01; 0330: RVL-CNT-01-TR")
      ->check(CLI::IsMember({"0306", "0330"}));
  app->add_option("--wall", options->wall_file,
                  "Wall file: where the cameras stand (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_option("--seconds", options->seconds, "End after this time")->check(between(0.1, 1e7));
  app->add_option("--unplug-every", options->unplug_every_s,
                  "Every so many seconds one of them goes away for two seconds")
      ->type_name("S")
      ->check(between(3.0, 1e6));
  app->add_option("--seed", options->seed, "Of the walk and of the cameras' noise")
      ->capture_default_str();
  app->footer(
      "\nNeeds /dev/uhid, as root: sudo modprobe uhid. With --verbose every report that somebody\n"
      "writes to one of them is shown, the kernel's own among them.\n"
      "\nExamples:\n"
      "  sudo vindu wiimote emulate\n"
      "  sudo vindu wiimote emulate --count 4 --product 0330 --unplug-every 30\n");
  app->callback([options, &chosen] { chosen = [options] { return emulate(*options); }; });
}

}  // namespace vindu::app
