// The other end of an emulated Wiimote's wire for tests: hex text in, hex text out, so that a test
// shows the very bytes that it is about.
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "tracker/wiimote/emulator.h"

namespace vindu {

using Bytes = std::vector<std::uint8_t>;

inline Bytes from_hex(const std::string& text) {
  std::istringstream stream(text);
  Bytes bytes;
  for (int value = 0; stream >> std::hex >> value;)
    bytes.push_back(static_cast<std::uint8_t>(value));
  return bytes;
}

inline std::string to_hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  char two[4];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(two, sizeof two, "%s%02x", text.empty() ? "" : " ", byte);
    text += two;
  }
  return text;
}

/// " ff ff", for what follows other bytes.
inline std::string times(int count, const std::string& two_digits) {
  std::string text;
  for (int i = 0; i < count; ++i) text += " " + two_digits;
  return text;
}

/// An output report 0x16 that writes to a register.
inline std::string write_of(const std::string& address, const std::string& data) {
  const std::size_t size = from_hex(data).size();
  return "16 04 " + address + " " + to_hex(Bytes{static_cast<std::uint8_t>(size)}) + " " + data +
         times(static_cast<int>(16 - size), "00");
}

/// One Wiimote without radio: outputs reach it at once, and time is what `run` takes.
class EmulatorHost {
 public:
  explicit EmulatorHost(EmulatorOptions options = {})
      : emulator(std::move(options), [this](Time) { return view; }) {}

  bool send(const std::string& hex) { return emulator.output(from_hex(hex), now); }

  /// Reports that leave within this time.
  std::vector<std::string> run(Duration time) {
    now += time;
    std::vector<std::string> reports;
    while (const auto report = emulator.next(now)) reports.push_back(to_hex(report->span()));
    return reports;
  }

  /// Sends, and gives back what comes in the next 5 ms.
  std::vector<std::string> answer(const std::string& hex) {
    send(hex);
    return run(std::chrono::milliseconds(5));
  }

  SensorView view;
  Time now{};
  WiimoteEmulator emulator;
};

}  // namespace vindu
