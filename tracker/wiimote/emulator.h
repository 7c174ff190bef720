// The firmware of a Wiimote, without a radio and without a clock of its own: output reports go in
// with the time at which they reach it, input reports come out with the time at which they leave.
// Behaviour: WiiBrew, "Wiimote"; error codes and traps: Dolphin, WiimoteEmu/EmuSubroutines.cpp. It
// shares nothing with the driver, so that a misread layout cannot cancel out between them.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "tracker/wiimote/emulator_camera.h"
#include "tracker/wiimote/emulator_memory.h"

namespace vindu {

/// What reaches a Wiimote from outside at one time.
struct SensorView {
  std::uint8_t buttons_1 = 0;  ///< Left 01, Right 02, Down 04, Up 08, Plus 10
  std::uint8_t buttons_2 = 0;  ///< Two 01, One 02, B 04, A 08, Minus 10, Home 80
  /// x left, y back, z up; the unit's own calibration in its EEPROM makes raw values of it.
  std::array<double, 3> acceleration_g = {0, 0, 1};
  std::vector<SensorSpot> spots;
};

/// One input report, id first as hidapi hands it out.
struct EmulatedReport {
  std::array<std::uint8_t, 22> bytes{};
  std::size_t size = 0;
  Time at{};  ///< when it leaves the device
  std::span<const std::uint8_t> span() const { return std::span(bytes).first(size); }
};

struct EmulatorOptions {
  std::vector<std::uint8_t> eeprom;  ///< 5888 bytes; empty: all zero but a usual calibration
  bool motion_plus = false;          ///< inside, as in the -TR
  Time start{};                      ///< when it is switched on
  Duration phase{};                  ///< from there to the first sample
  Duration report_period = std::chrono::milliseconds(10);  ///< 5 ms on a link in sniff mode
  Duration command_time = std::chrono::milliseconds(4);    ///< from an output report to its answer
  Duration chunk_time = std::chrono::milliseconds(5);      ///< between the answers to one read
  bool loses_early_writes = true;  ///< a 0x16 before the one before was acknowledged
  bool camera_already_on = false;  ///< as after the whole start-up, with the Wii's level 4
  std::uint8_t battery = 0xc0;     ///< the status report's VV; 0xd0 is about full
};

/// Bound to one thread. Times never go back from one call to the next.
class WiimoteEmulator {
 public:
  using Look = std::function<SensorView(Time)>;

  /// Throws Error when the EEPROM image has the wrong size.
  WiimoteEmulator(EmulatorOptions options, Look look);

  /// An output report, id first, reaches the device. False when it is none (0x10 to 0x1a) or the
  /// device is dead; one of the wrong length is ignored, as real ones do.
  bool output(std::span<const std::uint8_t> report, Time at);

  /// The next input report that leaves no later than `until`; call it until it is empty.
  std::optional<EmulatedReport> next(Time until);

  /// No report leaves before this, unless something else happens first.
  Time next_event() const;

  /// Both tell the host by a status report, which nobody asked for.
  void plug_extension(bool plugged, Time at);
  void send_status(Time at);

  /// Zero: dead; nothing comes any more.
  void set_battery(std::uint8_t level) { battery_ = level; }
  bool alive() const { return battery_ > 0; }

  std::uint8_t leds() const { return leds_; }  ///< bit 0: the first, at the left
  bool rumbling() const { return rumbling_; }
  std::uint8_t report_mode() const { return mode_; }  ///< 0x30 .. 0x3f
  bool continuous() const { return continuous_; }

 private:
  enum class After { nothing, write_done, read_done };
  struct Reply {
    Time at{};
    std::vector<std::uint8_t> bytes;  // without the buttons, which are those of when it leaves
    After after = After::nothing;
  };
  struct Sample {
    SensorView view;
    std::array<int, 3> acceleration_raw{};
    std::array<std::uint8_t, 36> dots{};
  };

  void obey(std::uint8_t id, std::span<const std::uint8_t> payload, Time at);
  void enable(std::uint8_t id, bool on);
  void set_mode(std::span<const std::uint8_t> payload, Time at);
  void write_memory(std::span<const std::uint8_t> payload, Time at);
  void read_memory(std::span<const std::uint8_t> payload, Time at);
  void acknowledge(std::uint8_t id, MemoryError error, Time at, After after = After::nothing);
  void reply(std::vector<std::uint8_t> bytes, Time at, After after = After::nothing);
  void report_plug(Time at);

  EmulatedReport leave(const Reply& reply);
  std::optional<EmulatedReport> data_report(Time at, bool always);
  Sample take(Time at);
  EmulatedReport compose(const Sample& sample, std::uint8_t id, Time at) const;

  EmulatorOptions options_;
  Look look_;
  EmulatedMemory memory_;
  std::deque<Reply> replies_;
  bool writing_ = false;
  bool reading_ = false;
  std::uint8_t battery_;
  std::uint8_t leds_ = 0;
  bool rumbling_ = false;
  bool speaker_ = false;
  bool extension_seen_ = false;
  std::uint8_t mode_ = 0x30;
  bool continuous_ = false;
  Time next_sample_{};
  std::optional<Time> forced_;          // a data report, changed or not
  std::optional<Sample> second_half_;   // of a pair 0x3e, 0x3f
  std::optional<EmulatedReport> last_;  // data report of this mode
};

/// What the encoder of report 0x33 is given; raw values, dots as they stand in their slots.
struct SensorState {
  std::uint8_t buttons_1 = 0;
  std::uint8_t buttons_2 = 0;
  std::array<int, 3> acceleration_raw = {0x200, 0x200, 0x200};  ///< 10 bits; y and z lose the last
  SensorSlots slots;
};

/// Id first. Values out of range are an error of the caller (assert).
std::array<std::uint8_t, 18> encode_report_0x33(const SensorState& state);

}  // namespace vindu
