#include "tracker/wiimote/report.h"

#include <algorithm>
#include <cassert>

namespace vindu {
namespace {

using ByteView = std::span<const std::uint8_t>;

constexpr int kRows_px = 768;
constexpr std::size_t kFullDotSize = 9;

// What a camera sends that is off, or set to another format than the report's (xwiimote,
// doc/PROTOCOL). No four dots have these bytes.
bool says_nothing(ByteView dots) {
  return (dots[0] == 0xff || dots[0] == 0x00) &&
         std::ranges::all_of(dots, [&](std::uint8_t byte) { return byte == dots[0]; });
}

std::optional<IrDot> dot_at(int x_px, int y_px, int size) {
  if (y_px >= kRows_px) return std::nullopt;
  return IrDot{x_px, y_px, size, std::nullopt};
}

// "x y [y:9-8 x:9-8 size:3-0]"
std::optional<IrDot> extended_dot(ByteView bytes) {
  const int high = bytes[2];
  return dot_at(bytes[0] | (high << 4 & 0x300), bytes[1] | (high << 2 & 0x300), high & 0x0f);
}

// An extended dot, then "x_min y_min x_max y_max 0 intensity".
std::optional<IrDot> full_dot(ByteView bytes) {
  std::optional<IrDot> dot = extended_dot(bytes);
  if (dot)
    dot->blob = Blob{bytes[3] & 0x7f, bytes[4] & 0x7f, bytes[5] & 0x7f, bytes[6] & 0x7f, bytes[8]};
  return dot;
}

IrSlots extended_slots(ByteView bytes) {
  IrSlots slots;
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i] = extended_dot(bytes.subspan(3 * i));
  return slots;
}

// Two pairs of "x1 y1 [y1:9-8 x1:9-8 y2:9-8 x2:9-8] x2 y2".
IrSlots basic_slots(ByteView bytes) {
  IrSlots slots;
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const ByteView b = bytes.subspan(5 * pair, 5);
    slots[2 * pair] = dot_at(b[0] | (b[2] << 4 & 0x300), b[1] | (b[2] << 2 & 0x300), 0);
    slots[2 * pair + 1] = dot_at(b[3] | (b[2] << 8 & 0x300), b[4] | (b[2] << 6 & 0x300), 0);
  }
  return slots;
}

/// Where a data report has what; 0 for what it has not.
struct DataLayout {
  std::size_t size;  // with the id
  std::size_t acceleration_at;
  std::size_t dots_at;
  std::uint8_t id;
  IrFormat format;
};

constexpr DataLayout kDataLayouts[] = {
    {3, 0, 0, 0x30, {}},                   // buttons
    {6, 3, 0, 0x31, {}},                   // and acceleration
    {11, 0, 0, 0x32, {}},                  // and 8 bytes of the extension
    {18, 3, 6, 0x33, IrFormat::extended},  // acceleration and 12 bytes of dots
    {22, 0, 0, 0x34, {}},                  // 19 bytes of the extension
    {22, 3, 0, 0x35, {}},                  // acceleration and 16 bytes of the extension
    {22, 0, 3, 0x36, IrFormat::basic},     // 10 bytes of dots and 9 of the extension
    {22, 3, 6, 0x37, IrFormat::basic},     // acceleration, 10 bytes of dots and 6
    {22, 0, 0, 0x3d, {}},                  // 21 bytes of the extension, no buttons
};

Buttons buttons_of(ByteView bytes) {
  return static_cast<Buttons>((bytes[1] & 0x1f) << 8 | (bytes[2] & 0x9f));
}

// The lowest bits lie among the buttons; y and z have nine.
std::array<int, 3> acceleration_of(ByteView bytes) {
  return {bytes[3] << 2 | (bytes[1] >> 5 & 3), bytes[4] << 2 | (bytes[2] >> 4 & 2),
          bytes[5] << 2 | (bytes[2] >> 5 & 2)};
}

DataReport data_report(const DataLayout& layout, ByteView bytes) {
  DataReport report{.id = layout.id};
  if (layout.id != 0x3d) report.buttons = buttons_of(bytes);
  if (layout.acceleration_at) report.acceleration_raw = acceleration_of(bytes);
  if (layout.dots_at) {
    const bool basic = layout.format == IrFormat::basic;
    const ByteView dots = bytes.subspan(layout.dots_at, basic ? 10 : 12);
    report.camera_silent = says_nothing(dots);
    report.slots = report.camera_silent ? IrSlots{}
                   : basic              ? basic_slots(dots)
                                        : extended_slots(dots);
  }
  return report;
}

StatusReport status_report(ByteView bytes) {
  const int flags = bytes[3];
  return {.buttons = buttons_of(bytes),
          .battery_low = (flags & 0x01) != 0,
          .extension = (flags & 0x02) != 0,
          .camera_on = (flags & 0x08) != 0,
          .leds = flags >> 4,
          .battery = bytes[6]};
}

MemoryReport memory_report(ByteView bytes) {
  MemoryReport report{
      .buttons = buttons_of(bytes), .address = bytes[4] << 8 | bytes[5], .error = bytes[3] & 0x0f};
  if (report.error == 0) report.size = (bytes[3] >> 4) + 1;
  std::ranges::copy(bytes.subspan(6, 16), report.data.begin());
  return report;
}

HalfReport half_report(ByteView bytes) {
  const int b1 = bytes[1], b2 = bytes[2];
  const bool second = bytes[0] == 0x3f;
  const ByteView dots = bytes.subspan(4, 2 * kFullDotSize);
  HalfReport report{.second = second,
                    .buttons = buttons_of(bytes),
                    .acceleration_raw = bytes[3] << 2,
                    .z_bits = (b1 >> 5 & 3) | (b2 >> 3 & 0x0c),
                    .slots = {},
                    .camera_silent = says_nothing(dots)};
  if (!report.camera_silent) report.slots = {full_dot(dots), full_dot(dots.subspan(kFullDotSize))};
  return report;
}

std::optional<Report> parse_sized(ByteView bytes, std::size_t& needed) {
  const auto fits = [&](std::size_t size) {
    needed = size;
    return bytes.size() >= size;
  };
  switch (bytes[0]) {
    case 0x20:
      return fits(7) ? std::optional<Report>(status_report(bytes)) : std::nullopt;
    case 0x21:
      return fits(22) ? std::optional<Report>(memory_report(bytes)) : std::nullopt;
    case 0x22:
      return fits(5) ? std::optional<Report>(
                           Acknowledgement{buttons_of(bytes), bytes[3], static_cast<int>(bytes[4])})
                     : std::nullopt;
    case 0x3e:
    case 0x3f:
      return fits(22) ? std::optional<Report>(half_report(bytes)) : std::nullopt;
    default:
      break;
  }
  const auto* layout = std::ranges::find(kDataLayouts, bytes[0], &DataLayout::id);
  if (layout == std::end(kDataLayouts) || !fits(layout->size)) return std::nullopt;
  return data_report(*layout, bytes);
}

}  // namespace

ParsedReport parse_report(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return {std::nullopt, ReportProblem::too_short};
  std::size_t needed = 0;
  const auto report = parse_sized(bytes, needed);
  if (report) return {report, ReportProblem::none};
  return {std::nullopt, needed ? ReportProblem::too_short : ReportProblem::unknown_id};
}

DataReport join(const HalfReport& first, const HalfReport& second) {
  assert(!first.second && second.second);
  return {.id = 0x3e,
          .buttons = second.buttons,
          .acceleration_raw = std::array{first.acceleration_raw, second.acceleration_raw,
                                         (first.z_bits << 4 | second.z_bits) << 2},
          .slots = IrSlots{first.slots[0], first.slots[1], second.slots[0], second.slots[1]},
          .camera_silent = first.camera_silent && second.camera_silent};
}

DotList dots_of(const IrSlots& slots) {
  DotList dots;
  for (const auto& slot : slots)
    if (slot)
      dots.push_back(
          {static_cast<double>(slot->x_px), static_cast<double>(slot->y_px), slot->size});
  return dots;
}

}  // namespace vindu
