// vindu wiimote: the parent of the sub-commands that see to Wiimotes, and what they share.
#include "app/wiimote.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "app/common.h"
#include "core/error.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/find.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 4 &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

bool has_open(const fs::path& process, const std::string& path) {
  std::error_code error;
  for (const auto& file : fs::directory_iterator(process / "fd", error))
    if (fs::read_symlink(file.path(), error) == path) return true;
  return false;
}

}  // namespace

WiimoteBus::WiimoteBus(bool emulated, const EmulationOptions& emulation) {
  EmulatedRoomOptions room;
  apply(emulation, clock_.now(), room);
  if (emulated)
    room_ = std::make_unique<EmulatedRoom>(load_site(""), clock_, room);
  else
    real_ = make_hidapi_bus(clock_);
}

void add_emulated(CLI::App& app, bool& emulated) {
  app.add_flag("--emulated", emulated,
               "Emulated Wiimotes that watch a simulated person, instead of this machine's");
}

HidInfo choose_wiimote(HidBus& bus, const std::string& which) {
  const std::vector<HidInfo> found = find_wiimotes(bus);
  const std::string remedy = "vindu wiimote list shows what there is";
  if (is_number(which)) {
    const auto index = static_cast<std::size_t>(std::stoi(which));
    if (index >= 1 && index <= found.size()) return found[index - 1];
    throw Error({fmt::format("there are {} Wiimotes", found.size()), "number " + which, remedy});
  }
  for (const HidInfo& info : found)
    if (same_address(info.address, which)) return info;
  throw Error({"no such Wiimote is connected", which, remedy});
}

std::vector<std::string> holders_of(const std::string& path) {
  std::vector<std::string> holders;
  std::error_code error;
  for (const auto& process : fs::directory_iterator("/proc", error)) {
    const std::string pid = process.path().filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos || !has_open(process.path(), path))
      continue;
    std::string name;
    std::getline(std::ifstream(process.path() / "comm"), name);
    holders.push_back(fmt::format("{} (pid {})", name, pid));
  }
  return holders;
}

void add_wiimote(CLI::App& parent, Action& chosen) {
  CLI::App* app =
      parent.add_subcommand("wiimote", "See to Wiimotes: list, identify, watch, pair, emulate");
  app->require_subcommand(1);
  add_wiimote_list(*app, chosen);
  add_wiimote_identify(*app, chosen);
  add_wiimote_watch(*app, chosen);
  add_wiimote_emulate(*app, chosen);
  add_wiimote_pair(*app, chosen);
  app->footer(
      "\nExamples:\n"
      "  vindu wiimote list\n"
      "  vindu wiimote identify 2\n"
      "  vindu wiimote watch --emulated\n"
      "  vindu wiimote pair\n");
}

}  // namespace vindu::app
