#include "app/calibrate_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/diagram.h"
#include "renderer/text.h"

namespace vindu::app {
namespace {

constexpr int kCell_px = 64, kRim_px = 24, kTitle_px = 40;
constexpr int kPanelWidth_px = Coverage::kColumns * kCell_px + 2 * kRim_px;
constexpr int kPanelHeight_px = Coverage::kRows * kCell_px + kTitle_px + 2 * kRim_px;
constexpr Rgba8 kNever{70, 28, 28, 255};

/// Dark green for one dot to light green for 200 and more.
Rgba8 colour_of(int count) {
  if (count == 0) return kNever;
  const double share = std::min(1.0, std::log(1.0 * count) / std::log(200.0));
  const auto level = [&](double from, double to) {
    return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
  };
  return {level(20, 120), level(70, 200), level(40, 110), 255};
}

void draw_panel(Image& image, int left, const CoveragePanel& panel) {
  draw_text(image, left + kRim_px, kRim_px / 2,
            fmt::format("{}: {:.0f} % covered", panel.title, 100 * panel.coverage.share()),
            {22, kBright, true});
  for (int row = 0; row < Coverage::kRows; ++row)
    for (int column = 0; column < Coverage::kColumns; ++column) {
      const int count =
          panel.coverage.dots[static_cast<std::size_t>(row) * Coverage::kColumns + column];
      const int x = left + kRim_px + column * kCell_px;
      const int y = kRim_px + kTitle_px + row * kCell_px;
      paste(Image::filled(kCell_px - 2, kCell_px - 2, colour_of(count)), x, y, image);
      draw_text(image, x + 6, y + kCell_px - 24, std::to_string(count), {15, kBright});
    }
}

}  // namespace

Image coverage_picture(const std::vector<CoveragePanel>& panels) {
  Image image =
      Image::filled(static_cast<int>(panels.size()) * kPanelWidth_px, kPanelHeight_px, kDarkPaper);
  for (std::size_t i = 0; i < panels.size(); ++i)
    draw_panel(image, static_cast<int>(i) * kPanelWidth_px, panels[i]);
  return image;
}

}  // namespace vindu::app
