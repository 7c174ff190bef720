#include "tracker/wiimote/emulator_memory.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/error.h"

namespace vindu {
namespace {

constexpr std::size_t kEepromBytes = 5888;
constexpr std::size_t kCalibrationAt = 0x16;
constexpr std::size_t kCalibrationCopyAt = 0x20;

// The bus addresses, 7 bits: the top byte of 0xa4...., halved.
constexpr std::uint8_t kEepromChip = 0x50;
constexpr std::uint8_t kExtensionChip = 0x52;
constexpr std::uint8_t kMotionPlusChip = 0x53;
constexpr std::uint8_t kCameraChip = 0x58;

constexpr std::size_t kInitialiseAt = 0xf0;
constexpr std::size_t kIdentityAt = 0xfa;
constexpr std::size_t kMotionPlusModeAt = 0xfe;
constexpr std::uint8_t kInitialise = 0x55;

constexpr std::array<std::uint8_t, 6> kNunchuk = {0x00, 0x00, 0xa4, 0x20, 0x00, 0x00};
constexpr std::array<std::uint8_t, 6> kNunchukAtRest = {0x80, 0x80, 0x80, 0x80, 0xb3, 0x03};
constexpr std::array<std::uint8_t, 6> kMotionPlusAsleep = {0x01, 0x00, 0xa6, 0x20, 0x00, 0x05};

// Zero and 1 g of the three axes, high bytes and the two low bits of all; volume; and a sum.
std::vector<std::uint8_t> made_up_eeprom() {
  std::vector<std::uint8_t> image(kEepromBytes);
  std::array<std::uint8_t, 10> calibration = {0x80, 0x80, 0x80, 0, 0x9a, 0x9a, 0x9a, 0, 0x40, 0};
  calibration[9] =
      static_cast<std::uint8_t>(std::accumulate(calibration.begin(), calibration.end(), 0x55));
  std::ranges::copy(calibration, image.begin() + kCalibrationAt);
  std::ranges::copy(calibration, image.begin() + kCalibrationCopyAt);
  return image;
}

std::uint8_t slave_of(std::uint32_t address) {
  return static_cast<std::uint8_t>(address / 0x20000 % 0x80);
}

int space_of(std::uint8_t flags) { return flags / 4 % 4; }

}  // namespace

EmulatedMemory::EmulatedMemory(std::vector<std::uint8_t> eeprom, bool motion_plus)
    : eeprom_(eeprom.empty() ? made_up_eeprom() : std::move(eeprom)),
      has_motion_plus_(motion_plus) {
  if (eeprom_.size() != kEepromBytes)
    throw Error({"the memory image of the emulated Wiimote has " + std::to_string(eeprom_.size()) +
                     " bytes",
                 "emulated Wiimote", "give one of 5888 bytes"});
  std::ranges::copy(kNunchuk, extension_.begin() + kIdentityAt);
  std::ranges::copy(kMotionPlusAsleep, motion_plus_.begin() + kIdentityAt);
}

const EmulatedMemory::Registers* EmulatedMemory::chip(std::uint8_t slave) const {
  if (slave == kExtensionChip && motion_plus_active_) return &motion_plus_;
  if (slave == kExtensionChip && plugged_) return &extension_;
  if (slave == kMotionPlusChip && has_motion_plus_ && !motion_plus_active_) return &motion_plus_;
  return nullptr;
}

EmulatedMemory::Registers* EmulatedMemory::chip(std::uint8_t slave) {
  return const_cast<Registers*>(std::as_const(*this).chip(slave));
}

MemoryError EmulatedMemory::write(std::uint8_t flags, std::uint32_t address,
                                  std::span<const std::uint8_t> bytes) {
  if (space_of(flags) == 3) return MemoryError::bad_space;
  if (space_of(flags) == 0) {
    const std::size_t at = address % 0x10000;
    if (at + bytes.size() > eeprom_.size()) return MemoryError::bad_address;
    std::ranges::copy(bytes, eeprom_.begin() + static_cast<std::ptrdiff_t>(at));
    return MemoryError::none;
  }
  const std::uint8_t slave = slave_of(address);
  const auto offset = static_cast<std::uint8_t>(address % 0x100);
  if (slave == kEepromChip) return MemoryError::bad_address;
  if (slave == kCameraChip)
    return camera_.write(offset, bytes) ? MemoryError::none : MemoryError::no_answer;
  Registers* registers = chip(slave);
  if (!registers || offset + bytes.size() > registers->size()) return MemoryError::no_answer;
  // The identities cannot be written; but 0xfe wakes the Motion Plus, which then takes the
  // extension's place, and 0x55 at 0xf0 there sends it back.
  if (offset < kIdentityAt) std::ranges::copy(bytes, registers->begin() + offset);
  if (registers != &motion_plus_) return MemoryError::none;
  const bool wakes = slave == kMotionPlusChip && offset == kMotionPlusModeAt;
  const bool sleeps = slave == kExtensionChip && offset == kInitialiseAt && bytes[0] == kInitialise;
  if (wakes || sleeps) {
    motion_plus_active_ = wakes;
    motion_plus_[kIdentityAt + 2] = wakes ? 0xa4 : 0xa6;
    motion_plus_[kIdentityAt + 4] = wakes ? bytes[0] : 0;
  }
  return MemoryError::none;
}

MemoryError EmulatedMemory::read(std::uint8_t flags, std::uint32_t address,
                                 std::span<std::uint8_t> bytes) const {
  if (space_of(flags) == 3) return MemoryError::bad_space;
  if (space_of(flags) == 0) {
    const std::size_t at = address % 0x10000;
    if (at + bytes.size() > eeprom_.size()) return MemoryError::bad_address;
    std::copy_n(eeprom_.begin() + static_cast<std::ptrdiff_t>(at), bytes.size(), bytes.begin());
    return MemoryError::none;
  }
  const std::uint8_t slave = slave_of(address);
  const auto offset = static_cast<std::uint8_t>(address % 0x100);
  if (slave == kEepromChip) return MemoryError::bad_address;
  if (slave == kCameraChip)
    return camera_.read(offset, bytes) ? MemoryError::none : MemoryError::no_answer;
  const Registers* registers = chip(slave);
  if (!registers || offset + bytes.size() > registers->size()) return MemoryError::no_answer;
  std::copy_n(registers->begin() + offset, bytes.size(), bytes.begin());
  return MemoryError::none;
}

void EmulatedMemory::extension_data(std::span<std::uint8_t> bytes) const {
  std::ranges::fill(bytes, std::uint8_t{0xff});
  if (!extension_answers()) return;
  std::ranges::fill(bytes, std::uint8_t{0});
  if (!motion_plus_active_)
    std::copy_n(kNunchukAtRest.begin(), std::min(bytes.size(), kNunchukAtRest.size()),
                bytes.begin());
}

std::array<int, 3> EmulatedMemory::acceleration_raw(
    const std::array<double, 3>& acceleration_g) const {
  std::array<int, 3> raw{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The low bits of x, y and z stand in bits 5-4, 3-2 and 1-0 of the fourth byte.
    const int shift = 16 >> (2 * axis);
    const int zero = eeprom_[kCalibrationAt + axis] * 4 + eeprom_[kCalibrationAt + 3] / shift % 4;
    const int one =
        eeprom_[kCalibrationAt + 4 + axis] * 4 + eeprom_[kCalibrationAt + 7] / shift % 4;
    raw[axis] = static_cast<int>(
        std::clamp(std::lround(zero + (one - zero) * acceleration_g[axis]), 0L, 1023L));
  }
  return raw;
}

}  // namespace vindu
