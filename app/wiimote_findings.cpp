#include "app/wiimote_findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "tracker/wiimote/find.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

constexpr Duration kPatience = std::chrono::milliseconds(600);

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

/// Programs that have the device open, as "name (pid 123)": those that this user may see.
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

bool is_of(const Site& site, const HidInfo& info) {
  return std::ranges::any_of(site.cameras, [&](const CameraConfig& camera) {
    return camera.source == CameraSource::wiimote &&
           (camera.address.empty() || camera.address == info.address);
  });
}

std::vector<NumberedWiimote> numbered_wiimotes(HidBus& bus) {
  std::vector<NumberedWiimote> numbered;
  for (HidInfo& info : find_wiimotes(bus))
    numbered.push_back({static_cast<int>(numbered.size()) + 1, std::move(info)});
  return numbered;
}

/// One that may not be opened counts as there: whoever wants it is told what hinders it.
bool is_empty_slot(HidBus& bus, Clock& clock, const HidInfo& info) {
  if (kind_of(info) != WiimoteKind::adapter) return false;
  try {
    return !probe(*bus.open(info.path), clock, kPatience);
  } catch (const Error&) {
    return false;
  }
}

WiimoteFinding examine(HidBus& bus, Clock& clock, const HidInfo& info) {
  WiimoteFinding finding{.info = info};
  const std::vector<std::string> holders = holders_of(info.path);
  if (!holders.empty()) {
    finding.state = fmt::format("in use by {}: end that first", fmt::join(holders, ", "));
    return finding;
  }
  try {
    finding.status = probe(*bus.open(info.path), clock, kPatience);
    if (!finding.status)
      finding.state = kind_of(info) == WiimoteKind::adapter
                          ? "an empty slot"
                          : "does not answer: press a button on it, or take out its batteries";
  } catch (const Error& error) {
    finding.state = error.what();
    finding.forbidden = true;
  }
  return finding;
}

/// What is known of a connected one besides what itself said.
void add_connection(const BluezDevice& known, WiimoteFinding& finding) {
  finding.adapter = known.adapter;
  if (!known.paired && finding.state == "ready")
    finding.state =
        "not bonded: 1+2 has to be pressed each time; vindu wiimote pair bonds it for good";
}

const char* state_of_absent(const BluezDevice& known) {
  if (!known.paired) return "not bonded: vindu wiimote pair";
  return known.connected ? "connected, but no HID device: vindu wiimote pair"
                         : "bonded, not connected: press a button on it";
}

}  // namespace

std::vector<std::string> wiimotes_in_use(HidBus& bus, const Site& site) {
  std::vector<std::string> lines;
  for (const HidInfo& info : find_wiimotes(bus)) {
    if (!is_of(site, info)) continue;
    const std::vector<std::string> holders = holders_of(info.path);
    if (!holders.empty())
      lines.push_back(
          fmt::format("{} is in use by {}, too", label_of(info), fmt::join(holders, ", ")));
  }
  return lines;
}

NumberedWiimote choose_wiimote(HidBus& bus, const std::string& which) {
  const std::vector<NumberedWiimote> found = numbered_wiimotes(bus);
  for (const NumberedWiimote& each : found)
    if (is_number(which) ? each.number == std::stoi(which)
                         : !which.empty() && same_address(each.info.address, which))
      return each;
  const std::string remedy = "vindu wiimote list shows what there is";
  if (is_number(which))
    throw Error({fmt::format("there are {} Wiimotes", found.size()), "number " + which, remedy});
  throw Error({"no such Wiimote is connected", which, remedy});
}

std::vector<NumberedWiimote> newcomers(HidBus& bus, Clock& clock,
                                       std::vector<NumberedWiimote> known) {
  const auto known_before = static_cast<std::ptrdiff_t>(known.size());
  for (NumberedWiimote& each : numbered_wiimotes(bus)) {
    const bool is_known = std::ranges::any_of(known, [&](const NumberedWiimote& other) {
      return label_of(other.info) == label_of(each.info);
    });
    if (is_known || is_empty_slot(bus, clock, each.info)) continue;
    while (std::ranges::find(known, each.number, &NumberedWiimote::number) != known.end())
      ++each.number;
    known.push_back(std::move(each));
  }
  return {known.begin() + known_before, known.end()};
}

std::vector<WiimoteFinding> examine_wiimotes(HidBus& bus, Clock& clock) {
  std::vector<WiimoteFinding> findings;
  for (const HidInfo& info : find_wiimotes(bus)) findings.push_back(examine(bus, clock, info));
  return findings;
}

void add_bluetooth(const BluezView& view, std::vector<WiimoteFinding>& findings) {
  for (const BluezDevice& known : view.wiimotes) {
    const auto found = std::ranges::find_if(findings, [&](const WiimoteFinding& finding) {
      return same_address(finding.info.address, known.address);
    });
    if (found == findings.end())
      findings.push_back({.info = {"", 0x057e, 0x0306, known.name, known.address},
                          .state = state_of_absent(known),
                          .adapter = known.adapter});
    else if (known.connected)
      add_connection(known, *found);
  }
}

}  // namespace vindu::app
