// The infrared camera inside the emulated Wiimote: light on the sensor in, dots in four slots out,
// behind the registers through which the firmware and the host see it. Register map: Dolphin,
// WiimoteEmu/Camera.h; sensitivity bytes: wiki.wiimoteproject.com, IR_Sensor. It shares nothing
// with the parser, so that a misread layout cannot cancel out between them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vindu {

/// Light on the sensor, where the optics put it.
struct SensorSpot {
  double x_px = 0;        ///< raw units, 1024 wide; not rounded
  double y_px = 0;        ///< raw units, 768 high
  double brightness = 0;  ///< of the LED cluster that is looked at straight from 1 m: 1
};

/// What the camera's logic reports of a spot.
struct SensorDot {
  int x_px = 0;  ///< 0..1023
  int y_px = 0;  ///< 0..767
  int size = 0;  ///< 0..15; the blob's diameter

  bool operator==(const SensorDot&) const = default;
};

using SensorSlots = std::array<std::optional<SensorDot>, 4>;

/// Bound to one thread.
class EmulatedCamera {
 public:
  /// Without power the registers are lost and nobody answers on the bus.
  void set_power(bool on);
  bool powered() const { return powered_; }
  /// Dots need this as well as the power (output report 0x1a).
  void set_logic(bool on) { logic_ = on; }
  /// As the host's start-up leaves it: tracking with the sensitivity that the Wii calls 4.
  void start(std::uint8_t mode);

  /// False when the camera does not answer or the bytes leave its 256 registers.
  bool write(std::uint8_t offset, std::span<const std::uint8_t> bytes);
  bool read(std::uint8_t offset, std::span<std::uint8_t> bytes) const;

  /// 1 basic, 3 extended, 5 full, else none.
  std::uint8_t mode() const;

  /// A new picture: renews the dot registers, which are all ones unless dots are tracked.
  void expose(std::span<const SensorSpot> spots);

  /// What the sensitivity lets through of a picture: the four brightest blobs, each in the slot
  /// that it keeps while it is seen.
  const SensorSlots& track(std::span<const SensorSpot> spots);

 private:
  struct Blob {
    double x_px = 0;
    double y_px = 0;
    double signal = 0;
  };

  std::vector<Blob> blobs_in(std::span<const SensorSpot> spots) const;
  std::array<std::optional<Blob>, 4> in_slots(std::vector<Blob> blobs) const;
  std::uint8_t reg(std::size_t offset) const { return registers_[offset]; }

  std::array<std::uint8_t, 256> registers_{};
  bool powered_ = false;
  bool logic_ = false;
  SensorSlots slots_;
};

/// The bytes of the dot registers in the three modes: 10, 12 or 36. Values out of range are an
/// error of the caller (assert).
std::array<std::uint8_t, 10> basic_dot_bytes(const SensorSlots& slots);
std::array<std::uint8_t, 12> extended_dot_bytes(const SensorSlots& slots);
std::array<std::uint8_t, 36> full_dot_bytes(const SensorSlots& slots);

}  // namespace vindu
