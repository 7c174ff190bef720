// The HID devices of a machine that has none: emulated Wiimotes, and what else a real machine shows
// beside them, behind the same seam as hidapi.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tracker/wiimote/emulator_device.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

/// The devices are added first, by one thread; from then on it is thread-safe, as far as its clock
/// is. Clock and bus must outlive the handles that it opens.
class EmulatedHidBus final : public HidBus {
 public:
  explicit EmulatedHidBus(Clock& clock) : clock_(clock) {}

  /// Connects it. Where the options have none, a name is made up, and an address but for a slot. At
  /// most 16.
  EmulatedDevice& add(EmulatedDeviceOptions options, WiimoteEmulator::Look look);

  /// Four slots on USB, without addresses; the first hold these Wiimotes, the others none.
  void add_dolphin_bar(const std::vector<WiimoteEmulator::Look>& wiimotes);
  /// Two that are none: a balance board and a Wii U Pro controller.
  void add_strangers();

  std::vector<HidInfo> list() override;
  std::unique_ptr<HidDevice> open(const std::string& path) override;

  std::size_t size() const { return devices_.size(); }
  EmulatedDevice& device(std::size_t index) { return *devices_.at(index); }
  /// Where a device is to be opened now; it changes when it comes back.
  std::string path(std::size_t index);

 private:
  Clock& clock_;
  std::vector<std::unique_ptr<EmulatedDevice>> devices_;
};

/// What hidapi says of a Wiimote (0x0306) or one with Motion Plus inside (0x0330), but its path.
HidInfo wiimote_info(std::uint16_t product_id, const std::string& address);

/// An open emulated device. Bound to one thread, as all HidDevices.
class EmulatedHandle final : public HidDevice {
 public:
  EmulatedHandle(EmulatedDevice& device, Clock& clock);
  ~EmulatedHandle() override;
  EmulatedHandle(const EmulatedHandle&) = delete;
  EmulatedHandle& operator=(const EmulatedHandle&) = delete;

  HidRead read(std::span<std::uint8_t> buffer, Time until) override;
  bool write(std::span<const std::uint8_t> report) override;

 private:
  EmulatedDevice& device_;
  Clock& clock_;
  EmulatedDevice::Listener listener_;  // under the device's lock
};

}  // namespace vindu
