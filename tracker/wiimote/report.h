// Reads a Wiimote's input reports: status, memory, acknowledgements, and data with buttons,
// accelerometer and up to four infrared dots in each of the camera's three formats. Layouts:
// WiiBrew, "Wiimote", and xwiimote's doc/PROTOCOL. Any bytes may come: nothing here throws or reads
// beyond them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "core/infrared.h"
#include "tracker/observation.h"

namespace vindu {

/// What only the full format has: the bright region, in sensor pixels (128 x 96), and its light.
struct Blob {
  int x_min = 0, y_min = 0, x_max = 0, y_max = 0;  ///< 7 bits each
  int intensity = 0;                               ///< 0..255

  bool operator==(const Blob&) const = default;
};

struct IrDot {
  int x_px = 0;  ///< 0..1023, raw
  int y_px = 0;  ///< 0..767, raw
  int size = 0;  ///< 0..15; always 0 in the basic format, which has none
  std::optional<Blob> blob;

  bool operator==(const IrDot&) const = default;
};

using IrSlots = std::array<std::optional<IrDot>, 4>;

/// The first button byte high, the second low, bits of the accelerometer cleared: Left 0100, Right
/// 0200, Down 0400, Up 0800, Plus 1000, Two 0001, One 0002, B 0004, A 0008, Minus 0010, Home 0080.
using Buttons = std::uint16_t;

/// 0x20, asked for or not. After it the device has forgotten which data it was to report.
struct StatusReport {
  Buttons buttons = 0;
  bool battery_low = false;
  bool extension = false;
  bool camera_on = false;
  int leds = 0;     ///< bit 0 is the first
  int battery = 0;  ///< 0..255; new batteries about 208

  bool operator==(const StatusReport&) const = default;
};

/// 0x21, up to 16 bytes of what was asked for.
struct MemoryReport {
  Buttons buttons = 0;
  int address = 0;  ///< its low 16 bits
  int error = 0;    ///< 0 good, 4 busy, 7 no such device or write-only, 8 no such address
  int size = 0;     ///< valid bytes; 0 on an error
  std::array<std::uint8_t, 16> data{};

  bool operator==(const MemoryReport&) const = default;
};

/// 0x22.
struct Acknowledgement {
  Buttons buttons = 0;
  std::uint8_t command = 0;  ///< the output report that it answers
  int error = 0;

  bool operator==(const Acknowledgement&) const = default;
};

/// 0x30 to 0x37 and 0x3d: whatever the report has.
struct DataReport {
  std::uint8_t id = 0;
  Buttons buttons = 0;
  std::optional<std::array<int, 3>> acceleration_raw =
      {};                             ///< x, y, z; 10 bits, about 0x200 at 0 g
  std::optional<IrSlots> slots = {};  ///< raw
  bool camera_silent = false;  ///< its bytes say nothing: four empty slots, or the camera is off

  bool operator==(const DataReport&) const = default;
};

/// 0x3e and 0x3f: the full format needs two reports.
struct HalfReport {
  bool second = false;
  Buttons buttons = 0;
  int acceleration_raw = 0;  ///< x of the first, y of the second; 10 bits, of which 8 are there
  int z_bits = 0;            ///< 4 bits of z: the high ones of the first, the low of the second
  std::array<std::optional<IrDot>, 2> slots;
  bool camera_silent = false;

  bool operator==(const HalfReport&) const = default;
};

using Report = std::variant<StatusReport, MemoryReport, Acknowledgement, DataReport, HalfReport>;

enum class ReportProblem { none, unknown_id, too_short };

constexpr std::string_view name_of(ReportProblem problem) {
  constexpr std::string_view names[] = {"none", "unknown id", "too short"};
  return names[static_cast<int>(problem)];
}

struct ParsedReport {
  std::optional<Report> report;
  ReportProblem problem = ReportProblem::none;
};

/// Bytes beyond a report's length are ignored: USB adapters pad. A slot is empty when its y is 768
/// or more, which no dot can have. (Its low byte of x being 0xFF proves nothing: dots at x = 255,
/// 511 and 767 have it.)
ParsedReport parse_report(std::span<const std::uint8_t> bytes);

/// Both halves as one; `first` must be the first half and `second` the second.
DataReport join(const HalfReport& first, const HalfReport& second);

/// The dots of the slots that are not empty, in slot order.
DotList dots_of(const IrSlots& slots);

}  // namespace vindu
