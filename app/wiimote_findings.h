// Which Wiimotes a machine has, by what numbers people call them, how they are and what hinders
// them: what vindu wiimote list, identify, watch and vindu doctor have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/hid_device.h"
#include "tracker/wiimote/report.h"

namespace vindu::app {

/// A connected Wiimote or a slot of an adapter, with its number as `vindu wiimote list` shows it,
/// from 1 on.
struct NumberedWiimote {
  int number = 0;
  HidInfo info;
};

/// A line for each of the site's that another program of this machine has open.
std::vector<std::string> wiimotes_in_use(HidBus& bus, const Site& site);

/// The one of a number or of an address. Throws Error when there is none.
NumberedWiimote choose_wiimote(HidBus& bus, const std::string& which);

/// Those that can be watched and are not among the `known`: empty slots are left out. Where a known
/// one has its number already, a newcomer gets the next that is free.
std::vector<NumberedWiimote> newcomers(HidBus& bus, Clock& clock,
                                       std::vector<NumberedWiimote> known);

/// One Wiimote, as far as it is known.
struct WiimoteFinding {
  HidInfo info;
  std::string state = "ready";  ///< or what hinders it, with the remedy
  bool forbidden = false;       ///< it is there, but cannot be opened
  std::optional<StatusReport> status{};
  std::string adapter{};  ///< "hci0", where BlueZ knows it
};

/// Those that are connected, in the order of their numbers; asks each for a sign of life.
std::vector<WiimoteFinding> examine_wiimotes(HidBus& bus, Clock& clock);
/// What Bluetooth knows: adds the adapters, who has no bond, and the Wiimotes that are not
/// connected.
void add_bluetooth(const BluezView& view, std::vector<WiimoteFinding>& findings);

}  // namespace vindu::app
