// vindu wiimote pair: bonds Wiimotes with this machine, over BlueZ; says what to press, what became
// of each, and which adapter is crowded.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/common.h"
#include "app/wiimote.h"
#include "core/error.h"
#include "core/log.h"
#include "tracker/wiimote/bluez_pair.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {
namespace {

struct Options {
  std::string adapter;
  int count = 1;
  double seconds = 60;
  bool json = false;
};

void print_json(const PairResult& result) {
  const BluezDevice& device = result.device;
  fmt::print(
      R"({{"address":{},"name":{},"adapter":{},"bonded":{},"connected":{},"ready":{},"trouble":{},)"
      R"("remedy":{}}})"
      "\n",
      json_text(device.address), json_text(device.name), json_text(device.adapter), device.paired,
      device.connected, result.ready(), json_text(result.trouble), json_text(result.remedy));
}

void print_line(const PairResult& result) {
  const BluezDevice& device = result.device;
  const std::string state = result.ready() ? "ready" : result.trouble + "; " + result.remedy;
  fmt::print("{}  {}  {}  {}\n", device.address, device.name, device.adapter, state);
}

/// Warns of those that are paired but may not be opened by this user.
void try_to_open(const std::vector<PairResult>& results, HidBus& hid) {
  for (const HidInfo& info : hid.list())
    for (const PairResult& result : results) {
      if (!result.ready() || !same_address(info.address, result.device.address)) continue;
      try {
        hid.open(info.path);
      } catch (const Error& error) {
        log_warning(result.device.address, error.what());
      }
    }
}

int pair(const Options& options) {
  MonotonicClock clock;
  const auto hid = make_hidapi_bus(clock);
  const std::vector<PairResult> results = pair_wiimotes({.adapter = options.adapter,
                                                         .count = options.count,
                                                         .patience = from_seconds(options.seconds)},
                                                        *hid, clock);
  for (const PairResult& result : results) options.json ? print_json(result) : print_line(result);
  for (const std::string& warning : adapter_warnings(bluez_wiimotes().wiimotes))
    log_warning("bluetooth", warning);
  try_to_open(results, *hid);
  if (results.empty())
    throw Error({fmt::format("no Wiimote was found for {:g} s", options.seconds), "bluetooth",
                 "press the red button under the battery lid: its lights blink while it can be "
                 "found; fresh batteries, and nearer to the adapter"});
  const auto ready = std::ranges::count_if(results, &PairResult::ready);
  return ready >= options.count ? 0 : 1;
}

}  // namespace

void add_wiimote_pair(CLI::App& wiimote, Action& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* app = wiimote.add_subcommand(
      "pair",
      "Bond new Wiimotes with this machine: start it, then press the red button under the\n"
      "battery lid. Once is enough: from then on any button connects. (1+2 does not bond: it\n"
      "would have to be pressed each time.)");
  app->add_option("--adapter", options->adapter,
                  "Bluetooth adapter (default: the one with the fewest Wiimotes)")
      ->type_name("hciN");
  app->add_option("--count", options->count, "How many Wiimotes")->check(CLI::Range(1, 16));
  app->add_option("--seconds", options->seconds, "How long to wait for each")
      ->check(between(1.0, 3600.0));
  app->add_flag("--json", options->json, "A line of JSON a Wiimote");
  app->footer(
      "\nExamples:\n"
      "  vindu wiimote pair\n"
      "  vindu wiimote pair --count 2\n"
      "  vindu wiimote pair --adapter hci1 --seconds 120\n");
  app->callback([options, &chosen] { chosen = [options] { return pair(*options); }; });
}

}  // namespace vindu::app
