// What the sub-commands of vindu wiimote share: the devices of this machine, or emulated ones for
// a machine without any.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/emulation.h"
#include "simulator/emulated_room.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/hid_device.h"
#include "tracker/wiimote/report.h"

namespace vindu::app {

/// The devices of this machine or, without hardware, those of the emulated room.
class WiimoteBus {
 public:
  explicit WiimoteBus(bool emulated, const EmulationOptions& emulation = {});

  HidBus& bus() { return room_ ? static_cast<HidBus&>(room_->bus()) : *real_; }
  Clock& clock() { return clock_; }

 private:
  MonotonicClock clock_;
  std::unique_ptr<EmulatedRoom> room_;
  std::unique_ptr<HidBus> real_;
};

/// --emulated
void add_emulated(CLI::App& app, bool& emulated);

/// The device of a number as `vindu wiimote list` shows it, from 1 on, or of an address. Throws
/// Error when there is none.
HidInfo choose_wiimote(HidBus& bus, const std::string& which);

/// Programs that have the device open, as "name (pid 123)": those that this user may see.
std::vector<std::string> holders_of(const std::string& path);

/// One Wiimote, as far as it is known.
struct WiimoteFinding {
  HidInfo info;
  std::string state = "ready";  ///< or what hinders it, with the remedy
  bool forbidden = false;       ///< it is there, but cannot be opened
  std::optional<StatusReport> status{};
  std::string adapter{};  ///< "hci0", where BlueZ knows it
};

/// Those that are connected; asks each for a sign of life.
std::vector<WiimoteFinding> examine_wiimotes(HidBus& bus, Clock& clock);
/// What Bluetooth knows: adds the adapters, and the Wiimotes that are not connected.
void add_bluetooth(const BluezView& view, std::vector<WiimoteFinding>& findings);

void add_wiimote_list(CLI::App& wiimote, Action& chosen);
void add_wiimote_identify(CLI::App& wiimote, Action& chosen);
void add_wiimote_watch(CLI::App& wiimote, Action& chosen);
void add_wiimote_emulate(CLI::App& wiimote, Action& chosen);
void add_wiimote_pair(CLI::App& wiimote, Action& chosen);

}  // namespace vindu::app
