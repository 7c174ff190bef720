#include "renderer/overlay_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/text.h"

namespace vindu {
namespace {

constexpr Rgba8 kPanel{20, 23, 28, 255};
constexpr Rgba8 kPlot{31, 35, 42, 255};
constexpr Rgba8 kLine{62, 69, 80, 255};
constexpr Rgba8 kHeading{238, 240, 243, 255};
constexpr Rgba8 kValue{205, 210, 217, 255};
constexpr Rgba8 kFaded{134, 142, 153, 255};

/// By Part. What is waited for is grey; the colours are Okabe & Ito's (Color Universal Design,
/// 2008), which people of every colour vision tell apart.
constexpr std::array<Rgba8, kParts> kPartColours = {{{118, 126, 138, 255},
                                                     {204, 121, 167, 255},
                                                     {86, 180, 233, 255},
                                                     {0, 114, 178, 255},
                                                     {0, 158, 115, 255},
                                                     {240, 228, 66, 255},
                                                     {230, 159, 0, 255},
                                                     {84, 91, 102, 255}}};
constexpr int kGapBars = 3;  // dark ones behind the newest

void fill(Image& image, int x, int y, int width, int height, Rgba8 colour) {
  const int right = std::min(x + width, image.width_px),
            low = std::min(y + height, image.height_px);
  for (int row = std::max(y, 0); row < low; ++row)
    for (int column = std::max(x, 0); column < right; ++column) image.at(column, row) = colour;
}

struct Styles {
  TextStyle title, aside, plain, faded;
};

Styles styles_of(const OverlayLayout& layout) {
  return {.title = {.height_px = 1.2 * layout.text_px, .colour = kHeading, .bold = true},
          .aside = {.height_px = 1.2 * layout.text_px, .colour = kHeading},
          .plain = {.height_px = layout.text_px, .colour = kValue},
          .faded = {.height_px = layout.text_px, .colour = kFaded}};
}

void text_to_right(Image& image, int right, int y, const std::string& text,
                   const TextStyle& style) {
  draw_text(image, right - text_width_px(text, style), y, text, style);
}

int column_px(const OverlayLayout& layout) {
  return static_cast<int>(std::lround(3.6 * layout.text_px));
}

bool fits(const OverlayRow& row, const OverlayLayout& layout) {
  const TextStyle style{.height_px = layout.text_px};
  const int inner = layout.size.width - 2 * layout.pad_px;
  int taken = row.label.empty() ? 0 : text_width_px(row.label, style) + layout.pad_px / 2;
  if (row.values.size() > 1)
    taken += static_cast<int>(row.values.size()) * column_px(layout);
  else if (!row.values.empty())
    taken += text_width_px(row.values.front(), style);
  return taken <= inner;
}

void draw_row(const OverlayRow& row, int y, const OverlayLayout& layout, Image& image) {
  const Styles styles = styles_of(layout);
  draw_text(image, layout.pad_px, y, row.label, styles.faded);
  const TextStyle& style = row.label.empty() ? styles.faded : styles.plain;
  int right = layout.size.width - layout.pad_px;
  for (auto value = row.values.rbegin(); value != row.values.rend(); ++value) {
    text_to_right(image, right, y, *value, style);
    right -= column_px(layout);
  }
}

void draw_legend(const FrameTimeline& timeline, const OverlayLayout& layout, Image& image) {
  const Styles styles = styles_of(layout);
  const int inner = layout.size.width - 2 * layout.pad_px;
  const int gap = layout.legend_columns > 1 ? 2 * layout.pad_px : 0;
  const int width = (inner - gap * (layout.legend_columns - 1)) / layout.legend_columns;
  const int lines = kParts / layout.legend_columns;
  const int swatch = static_cast<int>(std::lround(0.62 * layout.text_px));
  for (int part = 0; part < kParts; ++part) {
    const int x = layout.pad_px + part / lines * (width + gap);
    const int y = layout.legend_y_px + part % lines * layout.line_px;
    const auto index = static_cast<std::size_t>(part);
    fill(image, x, y + (static_cast<int>(layout.text_px) - swatch) / 2, swatch, swatch,
         kPartColours[index]);
    draw_text(image, x + swatch * 8 / 5, y, name_of(static_cast<Part>(part)), styles.faded);
    text_to_right(image, x + width, y, fmt::format("{:.1f}", timeline.mean_ms[index]),
                  styles.plain);
  }
}

/// Bars share the width; some are a pixel wider than others.
int bar_x(const OverlayLayout& layout, int slot) {
  return layout.pad_px + slot * (layout.size.width - 2 * layout.pad_px) / layout.bars;
}

/// Rows of pixels above the plot's lower edge.
int height_of(double ms, const FrameTimeline& timeline, const OverlayLayout& layout) {
  const double share = std::clamp(ms / timeline.full_ms, 0.0, 1.0);
  return static_cast<int>(std::lround(share * layout.plot_height_px));
}

void draw_plot_ground(const FrameTimeline& timeline, const OverlayLayout& layout, int x, int width,
                      Image& image) {
  fill(image, x, layout.plot_y_px, width, layout.plot_height_px, kPlot);
  if (height_of(timeline.period_ms, timeline, layout) < 6) return;  // lines too close to be read
  for (double ms = timeline.period_ms; ms < timeline.full_ms; ms += timeline.period_ms)
    fill(image, x, layout.plot_y_px + layout.plot_height_px - height_of(ms, timeline, layout),
         width, 1, kLine);
}

void draw_timeline(const FrameTimeline& timeline, const OverlayLayout& layout, Image& image) {
  draw_plot_ground(timeline, layout, layout.pad_px, layout.size.width - 2 * layout.pad_px, image);
  const auto bars = static_cast<std::size_t>(layout.bars);
  const std::size_t first = timeline.count > bars ? timeline.count - bars : 0;
  for (std::size_t frame = first; frame < timeline.count; ++frame)
    draw_bar(timeline, frame, layout, image);
}

}  // namespace

double full_scale_ms(double longest_ms) {
  constexpr std::array<double, 10> kScales = {10, 20, 30, 50, 100, 200, 300, 500, 1000, 3000};
  const auto scale =
      std::ranges::find_if(kScales, [&](double full) { return full >= 1.1 * longest_ms; });
  return scale == kScales.end() ? kScales.back() : *scale;
}

double text_px_for(int tile_width_px) { return std::clamp(tile_width_px / 60.0, 9.0, 20.0); }

OverlayLayout layout_of(const OverlayPage& page, SizePx room) {
  OverlayLayout layout;
  layout.text_px = page.text_px > 0 ? page.text_px : text_px_for(room.width);
  layout.line_px = static_cast<int>(std::lround(1.3 * layout.text_px));
  layout.pad_px = static_cast<int>(std::lround(0.6 * layout.text_px));
  layout.size.width = std::min(room.width, static_cast<int>(std::lround(23 * layout.text_px)));
  const int inner = layout.size.width - 2 * layout.pad_px, line = layout.line_px;
  int y = layout.pad_px + static_cast<int>(std::lround(1.45 * layout.text_px));
  // What is left after each step; what is more important takes its room first.
  int left = room.height - y - layout.pad_px / 2;
  const int wide_enough = static_cast<int>(std::lround(17 * layout.text_px));
  const bool below = !page.below.empty() && left > 16 * line && inner >= wide_enough;
  if (below) {
    layout.below_y_px = y;
    y += line;
    left -= line;
  }
  if (page.timeline && left >= 2 * line && inner > 20) {
    layout.plot_height_px = left > 12 * line ? 5 * line : std::min(2 * line + line / 2, left);
    layout.plot_y_px = y + layout.pad_px / 2;
    layout.bars = std::min(static_cast<int>(FrameTimeline::kFrames), inner);
    y = layout.plot_y_px + layout.plot_height_px + layout.pad_px;
    left = room.height - y - layout.pad_px / 2;
    layout.legend_columns = inner >= wide_enough ? 2 : 1;
    const int lines = kParts / layout.legend_columns;
    if (left >= (lines + 3) * line) {
      layout.legend_y_px = y;
      y += lines * line + layout.pad_px / 3;
      left = room.height - y - layout.pad_px / 2;
    }
  }
  layout.rows_y_px = y;
  for (std::size_t row = 0; row < page.rows.size() && left >= line; ++row) {
    const bool head = page.rows[row].label.empty() && row + 1 < page.rows.size();
    if (!fits(page.rows[head ? row + 1 : row], layout)) continue;
    layout.rows.push_back(row);
    y += line;
    left -= line;
  }
  layout.size.height = std::min(room.height, y + layout.pad_px / 2);
  return layout;
}

Image draw_page(const OverlayPage& page, const OverlayLayout& layout) {
  Image image = Image::filled(layout.size.width, layout.size.height, kPanel);
  const Styles styles = styles_of(layout);
  const int right = layout.size.width - layout.pad_px;
  draw_text(image, layout.pad_px, layout.pad_px, page.title, styles.title);
  if (text_width_px(page.title, styles.title) + text_width_px(page.aside, styles.aside) +
          layout.pad_px <=
      right - layout.pad_px)
    text_to_right(image, right, layout.pad_px, page.aside, styles.aside);
  if (layout.below_y_px > 0) {
    draw_text(image, layout.pad_px, layout.below_y_px, page.below, styles.faded);
    if (page.timeline)  // above the bars, which are drawn anew without it
      text_to_right(image, right, layout.below_y_px, fmt::format("{:g} ms", page.timeline->full_ms),
                    styles.faded);
  }
  if (layout.plot_height_px > 0) {
    draw_timeline(*page.timeline, layout, image);
    if (layout.legend_y_px > 0) draw_legend(*page.timeline, layout, image);
  }
  int y = layout.rows_y_px;
  for (const std::size_t row : layout.rows) {
    draw_row(page.rows[row], y, layout, image);
    y += layout.line_px;
  }
  return image;
}

ColumnsPx draw_bar(const FrameTimeline& timeline, std::size_t frame, const OverlayLayout& layout,
                   Image& image) {
  const int slot = static_cast<int>(frame % static_cast<std::size_t>(layout.bars));
  const int x = bar_x(layout, slot);
  const int bar_width = bar_x(layout, slot + 1) - x;
  const int width = bar_x(layout, std::min(slot + 1 + kGapBars, layout.bars)) - x;
  draw_plot_ground(timeline, layout, x, width, image);
  const FrameParts& parts = timeline.frames[frame % FrameTimeline::kFrames];
  const int low = layout.plot_y_px + layout.plot_height_px;
  double sum_ms = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    const int from = height_of(sum_ms, timeline, layout);
    sum_ms += milliseconds(parts.durations[part]);
    const int to = height_of(sum_ms, timeline, layout);
    if (to > from) fill(image, x, low - to, bar_width, to - from, kPartColours[part]);
  }
  return {x, width};
}

}  // namespace vindu
