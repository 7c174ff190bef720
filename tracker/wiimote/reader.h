// Drains one Wiimote: bytes of a HID device in, observations out. Whether the device is real or
// emulated cannot be told from here.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tracker/observation.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

struct ReaderCounts {
  std::uint64_t reports = 0;  ///< read as 0x33
  std::uint64_t refused = 0;  ///< other ids, wrong lengths
};

/// Bound to one thread.
class WiimoteReader {
 public:
  /// `camera` is the index in the site's list that the observations carry; `name` is for messages.
  /// Asks the device to stream report 0x33; throws Error when it refuses.
  WiimoteReader(std::unique_ptr<HidDevice> device, int camera, const std::string& name);

  /// The next observation that arrives no later than `until`; call it until it is empty. Empty for
  /// ever once the device is gone.
  std::optional<Observation> next(Time until);

  bool gone() const { return gone_; }
  const ReaderCounts& counts() const { return counts_; }

 private:
  std::unique_ptr<HidDevice> device_;
  int camera_;
  bool gone_ = false;
  ReaderCounts counts_;
};

}  // namespace vindu
