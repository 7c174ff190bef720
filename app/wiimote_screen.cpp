#include "app/wiimote_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/buttons.h"
#include "renderer/diagram.h"
#include "renderer/text.h"
#include "tracker/wiimote/find.h"

namespace vindu::app {
namespace {

constexpr int kTextColumns = 64, kTextRows = 24;
constexpr int kSensorWidth_px = 1024, kSensorHeight_px = 768;

constexpr Rgba8 kSensor{6, 7, 9, 255};
constexpr Rgba8 kWarning{240, 180, 90, 255};
constexpr Rgba8 kSlotColours[] = {
    {255, 120, 110, 255}, {120, 220, 130, 255}, {120, 180, 255, 255}, {245, 210, 110, 255}};
constexpr int kPanelWidth = 560, kMargin = 24;
constexpr int kSensorWidth = kPanelWidth - 2 * kMargin, kSensorHeight = kSensorWidth * 3 / 4;
constexpr int kPanelHeight = kSensorHeight + 213;

std::string acceleration_text(const WatchedWiimote& wiimote) {
  if (!wiimote.data || !wiimote.data->acceleration_raw) return "";
  const auto& raw = *wiimote.data->acceleration_raw;
  if (!wiimote.state.health.calibration)
    return fmt::format("acceleration {} {} {} (raw)", raw[0], raw[1], raw[2]);
  const auto g = acceleration_g(raw, *wiimote.state.health.calibration);
  return fmt::format("acceleration {:+.2f} {:+.2f} {:+.2f} g", g[0], g[1], g[2]);
}

std::string battery_text(const WatchedWiimote& wiimote) {
  const auto& status = wiimote.state.health.status;
  return status ? fmt::format("battery {:.0f} %", 100 * battery_charge(status->battery)) : "";
}

std::string dots_text(const WatchedWiimote& wiimote) {
  std::string text;
  if (!wiimote.data || !wiimote.data->slots) return "no dots yet";
  for (std::size_t slot = 0; slot < 4; ++slot) {
    const auto& dot = (*wiimote.data->slots)[slot];
    text +=
        dot ? fmt::format("{}: {:4} {:3} size {:<2}  ", slot + 1, dot->x_px, dot->y_px, dot->size)
            : fmt::format("{}: -                  ", slot + 1);
  }
  return text;
}

std::string frame_of(const WatchedWiimote& wiimote) {
  std::vector<std::string> rows(kTextRows, std::string(kTextColumns, ' '));
  if (wiimote.data && wiimote.data->slots)
    for (std::size_t slot = 0; slot < 4; ++slot)
      if (const auto& dot = (*wiimote.data->slots)[slot])
        rows[dot->y_px * kTextRows / kSensorHeight_px][dot->x_px * kTextColumns / kSensorWidth_px] =
            static_cast<char>('1' + slot);
  std::string text = '+' + std::string(kTextColumns, '-') + "+\n";
  for (const std::string& row : rows) text += '|' + row + "|\n";
  return text + '+' + std::string(kTextColumns, '-') + "+\n";
}

void fill(Image& image, int x, int y, SizePx size, Rgba8 colour) {
  paste(Image::filled(size.width, size.height, colour), x, y, image);
}

void draw_disc(Image& image, double x, double y, double radius_px, Rgba8 colour) {
  const int reach = static_cast<int>(radius_px) + 1;
  for (int row = static_cast<int>(y) - reach; row <= static_cast<int>(y) + reach; ++row)
    for (int column = static_cast<int>(x) - reach; column <= static_cast<int>(x) + reach; ++column)
      if (row >= 0 && column >= 0 && row < image.height_px && column < image.width_px &&
          std::hypot(column - x, row - y) <= radius_px)
        image.at(column, row) = colour;
}

void draw_dots(Image& image, int left, int top, const IrSlots& slots) {
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    if (!slots[slot]) continue;
    const double x = left + 1.0 * slots[slot]->x_px * kSensorWidth / kSensorWidth_px;
    const double y = top + 1.0 * slots[slot]->y_px * kSensorHeight / kSensorHeight_px;
    draw_disc(image, x, y, 3 + 1.5 * slots[slot]->size, kSlotColours[slot]);
    draw_text(image, static_cast<int>(x) + 12, static_cast<int>(y) - 10, std::to_string(slot + 1),
              {18, kSlotColours[slot], true});
  }
}

void draw_panel(Image& image, int left, const WatchedWiimote& wiimote) {
  int y = 18;
  const int x = left + kMargin;
  const auto line = [&](const std::string& text, const TextStyle& style) {
    draw_text(image, x, y, text, style);
    y += static_cast<int>(style.height_px) + 6;
  };
  line(wiimote.title, {22, kBright, true});
  fill(image, x, y, {kSensorWidth, kSensorHeight}, kSensor);
  if (wiimote.data && wiimote.data->slots) draw_dots(image, x, y, *wiimote.data->slots);
  y += kSensorHeight + 10;
  line(fmt::format("{:.0f} reports/s   {}   buttons {}", wiimote.reports_per_s,
                   battery_text(wiimote), wiimote.data ? text_of(wiimote.data->buttons) : "-"),
       {17, kBright});
  line(acceleration_text(wiimote), {17, kSoft});
  line("gaps: " + text_of(wiimote.state.health.gaps), {17, kSoft});
  line(counts_text(wiimote.state), {17, kSoft});
  line(trouble_text(wiimote.state), {15, kWarning});
}

}  // namespace

std::string summary_of(const WatchedWiimote& wiimote) {
  const std::string trouble = trouble_text(wiimote.state);
  return fmt::format("{:.0f} reports/s  {}  buttons {}  {}  gaps: {}; {}{}", wiimote.reports_per_s,
                     battery_text(wiimote), wiimote.data ? text_of(wiimote.data->buttons) : "-",
                     acceleration_text(wiimote), text_of(wiimote.state.health.gaps),
                     counts_text(wiimote.state), trouble.empty() ? "" : "\n! " + trouble);
}

std::string screen_text(const std::vector<WatchedWiimote>& wiimotes) {
  std::string text;
  for (const WatchedWiimote& wiimote : wiimotes)
    text += wiimote.title + "\n" + frame_of(wiimote) + dots_text(wiimote) + "\n" +
            summary_of(wiimote) + "\n\n";
  return text;
}

Image screen_picture(const std::vector<WatchedWiimote>& wiimotes) {
  const int count = std::max<int>(1, static_cast<int>(wiimotes.size()));
  Image image = Image::filled(count * kPanelWidth, kPanelHeight, kDarkPaper);
  for (std::size_t index = 0; index < wiimotes.size(); ++index)
    draw_panel(image, static_cast<int>(index) * kPanelWidth, wiimotes[index]);
  return image;
}

}  // namespace vindu::app
