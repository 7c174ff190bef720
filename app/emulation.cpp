#include "app/emulation.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/error.h"

namespace vindu::app {
namespace {

constexpr Duration kPressed = std::chrono::milliseconds(300);

struct EmulatedButton {
  std::string_view name;
  std::uint8_t buttons_1 = 0;  // as in SensorView
  std::uint8_t buttons_2 = 0;
};
constexpr EmulatedButton kEmulatedButtons[] = {
    {"left", 0x01, 0}, {"right", 0x02, 0}, {"down", 0x04, 0}, {"up", 0x08, 0},
    {"plus", 0x10, 0}, {"two", 0, 0x01},   {"one", 0, 0x02},  {"b", 0, 0x04},
    {"a", 0, 0x08},    {"minus", 0, 0x10}, {"home", 0, 0x80}};

/// "home@2.5": of the first camera, 2.5 s after `start`. Empty for a text that is none.
std::optional<ButtonPress> press_from(std::string_view text, Time start) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view name = text.substr(0, at), when = text.substr(at + 1);
  double after_s = 0;
  const auto [end, error] = std::from_chars(when.data(), when.data() + when.size(), after_s);
  if (error != std::errc{} || end != when.data() + when.size()) return std::nullopt;
  if (!(after_s >= 0 && after_s < 1e8)) return std::nullopt;
  const Time from = start + from_seconds(after_s);
  for (const EmulatedButton& button : kEmulatedButtons)
    if (button.name == name)
      return ButtonPress{button.buttons_1, button.buttons_2, from, from + kPressed};
  return std::nullopt;
}

std::string refuse_press(const std::string& text) {
  if (press_from(text, Time{})) return "";
  return "\"" + text + "\" is no press; write BUTTON@SECONDS, as in home@2.5; buttons are left, " +
         "right, up, down, a, b, minus, home, plus, one, two";
}

}  // namespace

void add_emulation(CLI::App& app, EmulationOptions& options) {
  app.add_option("--link", options.link,
                 "Radio of emulated Wiimotes. good: evenly; busy: in bursts, as two on one "
                 "adapter;\nbad: also 5 % lost, and late")
      ->check(CLI::IsMember({"good", "busy", "bad"}))
      ->type_name("good|busy|bad");
  app.add_flag("--kernel", options.kernel,
               "Linux' own driver disturbs emulated Wiimotes; the battery is read every 10 s");
  app.add_option(
         "--people", options.people,
         "Who walk before emulated cameras, each with the helmet of a [[head]] (default: 1)")
      ->check(CLI::Range(1, 16));
  app.add_option("--press", options.presses,
                 "BUTTON@SECONDS, as in home@2.5: pressed then, for 0.3 s, on the first emulated\n"
                 "Wiimote; to be given any number of times")
      ->type_name("PRESS")
      ->allow_extra_args(false)
      ->check(refuse_press);
}

void refuse_late_presses(const EmulationOptions& options, const std::optional<double>& seconds) {
  if (!seconds) return;
  for (const std::string& press : options.presses)
    if (press_from(press, Time{})->from >= Time{from_seconds(*seconds)})
      throw CLI::ValidationError(
          "--press", fmt::format("{} comes after the end: --seconds {:g}; run longer, or press "
                                 "earlier",
                                 press, *seconds));
}

void apply(const EmulationOptions& options, Time now, EmulatedRoomOptions& room) {
  if (options.link == "busy") room.wiimote.link = two_on_one_adapter();
  if (options.link == "bad") room.wiimote.link = bad_link();
  room.wiimote.one_adapter = options.link != "good";
  room.wiimote.kernel = options.kernel;
  for (const std::string& press : options.presses)
    room.presses.push_back(press_from(press, now).value());
}

EmulatedRoomOptions walking_room(const EmulationOptions& options, const Site& site,
                                 std::uint64_t seed, Time now) {
  if (options.people > site.heads.size())
    throw Error({fmt::format("the wall file names {} for {} people",
                             site.heads.size() == 1 ? "one head"
                                                    : fmt::format("{} heads", site.heads.size()),
                             options.people),
                 "--people", "add a [[head]] with a layout of its own for each"});
  EmulatedRoomOptions room;
  room.people = options.people;
  room.person.seed = room.wiimote.seed = seed;
  room.person.start = now;
  apply(options, now, room);
  return room;
}

}  // namespace vindu::app
