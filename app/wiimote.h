// What the sub-commands of vindu wiimote share: the devices of this machine, or emulated ones for
// a machine without any.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.h"
#include "app/emulation.h"
#include "simulator/emulated_room.h"
#include "tracker/wiimote/hid_device.h"

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

void add_wiimote_list(CLI::App& wiimote, Action& chosen);
void add_wiimote_identify(CLI::App& wiimote, Action& chosen);
void add_wiimote_watch(CLI::App& wiimote, Action& chosen);
void add_wiimote_emulate(CLI::App& wiimote, Action& chosen);
void add_wiimote_pair(CLI::App& wiimote, Action& chosen);

}  // namespace vindu::app
