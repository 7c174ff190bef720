// A HID device of this machine that a program plays: the kernel, its drivers and every other
// program see it as a real one. Through it the emulated Wiimote meets Linux' own hid-wiimote.
// Follows the kernel's Documentation/hid/uhid.rst.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "tracker/wiimote/emulator.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

/// Bound to one thread. On the Bluetooth bus, as Wiimotes are.
class UhidDevice {
 public:
  /// `identity.path` is not used: the kernel chooses it. The device appears a little later, when
  /// its driver has been found. Throws Error when the node cannot be opened or the kernel refuses.
  UhidDevice(const HidInfo& identity, std::span<const std::uint8_t> report_descriptor,
             const std::string& node = "/dev/uhid");
  ~UhidDevice();  ///< unplugs it
  UhidDevice(const UhidDevice&) = delete;
  UhidDevice& operator=(const UhidDevice&) = delete;

  /// The next output report that a program or the kernel's driver writes, id first; waits for it
  /// until then. Requests to set an output report are given out too, and answered; all others are
  /// answered with an error.
  std::optional<std::vector<std::uint8_t>> next_output(Time until);

  /// An input report of the device, id first. False when the kernel does not take it.
  bool input(std::span<const std::uint8_t> report);

 private:
  int file_ = -1;
};

/// Told of each output report that reaches the Wiimote, id first.
using OutputTap = std::function<void(std::span<const std::uint8_t> report)>;

/// Lets the emulated Wiimote be that device until then, on the monotonic clock: carries reports
/// both ways. False once it is dead.
bool serve(WiimoteEmulator& wiimote, UhidDevice& device, Time until, const OutputTap& tap = {});

}  // namespace vindu
