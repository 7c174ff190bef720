// Reads the Wiimote's input report 0x33: buttons, accelerometer and up to four infrared dots in the
// extended format. Layout: WiiBrew, "Wiimote" (data reporting, IR camera), and xwiimote's
// doc/PROTOCOL. Any bytes may come: nothing here throws or reads beyond them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tracker/observation.h"

namespace vindu {

enum class ReportProblem { none, wrong_id, wrong_length };

constexpr std::string_view name_of(ReportProblem problem) {
  constexpr std::string_view names[] = {"none", "wrong id", "wrong length"};
  return names[static_cast<int>(problem)];
}

struct WiimoteReport {
  std::uint16_t buttons = 0;  ///< first button byte high, second low, other bits cleared
  std::array<int, 3> acceleration_raw{};  ///< x, y, z; 10 bits, about 0x200 at 0 g
  DotList dots;                           ///< of the slots that are not empty, in slot order; raw
};

struct ParsedReport {
  std::optional<WiimoteReport> report;
  ReportProblem problem = ReportProblem::none;
};

/// A slot is empty when its y is 768 or more, which no dot can have. (Its low byte of x being 0xFF
/// proves nothing: dots at x = 255, 511 and 767 have it.)
ParsedReport parse_report(std::span<const std::uint8_t> bytes);

}  // namespace vindu
