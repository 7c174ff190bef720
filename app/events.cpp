// vindu events: what devices and people tell a running wall, as it comes: touches, gestures, what
// somebody keeps looking at.
#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/common.h"
#include "app/stop_signals.h"
#include "app/wall_console.h"
#include "cluster/dds.h"

namespace vindu::app {
namespace {

struct EventsCommand {
  std::string wall_file;
  std::optional<double> seconds;
  bool json = false;
};

std::string json_of(const EventMessage& event, Time came) {
  return fmt::format(
      R"({{"t_ns":{},"source":{},"kind":"{}","phase":"{}","id":{},"x_px":{:.1f},"y_px":{:.1f},)"
      R"("value":{:.3f},"text":{}}})",
      came.time_since_epoch().count(), json_text(event.source), name_of(event.kind),
      name_of(event.phase), event.id, event.x_px, event.y_px, event.value, json_text(event.text));
}

std::string line_of(const EventMessage& event, Duration since_start) {
  const std::string line =
      fmt::format("{:10.3f} s  {}  {}", seconds(since_start), event.source, name_of(event.kind));
  if (event.kind == EventKind::touch)
    return line + fmt::format(" {} {} at {:.0f}, {:.0f} px", event.id, name_of(event.phase),
                              event.x_px, event.y_px);
  if (event.kind == EventKind::key)
    return line +
           fmt::format(" {} {}", event.text, event.phase == EventPhase::end ? "let go" : "pressed");
  return line + fmt::format(" of {}: {} ({:.0f} %)", event.id, event.text, 100 * event.value);
}

int events(const EventsCommand& command) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const Site site = load_site(command.wall_file);
  const StopSignals signals;
  DdsTransport transport(network_of(site, Role::console));
  const auto bus = transport.join({this_console(site), {}, {Topic::event}});
  const MonotonicClock clock;
  const Time start = clock.now();
  while (!signals.came_within(Duration::zero()) &&
         !(command.seconds && seconds(clock.now() - start) > *command.seconds)) {
    bus->wait({Topic::event}, clock.now() + std::chrono::milliseconds(50));
    const Time now = clock.now();
    for (const EventMessage& event : bus->take<EventMessage>())
      std::puts((command.json ? json_of(event, now) : line_of(event, now - start)).c_str());
  }
  return 0;
}

}  // namespace

void add_events(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<EventsCommand>();
  CLI::App* app = parent.add_subcommand(
      "events",
      "What devices and people tell a running wall: touches, gestures, picks by looking, buttons");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_flag("--json", command->json, "A line of JSON for each, for other programs");
  app->add_option("--seconds", command->seconds, "Length (default: until it is stopped)")
      ->check(between(0.05, 1e8));
  app->footer(
      "\nGestures, picks and the buttons of Wiimotes come from whoever tracks: the master, or\n"
      "vindu track --publish; touches from vindu touch.\n"
      "\nExamples:\n"
      "  vindu events --wall wall.toml\n"
      "  vindu events --json | while read -r event; do echo \"$event\"; done\n");
  app->callback([command, &chosen] { chosen = [command] { return events(*command); }; });
}

}  // namespace vindu::app
