#include "tracker/wiimote/commands.h"

#include <algorithm>
#include <cassert>

namespace vindu {
namespace {

// First payload byte: bit 0 rumble, bit 1 acknowledge, bit 2 enable, continuous or register space.
constexpr std::uint8_t kAcknowledge = 0x02, kEnable = 0x04;

constexpr int kCamera = 0xb00000;
constexpr int kSensitivity1 = kCamera, kSensitivity2 = kCamera + 0x1a;
constexpr int kPower = kCamera + 0x30, kMode = kCamera + 0x33;
constexpr std::uint8_t kConfiguring = 0x01, kTracking = 0x08;

OutputReport output(std::initializer_list<std::uint8_t> bytes) {
  OutputReport report{.size = bytes.size()};
  std::ranges::copy(bytes, report.bytes.begin());
  return report;
}

void put_address(OutputReport& report, int address) {
  for (int byte = 0; byte < 3; ++byte)
    report.bytes[2 + byte] = static_cast<std::uint8_t>(address >> (16 - 8 * byte));
}

Step write_registers(int address, std::span<const std::uint8_t> data, const char* purpose) {
  assert(!data.empty() && data.size() <= 16);
  OutputReport report{.size = 22};
  report.bytes[0] = 0x16;
  report.bytes[1] = kEnable;
  put_address(report, address);
  report.bytes[5] = static_cast<std::uint8_t>(data.size());
  std::ranges::copy(data, report.bytes.begin() + 6);
  return {.report = report, .answer = Answer::acknowledgement, .purpose = purpose};
}

Step write_register(int address, std::uint8_t value, const char* purpose) {
  return write_registers(address, std::span(&value, 1), purpose);
}

Step read_memory(bool registers, int address, int size, const char* purpose) {
  OutputReport report = output({0x17, registers ? kEnable : std::uint8_t{0}, 0, 0, 0, 0, 0});
  put_address(report, address);
  report.bytes[6] = static_cast<std::uint8_t>(size);
  return {.report = report, .answer = Answer::memory, .purpose = purpose};
}

Step compare_registers(int address, std::span<const std::uint8_t> expected, const char* purpose) {
  Step step = read_memory(true, address, static_cast<int>(expected.size()), purpose);
  step.expected.assign(expected.begin(), expected.end());
  return step;
}

std::uint8_t mode_of(IrFormat format) {
  switch (format) {
    case IrFormat::basic:
      return 1;
    case IrFormat::extended:
      return 3;
    case IrFormat::full:
      break;
  }
  return 5;
}

}  // namespace

int player_leds(int player) {
  return player >= 1 && player <= 4 ? 1 << (player - 1) : player & 0x0f;
}

std::uint8_t data_report_id(IrFormat format) {
  switch (format) {
    case IrFormat::basic:
      return 0x37;
    case IrFormat::extended:
      return 0x33;
    case IrFormat::full:
      break;
  }
  return 0x3e;
}

Duration sample_period(IrFormat format) {
  return std::chrono::milliseconds(format == IrFormat::full ? 20 : 10);
}

OutputReport request_stream(IrFormat format) {
  return output({0x12, kEnable, data_report_id(format)});
}

OutputReport request_status() { return output({0x15, 0}); }

OutputReport set_leds(int leds, bool rumble) {
  return output({0x11, static_cast<std::uint8_t>(leds << 4 | (rumble ? 1 : 0))});
}

OutputReport rumble_only() { return output({0x10, 0}); }

Step status_step() {
  return {.report = request_status(), .answer = Answer::status, .purpose = "ask for its status"};
}

std::vector<Step> greeting_steps(const WiimoteSettings& settings) {
  const auto leds = static_cast<std::uint8_t>(player_leds(settings.player) << 4 | kAcknowledge);
  std::vector<Step> steps = {
      status_step(),
      read_memory(false, kCalibrationAddress, kCalibrationSize,
                  "read the accelerometer's calibration"),
      read_memory(false, kCalibrationCopyAddress, kCalibrationSize, "read the calibration's copy"),
      {.report = output({0x11, leds}), .purpose = "light the player's LED"}};
  for (Step& step : steps) step.needed = false;  // it has a camera all the same
  return steps;
}

std::vector<Step> late_greeting_steps(const WiimoteSettings& settings) {
  std::vector<Step> steps = greeting_steps(settings);
  std::rotate(steps.begin(), steps.begin() + 1, steps.end());
  return steps;
}

std::vector<Step> camera_steps(const WiimoteSettings& settings) {
  const Sensitivity& sensitivity = settings.sensitivity;
  return {{.report = output({0x13, kEnable | kAcknowledge}), .purpose = "power the camera"},
          {.report = output({0x1a, kEnable | kAcknowledge}), .purpose = "enable the camera"},
          write_register(kPower, kConfiguring, "begin to configure the camera"),
          write_registers(kSensitivity1, sensitivity.block_1, "write the sensitivity, block 1"),
          write_registers(kSensitivity2, sensitivity.block_2, "write the sensitivity, block 2"),
          write_register(kMode, mode_of(settings.format), "write the camera's format"),
          {.report = request_stream(settings.format), .answer = Answer::none},
          write_register(kPower, kTracking, "start the camera")};
}

std::vector<Step> check_steps(const WiimoteSettings& settings) {
  const Sensitivity& sensitivity = settings.sensitivity;
  const std::uint8_t tracking = kTracking, mode = mode_of(settings.format);
  return {compare_registers(kMode, {&mode, 1}, "read back the camera's format"),
          compare_registers(kPower, {&tracking, 1}, "read back whether the camera runs"),
          compare_registers(kSensitivity1, sensitivity.block_1, "read back the sensitivity"),
          compare_registers(kSensitivity2, sensitivity.block_2, "read back the sensitivity")};
}

}  // namespace vindu
