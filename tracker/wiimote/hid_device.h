// The seam between the driver and HID devices, shaped after hidapi's hid_enumerate, hid_open_path,
// hid_read_timeout and hid_write: what devices there are, report bytes and arrival times cross it,
// nothing else. Real devices and emulated ones stand behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"

namespace vindu {

enum class HidStatus {
  report,   ///< one input report was read
  nothing,  ///< none has arrived in time
  gone,     ///< the device is disconnected: hidapi's -1
};

struct HidRead {
  HidStatus status = HidStatus::nothing;
  std::size_t size = 0;  ///< bytes put into the buffer
  Time arrival{};        ///< when the report reached this machine
};

/// Bound to one thread, its reader's.
class HidDevice {
 public:
  virtual ~HidDevice() = default;

  /// The oldest input report that arrives no later than `until`; waits for it if need be, so `until
  /// = now` only drains what is there. buffer[0] becomes the report id, as with hidapi; what does
  /// not fit is cut off.
  virtual HidRead read(std::span<std::uint8_t> buffer, Time until) = 0;

  /// Sends one output report, id first. False when the device refuses it or is gone.
  virtual bool write(std::span<const std::uint8_t> report) = 0;
};

/// What is known of a device before it is opened, as hidapi's hid_device_info.
struct HidInfo {
  std::string path;  ///< opens it; "/dev/hidraw3"
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string name;     ///< "Nintendo RVL-CNT-01"
  std::string address;  ///< hidapi's serial number: the Bluetooth address, or empty
};

/// All HID devices of a machine, or of an emulated one. Thread-safe.
class HidBus {
 public:
  virtual ~HidBus() = default;

  virtual std::vector<HidInfo> list() = 0;

  /// Throws Error with what hinders it: permission, gone.
  virtual std::unique_ptr<HidDevice> open(const std::string& path) = 0;
};

}  // namespace vindu
