// Pairs Wiimotes that are in discovery, over BlueZ: bond, trust, connect, wait for the HID device.
// Source: BlueZ' plugins/wiimote.c, which supplies the PIN that the red button asks for and says
// that the input service has to be connected at once, or the Wiimote switches itself off.
#pragma once

#include <string>
#include <vector>

#include "core/clock.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

struct PairOptions {
  std::string adapter = {};                     ///< "hci1"; empty: the one with the fewest Wiimotes
  int count = 1;                                ///< how many to pair
  Duration patience = std::chrono::minutes(1);  ///< without any that gets ready
  Duration hid_wait = std::chrono::seconds(6);  ///< from the connection to the HID device
};

/// What became of one Wiimote.
struct PairResult {
  BluezDevice device;
  std::string trouble;  ///< empty: it is bonded, connected, and its HID device is there
  std::string remedy;

  bool ready() const { return trouble.empty(); }
};

/// Says in the log what the person has to press and how far it is. Returns after `count` Wiimotes
/// or the patience; the results are of all that were seen, in order of address. A Wiimote that is
/// known without a bond is removed first, as is one whose bond turns out to be stale. Throws Error
/// for D-Bus, BlueZ or the adapter: missing, switched off, not permitted.
std::vector<PairResult> pair_wiimotes(const PairOptions& options, HidBus& hid, Clock& clock);

}  // namespace vindu
