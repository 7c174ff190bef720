#include "tracker/wiimote/acceleration.h"

#include <numeric>

#include "tracker/wiimote/commands.h"

namespace vindu {
namespace {

int calibration_value(std::uint8_t high, int low_bits) { return high << 2 | (low_bits & 3); }

}  // namespace

// Bytes 0 to 3: zero x, y, z and their low bits; 4 to 7: the same at 1 g; 9: the sum of the others
// plus 0x55 (WiiBrew, EEPROM).
std::optional<AccelerationCalibration> calibration_from(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kCalibrationSize) return std::nullopt;
  const int sum = std::accumulate(bytes.begin(), bytes.begin() + 9, 0x55);
  if ((sum & 0xff) != bytes[9]) return std::nullopt;
  AccelerationCalibration calibration;
  for (int axis = 0; axis < 3; ++axis) {
    const int shift = 4 - 2 * axis;
    calibration.zero[axis] = calibration_value(bytes[axis], bytes[3] >> shift);
    calibration.one_g[axis] = calibration_value(bytes[4 + axis], bytes[7] >> shift);
    if (calibration.zero[axis] == calibration.one_g[axis]) return std::nullopt;
  }
  return calibration;
}

std::array<double, 3> acceleration_g(const std::array<int, 3>& raw,
                                     const AccelerationCalibration& calibration) {
  std::array<double, 3> g{};
  for (int axis = 0; axis < 3; ++axis)
    g[axis] = static_cast<double>(raw[axis] - calibration.zero[axis]) /
              (calibration.one_g[axis] - calibration.zero[axis]);
  return g;
}

}  // namespace vindu
