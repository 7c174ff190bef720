#include "tracker/wiimote/emulator.h"

#include <cassert>

namespace vindu {
namespace {

// Three bytes: x7..x0, y7..y0, then y9 y8 x9 x8 s3 s2 s1 s0; all ones when there is no dot.
std::array<std::uint8_t, 3> slot_bytes(const std::optional<SensorDot>& dot) {
  if (!dot) return {0xff, 0xff, 0xff};
  assert(dot->x_px >= 0 && dot->x_px <= 1023 && dot->y_px >= 0 && dot->y_px <= 767);
  assert(dot->size >= 0 && dot->size <= 15);
  const int rest = dot->y_px / 256 * 64 + dot->x_px / 256 * 16 + dot->size;
  return {static_cast<std::uint8_t>(dot->x_px % 256), static_cast<std::uint8_t>(dot->y_px % 256),
          static_cast<std::uint8_t>(rest)};
}

}  // namespace

std::array<std::uint8_t, 18> encode_report_0x33(const SensorState& state) {
  const auto [ax, ay, az] = state.acceleration_raw;
  assert(ax >= 0 && ax < 1024 && ay >= 0 && ay < 1024 && az >= 0 && az < 1024);
  std::array<std::uint8_t, 18> bytes{0x33};
  // The unused bits of the buttons carry the accelerometer's low ones: x1 x0 in 6 and 5 of the
  // first byte, z1 in 6 and y1 in 5 of the second.
  bytes[1] = static_cast<std::uint8_t>(state.buttons_1 % 32 + ax % 4 * 32);
  bytes[2] = static_cast<std::uint8_t>(state.buttons_2 % 32 + state.buttons_2 / 128 * 128 +
                                       ay % 4 / 2 * 32 + az % 4 / 2 * 64);
  bytes[3] = static_cast<std::uint8_t>(ax / 4);
  bytes[4] = static_cast<std::uint8_t>(ay / 4);
  bytes[5] = static_cast<std::uint8_t>(az / 4);
  std::size_t next = 6;
  for (const auto& slot : state.slots)
    for (const std::uint8_t byte : slot_bytes(slot)) bytes[next++] = byte;
  return bytes;
}

}  // namespace vindu
