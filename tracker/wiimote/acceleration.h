// The accelerometer's raw values in g, by the unit's own calibration.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace vindu {

/// 0 g and 1 g of x, y, z in raw counts, of one unit.
struct AccelerationCalibration {
  std::array<int, 3> zero{};
  std::array<int, 3> one_g{};

  bool operator==(const AccelerationCalibration&) const = default;
};

/// Of the memory at kCalibrationAddress or its copy; empty unless it is whole.
std::optional<AccelerationCalibration> calibration_from(std::span<const std::uint8_t> bytes);

/// In g; the axes are the Wiimote's: x left, y back, z up (WiiBrew).
std::array<double, 3> acceleration_g(const std::array<int, 3>& raw,
                                     const AccelerationCalibration& calibration);

}  // namespace vindu
