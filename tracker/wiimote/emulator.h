// The emulated Wiimote's side of the wire: writes the bytes of input report 0x33. It shares nothing
// with the parser, so that a misread layout cannot cancel out between them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace vindu {

/// What the sensor's own logic would report of a bright spot.
struct SensorDot {
  int x_px = 0;  ///< 0..1023
  int y_px = 0;  ///< 0..767
  int size = 0;  ///< 0..15
};

struct SensorState {
  std::uint8_t buttons_1 = 0;  ///< Left 01, Right 02, Down 04, Up 08, Plus 10
  std::uint8_t buttons_2 = 0;  ///< Two 01, One 02, B 04, A 08, Minus 10, Home 80
  std::array<int, 3> acceleration_raw = {0x200, 0x200, 0x200};  ///< 10 bits; y and z lose the last
  std::array<std::optional<SensorDot>, 4> slots;
};

/// Id first, as hidapi hands it out. Values out of range are an error of the caller (assert).
std::array<std::uint8_t, 18> encode_report_0x33(const SensorState& state);

}  // namespace vindu
