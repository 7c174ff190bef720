#include "bench/log_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/diagram.h"

namespace vindu {
namespace {

constexpr int kLeft_px = 90, kTop_px = 110, kWidth_px = 760, kHeight_px = 420;
constexpr double kLeast_ms = 1, kMost_ms = 1e4;

class Axes {
 public:
  explicit Axes(const LogAxis& sizes) : sizes_(sizes) {}

  Vec2 at(double size, double ms) const {
    const double least = sizes_.marks.front(), most = sizes_.marks.back();
    const double right = std::log(size / least) / std::log(most / least);
    const double up =
        std::log(std::clamp(ms, kLeast_ms, kMost_ms) / kLeast_ms) / std::log(kMost_ms / kLeast_ms);
    return {kLeft_px + right * kWidth_px, kTop_px + (1 - up) * kHeight_px};
  }

  void draw(Diagram& diagram) const {
    const double least = sizes_.marks.front(), most = sizes_.marks.back();
    for (double ms = kLeast_ms; ms <= 1.01 * kMost_ms; ms *= 10) {
      diagram.line(at(least, ms), at(most, ms), 1, kFaint);
      diagram.text(at(least, ms) - Vec2(10, 9), fmt::format("{:.0f}", ms), {15, kDim},
                   Diagram::Align::right);
    }
    for (const double size : sizes_.marks) {
      diagram.line(at(size, kLeast_ms), at(size, kMost_ms), 1, kFaint);
      diagram.text(at(size, kLeast_ms) + Vec2(0, 8), short_number(size), {15, kDim},
                   Diagram::Align::middle);
    }
    diagram.text(at(std::sqrt(least * most), kLeast_ms) + Vec2(0, 30), sizes_.title, {15, kDim},
                 Diagram::Align::middle);
  }

  void draw(Diagram& diagram, const Curve& curve) const {
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const Vec2 to_px = at(curve.points[i].x(), curve.points[i].y());
      if (i > 0)
        diagram.line(at(curve.points[i - 1].x(), curve.points[i - 1].y()), to_px, 3, curve.colour);
      diagram.disc(to_px, 5, curve.colour);
    }
  }

 private:
  const LogAxis& sizes_;
};

}  // namespace

std::string short_number(double number) {
  if (number >= 1e6) return fmt::format("{:.0f} M", number / 1e6);
  return number >= 1e4 ? fmt::format("{:.0f} k", number / 1e3) : fmt::format("{:.0f}", number);
}

Image log_plot(const std::vector<Curve>& curves, const LogAxis& sizes, const std::string& words) {
  Diagram diagram({kLeft_px + kWidth_px + 50, kTop_px + kHeight_px + 70}, kPaper);
  diagram.text({kLeft_px, 16}, "A frame, ms", {20, kInk, true});
  diagram.text({kLeft_px, 44}, words, {15, kDim});
  const Axes axes(sizes);
  axes.draw(diagram);
  Vec2 legend(kLeft_px, 82);
  for (const Curve& curve : curves) {
    axes.draw(diagram, curve);
    if (curve.name.empty()) continue;
    diagram.line(legend, legend + Vec2(30, 0), 3, curve.colour);
    diagram.text(legend + Vec2(38, -9), curve.name, {16, kInk});
    legend.x() += 60 + 9.0 * static_cast<double>(curve.name.size());
  }
  return diagram.image();
}

}  // namespace vindu
