#include "bench/frame_lock/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "renderer/diagram.h"

namespace vindu {
namespace {

constexpr int kMargin_px = 36, kTop_px = 150, kBottom_px = 64;
constexpr int kWidth_px = 520, kHeight_px = 400, kGap_px = 100;
constexpr double kMostTiles = 64;
constexpr double kLeast_us = 1, kMost_us = 1e6;

/// One panel: tiles to the right, us upwards, both by their logarithms.
class Panel {
 public:
  Panel(Diagram& diagram, const Vec2& corner_px, const std::string& title)
      : diagram_(diagram), corner_px_(corner_px) {
    diagram_.text(corner_px - Vec2(0, 38), title, {18, kInk, true});
    for (double us = kLeast_us; us <= kMost_us; us *= 10) grid(at(1, us), at(kMostTiles, us), us);
    for (int tiles = 1; tiles <= kMostTiles; tiles *= 2) {
      diagram_.line(at(tiles, kLeast_us), at(tiles, kMost_us), 1, kFaint);
      diagram_.text(at(tiles, kLeast_us) + Vec2(0, 8), std::to_string(tiles), {15, kDim},
                    Diagram::Align::middle);
    }
    diagram_.text(at(8, kLeast_us) + Vec2(0, 30), "tiles", {15, kDim}, Diagram::Align::middle);
  }

  /// Values of 0 (one tile has no skew) are left out.
  void curve(const std::vector<Vec2>& tiles_and_us, Rgba8 colour, double width_px) {
    std::vector<Vec2> marks_px;
    for (const Vec2& each : tiles_and_us)
      if (each.y() > 0) marks_px.push_back(at(each.x(), each.y()));
    for (std::size_t i = 1; i < marks_px.size(); ++i)
      diagram_.line(marks_px[i - 1], marks_px[i], width_px, colour);
    for (const Vec2& mark_px : marks_px) diagram_.disc(mark_px, 1.6 * width_px, colour);
  }

 private:
  Vec2 at(double tiles, double us) const {
    const double right = std::log(tiles) / std::log(kMostTiles);
    const double up =
        std::log(std::clamp(us, kLeast_us, kMost_us) / kLeast_us) / std::log(kMost_us / kLeast_us);
    return corner_px_ + Vec2(right * kWidth_px, (1 - up) * kHeight_px);
  }
  void grid(const Vec2& from_px, const Vec2& to_px, double us) {
    diagram_.line(from_px, to_px, 1, kFaint);
    diagram_.text(from_px - Vec2(10, 9), fmt::format("{:.0f}", us), {15, kDim},
                  Diagram::Align::right);
  }

  Diagram& diagram_;
  Vec2 corner_px_;
};

using Pick = std::function<Spread(const LockSpreads&)>;

void draw_curves(Panel& panel, const std::vector<PlotPoint>& points, const Pick& pick) {
  const auto draw = [&](auto lock, auto share, Rgba8 colour, double width_px) {
    std::vector<Vec2> marks;
    for (const PlotPoint& point : points)
      marks.push_back({static_cast<double>(point.tiles), pick(point.*lock).*share});
    panel.curve(marks, colour, width_px);
  };
  draw(&PlotPoint::udp, &Spread::p50, kVermilion, 1.5);
  draw(&PlotPoint::udp, &Spread::p99, kVermilion, 3.5);
  draw(&PlotPoint::bus, &Spread::p50, kBlue, 1.5);
  draw(&PlotPoint::bus, &Spread::p99, kBlue, 3.5);
}

void draw_legend(Diagram& diagram, Vec2 at_px) {
  const auto name = [&](const std::string& words, Rgba8 colour, double width_px) {
    diagram.line(at_px, at_px + Vec2(30, 0), width_px, colour);
    diagram.disc(at_px + Vec2(15, 0), 1.6 * width_px, colour);
    diagram.text(at_px + Vec2(38, -9), words, {16, kInk});
    at_px.x() += 70 + text_width_px(words, {16, kInk});
  };
  name("Vindu, p99", kBlue, 3.5);
  name("p50", kBlue, 1.5);
  name("raw UDP multicast, p99", kVermilion, 3.5);
  name("p50", kVermilion, 1.5);
}

}  // namespace

Image lock_plot(const std::vector<PlotPoint>& points, const std::string& words) {
  constexpr int kScale_px = 52;
  Diagram diagram({2 * kMargin_px + 2 * kWidth_px + 2 * kScale_px + kGap_px - kScale_px,
                   kTop_px + kHeight_px + kBottom_px},
                  kPaper);
  diagram.text({kMargin_px, 16}, "How closely tiles swap", {28, kInk, true});
  diagram.text({kMargin_px, 54}, words, {16, kDim});
  draw_legend(diagram, {kMargin_px, 90});
  const double left_px = kMargin_px + kScale_px;
  Panel skew(diagram, {left_px, kTop_px}, "First swap to last swap, us");
  draw_curves(skew, points, [](const LockSpreads& lock) { return lock.skew_us; });
  Panel cost(diagram, {left_px + kWidth_px + kGap_px, kTop_px}, "Last tile ready to last swap, us");
  draw_curves(cost, points, [](const LockSpreads& lock) { return lock.cost_us; });
  return diagram.image();
}

}  // namespace vindu
