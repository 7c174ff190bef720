// What an emulated Wiimote answers for when it is read and written: its EEPROM, and the chips on
// its bus (infrared camera, extension, Motion Plus), with the error codes of real ones. Address
// map: WiiBrew, "Wiimote"; errors: Dolphin, WiimoteCommon/WiimoteConstants.h and WiimoteEmu.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tracker/wiimote/emulator_camera.h"

namespace vindu {

enum class MemoryError : std::uint8_t {
  none = 0,
  busy = 4,
  bad_space = 6,
  no_answer = 7,  ///< no such chip, or it does not want to
  bad_address = 8,
};

/// Bound to one thread.
class EmulatedMemory {
 public:
  /// Throws Error unless the image has 5888 bytes, or none: then it is made up, with an
  /// accelerometer that shows 0x200 at 0 g and 0x268 at 1 g.
  EmulatedMemory(std::vector<std::uint8_t> eeprom, bool motion_plus);

  /// `flags` is the first byte of an output report 0x16 or 0x17: bits 2 and 3 are the space.
  MemoryError write(std::uint8_t flags, std::uint32_t address, std::span<const std::uint8_t> bytes);
  MemoryError read(std::uint8_t flags, std::uint32_t address, std::span<std::uint8_t> bytes) const;

  EmulatedCamera& camera() { return camera_; }
  const EmulatedCamera& camera() const { return camera_; }

  void plug_extension(bool plugged) { plugged_ = plugged; }
  /// What the status report says: something answers at 0xa40000.
  bool extension_answers() const { return plugged_ || motion_plus_active_; }
  /// What data reports show of it; all ones where nothing answers.
  void extension_data(std::span<std::uint8_t> bytes) const;

  /// 10 bits each, of this unit's calibration.
  std::array<int, 3> acceleration_raw(const std::array<double, 3>& acceleration_g) const;

 private:
  using Registers = std::array<std::uint8_t, 256>;

  Registers* chip(std::uint8_t slave);
  const Registers* chip(std::uint8_t slave) const;

  std::vector<std::uint8_t> eeprom_;
  EmulatedCamera camera_;
  Registers extension_{};
  Registers motion_plus_{};
  bool plugged_ = false;
  bool has_motion_plus_;
  bool motion_plus_active_ = false;  // then it answers in the extension's place
};

}  // namespace vindu
