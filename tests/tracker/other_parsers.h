// How other people's programs read the dots of a Wiimote's reports: cwiid's own code, behind
// sockets in place of its Bluetooth channels; wiiuse and Dolphin, which Debian does not have as
// libraries, restated from their sources. Each with its faults.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace vindu::testing {

using ReportBytes = std::span<const std::uint8_t>;  ///< id first

/// Raw, as the bytes have it: not mirrored.
struct OthersDot {
  int x_px = 0;
  int y_px = 0;
  int size = 0;                                 ///< 0 where the format has none
  std::optional<std::array<int, 5>> blob = {};  ///< x and y from, x and y to, intensity

  bool operator==(const OthersDot&) const = default;
};

using OthersSlots = std::array<std::optional<OthersDot>, 4>;

/// libcwiid as Debian builds it. Bound to one thread. Reports 0x33, 0x36, 0x37; the halves 0x3e and
/// 0x3f it refuses.
class Cwiid {
 public:
  Cwiid();
  ~Cwiid();
  Cwiid(const Cwiid&) = delete;
  Cwiid& operator=(const Cwiid&) = delete;

  OthersSlots read(ReportBytes report);

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

/// wiiuse: src/events.c, src/ir.c. Reports 0x33, 0x36, 0x37; the halves it does not know.
OthersSlots read_as_wiiuse(ReportBytes report);

/// dolphin: Source/Core/Core/HW/WiimoteCommon/DataReport.cpp and HW/WiimoteEmu/Camera.h for the
/// layouts, InputCommon/ControllerInterface/Wiimote/WiimoteController.cpp for what is a dot. Of a
/// half, the first two slots.
OthersSlots read_as_dolphin(ReportBytes report);

}  // namespace vindu::testing
