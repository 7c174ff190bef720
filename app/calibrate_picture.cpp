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

/// A panel's picture is as wide as its cells, whatever the camera's is.
void draw_mark(const PictureMark& mark, const CoveragePanel& panel, const Vec2& picture_at_px,
               Diagram& drawing) {
  constexpr double kRing_px = 6;
  constexpr int kSides = 32;
  const Vec2 scale(Coverage::kColumns * kCell_px / panel.size_px.x(),
                   Coverage::kRows * kCell_px / panel.size_px.y());
  const Vec2 centre_px = picture_at_px + mark.image_px.cwiseProduct(scale);
  drawing.disc(centre_px, mark.radius_px * scale.x(), kYellow);
  const auto on_ring = [&](int side) -> Vec2 {
    const double angle_rad = 2 * kPi * side / kSides;
    return centre_px + kRing_px * Vec2(std::cos(angle_rad), std::sin(angle_rad));
  };
  for (const auto& [width_px, colour] : {std::pair{4, kInk}, std::pair{2, kYellow}})
    for (int side = 0; side < kSides; ++side)
      drawing.line(on_ring(side), on_ring(side + 1), width_px, colour);
  drawing.text(centre_px + Vec2(kRing_px + 1, -kRing_px - 8), mark.name, {14, kBright, true});
}

void draw_panel(const CoveragePanel& panel, int left_px, Diagram& drawing) {
  const Vec2 picture_at_px(left_px + kRim_px, kRim_px + kTitle_px);
  drawing.text({left_px + kRim_px, kRim_px / 2}, panel.title, {22, kBright, true});
  for (int row = 0; row < Coverage::kRows; ++row)
    for (int column = 0; column < Coverage::kColumns; ++column) {
      const int count =
          panel.coverage.dots[static_cast<std::size_t>(row) * Coverage::kColumns + column];
      const Vec2 at_px = picture_at_px + kCell_px * Vec2(column, row);
      drawing.rectangle(at_px, at_px + Vec2::Constant(kCell_px - 2), colour_of(count));
      drawing.text(at_px + Vec2(6, kCell_px - 24), std::to_string(count), {15, kBright});
    }
  for (const PictureMark& mark : panel.marks) draw_mark(mark, panel, picture_at_px, drawing);
}

}  // namespace

CoveragePanel covered_panel(const std::string& camera, const Coverage& coverage) {
  return {.title = fmt::format("{}: {:.0f} % covered", camera, 100 * coverage.share()),
          .coverage = coverage};
}

Image coverage_picture(const std::vector<CoveragePanel>& panels) {
  Diagram drawing({static_cast<int>(panels.size()) * kPanelWidth_px, kPanelHeight_px}, kDarkPaper);
  for (std::size_t i = 0; i < panels.size(); ++i)
    draw_panel(panels[i], static_cast<int>(i) * kPanelWidth_px, drawing);
  return drawing.image();
}

}  // namespace vindu::app
