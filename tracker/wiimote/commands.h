// What the driver tells a Wiimote: output reports, and the steps that start its camera and check it
// later. Sources: WiiBrew, "Wiimote"; xwiimote's doc/PROTOCOL; the order of the camera's start-up
// is that of Linux' hid-wiimote.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "tracker/wiimote/report.h"

namespace vindu {

struct WiimoteSettings {
  IrFormat format = IrFormat::extended;
  Sensitivity sensitivity = *sensitivity_from(kDefaultSensitivity);
  int player = 1;  ///< its LEDs show this number: 1 to 4 by place, up to 15 in binary
};

/// Id first, as hidapi takes it.
struct OutputReport {
  std::array<std::uint8_t, 22> bytes{};
  std::size_t size = 0;

  std::span<const std::uint8_t> span() const { return std::span(bytes).first(size); }
};

enum class Answer { status, memory, acknowledgement, none };

/// A command and the answer that ends it. One without is never the last.
struct Step {
  OutputReport report;
  Answer answer = Answer::acknowledgement;
  std::vector<std::uint8_t> expected = {};  ///< of memory that is compared; empty: not compared
  const char* purpose = "";                 ///< "write the camera's mode", for messages
  bool needed = true;                       ///< otherwise it is passed by when it is refused
};

constexpr int kCalibrationAddress = 0x16;  ///< of the accelerometer
constexpr int kCalibrationCopyAddress = 0x20;
constexpr int kCalibrationSize = 10;

/// Bit 0 is the first LED.
int player_leds(int player);

/// The data report that carries the format; of the two of the full one the first.
std::uint8_t data_report_id(IrFormat format);
/// From one sample of the format to the next: reports come each 10 ms.
Duration sample_period(IrFormat format);

OutputReport request_stream(IrFormat format);  ///< continuously; not acknowledged
OutputReport request_status();
OutputReport set_leds(int leds, bool rumble);  ///< bit 0: the first LED
OutputReport rumble_only();  ///< carries nothing but the rumble bit, which the session sets

/// Status, calibration, player LEDs: what is done once a connection.
std::vector<Step> greeting_steps(const WiimoteSettings& settings);
/// The same while the stream runs: its status, which stops the stream, comes last.
std::vector<Step> late_greeting_steps(const WiimoteSettings& settings);
/// Switches the camera on and writes its registers. The stream is asked for together with the last,
/// so that dots come as soon as there are any: it is no write, and takes no answer to wait for.
std::vector<Step> camera_steps(const WiimoteSettings& settings);
/// Reads those registers back.
std::vector<Step> check_steps(const WiimoteSettings& settings);
Step status_step();

}  // namespace vindu
