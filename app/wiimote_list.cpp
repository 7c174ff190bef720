// vindu wiimote list and identify: which Wiimotes this machine has, how they are, what hinders
// them; and which of them is which.
#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "app/common.h"
#include "app/wiimote.h"
#include "app/wiimote_findings.h"
#include "core/error.h"
#include "core/log.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/commands.h"
#include "tracker/wiimote/find.h"

namespace vindu::app {
namespace {

std::string battery_text(const std::optional<StatusReport>& status) {
  if (!status) return "";
  return fmt::format("{:.0f} %{}", 100 * battery_charge(status->battery),
                     status->battery_low ? ", low" : "");
}

void print_table(const std::vector<WiimoteFinding>& findings) {
  if (findings.empty()) {
    std::puts(
        "No Wiimote is known here. Pair one: vindu wiimote pair. Without any hardware:\n"
        "vindu wiimote watch --emulated");
    return;
  }
  constexpr const char* kLine = "{:>2}  {:<17}  {:<13}  {:<7}  {:<14}  {:<9}  {}\n";
  fmt::print(kLine, "", "address", "kind", "adapter", "device", "battery", "state");
  int number = 0;
  for (const WiimoteFinding& finding : findings)
    fmt::print(kLine, ++number, finding.info.address, name_of(kind_of(finding.info)),
               finding.adapter, finding.info.path, battery_text(finding.status), finding.state);
}

void print_json(const std::vector<WiimoteFinding>& findings) {
  for (const WiimoteFinding& finding : findings) {
    const std::string battery =
        finding.status ? fmt::format("{:.3f}", battery_charge(finding.status->battery)) : "null";
    fmt::print(R"({{"address":{},"kind":{},"adapter":{},"path":{},"battery":{},"state":{}}})"
               "\n",
               json_text(finding.info.address), json_text(name_of(kind_of(finding.info))),
               json_text(finding.adapter), json_text(finding.info.path), battery,
               json_text(finding.state));
  }
}

int list(bool emulated, bool json) {
  WiimoteBus devices(emulated);
  std::vector<WiimoteFinding> findings = examine_wiimotes(devices.bus(), devices.clock());
  if (!emulated) {
    const BluezView view = bluez_wiimotes();
    add_bluetooth(view, findings);
    for (const std::string& warning : adapter_warnings(view.wiimotes))
      log_warning("wiimote", warning);
    if (!view.trouble.empty()) log_warning("Bluetooth", view.trouble);
  }
  json ? print_json(findings) : print_table(findings);
  return 0;
}

/// Rumbles and lets the LEDs run to and fro, then shows `number`.
int identify(const std::string& which, bool emulated, double seconds) {
  WiimoteBus devices(emulated);
  const auto [number, info] = choose_wiimote(devices.bus(), which);
  const auto device = devices.bus().open(info.path);
  constexpr std::array<int, 6> kRun = {1, 2, 4, 8, 4, 2};
  constexpr Duration kStep = std::chrono::milliseconds(150);
  fmt::print("Wiimote {} rumbles and its LEDs run to and fro.\n", label_of(info));
  const int steps = static_cast<int>(seconds / 0.15);
  for (int step = 0; step < steps; ++step) {
    const bool rumble = step % 6 < 3;
    if (!device->write(set_leds(kRun[static_cast<std::size_t>(step) % kRun.size()], rumble).span()))
      throw Error({"takes no commands", label_of(info), "press a button on it and try again"});
    devices.clock().sleep_until(devices.clock().now() + kStep);
  }
  device->write(set_leds(player_leds(number), false).span());
  return 0;
}

}  // namespace

void add_wiimote_list(CLI::App& wiimote, Action& chosen) {
  struct Options {
    bool emulated = false, json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* app = wiimote.add_subcommand(
      "list", "The connected Wiimotes: address, kind, battery, and what hinders them");
  add_emulated(*app, options->emulated);
  app->add_flag("--json", options->json, "A line of JSON a Wiimote");
  app->footer(
      "\nExamples:\n"
      "  vindu wiimote list\n"
      "  vindu wiimote list --json\n"
      "  vindu wiimote list --emulated\n");
  app->callback([options, &chosen] {
    chosen = [options] { return list(options->emulated, options->json); };
  });
}

void add_wiimote_identify(CLI::App& wiimote, Action& chosen) {
  struct Options {
    std::string which;
    bool emulated = false;
    double seconds = 3;
  };
  auto options = std::make_shared<Options>();
  CLI::App* app = wiimote.add_subcommand("identify", "Rumble one and let its LEDs run");
  app->add_option("WIIMOTE", options->which, "Number as list shows it, or address")->required();
  app->add_option("--seconds", options->seconds, "How long (default: 3)")
      ->check(between(0.2, 60.0));
  add_emulated(*app, options->emulated);
  app->footer(
      "\nExamples:\n"
      "  vindu wiimote identify 2\n"
      "  vindu wiimote identify 00:1f:c5:1b:3a:b1 --seconds 10\n"
      "  vindu wiimote identify 1 --emulated\n");
  app->callback([options, &chosen] {
    chosen = [options] { return identify(options->which, options->emulated, options->seconds); };
  });
}

}  // namespace vindu::app
