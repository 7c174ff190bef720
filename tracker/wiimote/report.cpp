#include "tracker/wiimote/report.h"

namespace vindu {
namespace {

constexpr std::uint8_t kButtonsAccelerometerDots = 0x33;
constexpr std::size_t kReportSize = 18;
constexpr std::size_t kDotsAt = 6;
constexpr std::size_t kDotSize = 3;
constexpr int kRows_px = 768;

// "x y [y:9-8 x:9-8 size:3-0]"
std::optional<Dot> read_dot(std::span<const std::uint8_t, kDotSize> slot) {
  const int high = slot[2];
  const int x_px = slot[0] | (high << 4 & 0x300);
  const int y_px = slot[1] | (high << 2 & 0x300);
  if (y_px >= kRows_px) return std::nullopt;
  return Dot{static_cast<double>(x_px), static_cast<double>(y_px), high & 0x0f};
}

}  // namespace

ParsedReport parse_report(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return {std::nullopt, ReportProblem::wrong_length};
  if (bytes[0] != kButtonsAccelerometerDots) return {std::nullopt, ReportProblem::wrong_id};
  if (bytes.size() != kReportSize) return {std::nullopt, ReportProblem::wrong_length};
  WiimoteReport report;
  report.buttons = static_cast<std::uint16_t>((bytes[1] & 0x1f) << 8 | (bytes[2] & 0x9f));
  report.acceleration_raw = {bytes[3] << 2 | (bytes[1] >> 5 & 3),
                             bytes[4] << 2 | (bytes[2] >> 4 & 2),
                             bytes[5] << 2 | (bytes[2] >> 5 & 2)};
  for (std::size_t at = kDotsAt; at < kReportSize; at += kDotSize)
    if (const auto dot = read_dot(bytes.subspan(at).first<kDotSize>())) report.dots.push_back(*dot);
  return {report, ReportProblem::none};
}

}  // namespace vindu
