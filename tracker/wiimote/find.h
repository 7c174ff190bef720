// Which HID devices are Wiimotes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracker/wiimote/hid_device.h"
#include "tracker/wiimote/report.h"

namespace vindu {

enum class WiimoteKind {
  none,
  classic,  ///< RVL-CNT-01
  tr,       ///< RVL-CNT-01-TR, Motion Plus inside
  adapter,  ///< a slot of a USB adapter (DolphinBar), perhaps an empty one
};

constexpr const char* name_of(WiimoteKind kind) {
  constexpr const char* names[] = {"none", "RVL-CNT-01", "RVL-CNT-01-TR", "USB adapter"};
  return names[static_cast<int>(kind)];
}

/// By vendor and product (057e:0306, 057e:0330; 054c:0306 is LEGO's) or by name, which some stacks
/// give alone. Not the balance board (RVL-WBC-01), nor the Wii U Pro Controller (RVL-CNT-01-UC),
/// which share these ids.
WiimoteKind kind_of(const HidInfo& info);

/// All of them, in order of address, then path. Slots have no address, whatever serial number their
/// adapter has for all of them.
std::vector<HidInfo> find_wiimotes(HidBus& bus);

/// How people name it: its address, or its path where it has none.
const std::string& label_of(const HidInfo& info);

/// Asks for the status, as proof of life; empty when no answer comes in time. A device that is
/// streaming to somebody else stops for a moment.
std::optional<StatusReport> probe(HidDevice& device, Clock& clock, Duration patience);

/// The charge of a status report's battery byte, 0 to 1: 0xd0 is full (cwiid's scale).
double battery_charge(int level);

}  // namespace vindu
