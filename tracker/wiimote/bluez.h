// What BlueZ, the Bluetooth service of Linux, knows of Wiimotes: which are bonded, connected, and
// on which adapter. Source: BlueZ' doc/org.bluez.Adapter.rst and org.bluez.Device.rst.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace vindu {

struct BluezAdapter {
  std::string name;      ///< "hci0"
  std::string address;   ///< "00:1A:7D:DA:71:13"
  bool powered = false;  ///< switched on
  bool blocked = false;  ///< by rfkill, as far as this BlueZ says so
};

/// A Wiimote as one adapter knows it; two adapters may know the same one.
struct BluezDevice {
  std::string address = {};  ///< capital letters, unlike hidapi's
  std::string name = {};     ///< "Nintendo RVL-CNT-01"
  std::string adapter = {};  ///< "hci0"
  bool paired = false;       ///< bonded: it comes back by itself when one of its buttons is pressed
  bool trusted = false;
  bool connected = false;
  bool in_range = false;  ///< seen since discovery began
};

struct BluezView {
  std::vector<BluezAdapter> adapters;  ///< in order of name
  std::vector<BluezDevice> wiimotes;   ///< in order of address, then adapter
  std::string trouble;                 ///< why the view is empty: what is wrong and the remedy
};

/// Does not throw: no D-Bus, no BlueZ and no permission are troubles of the view. Takes a call to
/// the service: milliseconds, 10 s at most.
BluezView bluez_wiimotes();

/// A sentence for every adapter with three or more bonded or connected Wiimotes: they share its
/// time slots and report in bursts (thesis, 5.3).
std::vector<std::string> adapter_warnings(std::span<const BluezDevice> wiimotes);

/// By address, whichever case.
bool same_address(const std::string& one, const std::string& other);

}  // namespace vindu
