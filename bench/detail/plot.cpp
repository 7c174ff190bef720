#include "bench/detail/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/diagram.h"

namespace vindu {
namespace {

constexpr int kLeft_px = 90, kTop_px = 110, kWidth_px = 760, kHeight_px = 420;
constexpr double kLeastTriangles = 1e4, kMostTriangles = 1e7;
constexpr double kLeast_ms = 1, kMost_ms = 1e4;

Vec2 at(double triangles, double ms) {
  const double right =
      std::log(triangles / kLeastTriangles) / std::log(kMostTriangles / kLeastTriangles);
  const double up =
      std::log(std::clamp(ms, kLeast_ms, kMost_ms) / kLeast_ms) / std::log(kMost_ms / kLeast_ms);
  return {kLeft_px + right * kWidth_px, kTop_px + (1 - up) * kHeight_px};
}

void draw_axes(Diagram& diagram) {
  for (double ms = kLeast_ms; ms <= 1.01 * kMost_ms; ms *= 10) {
    diagram.line(at(kLeastTriangles, ms), at(kMostTriangles, ms), 1, kFaint);
    diagram.text(at(kLeastTriangles, ms) - Vec2(10, 9), fmt::format("{:.0f}", ms), {15, kDim},
                 Diagram::Align::right);
  }
  for (double triangles = kLeastTriangles; triangles <= 1.01 * kMostTriangles; triangles *= 10) {
    diagram.line(at(triangles, kLeast_ms), at(triangles, kMost_ms), 1, kFaint);
    const std::string words = triangles < 1e6 ? fmt::format("{:.0f} k", triangles / 1e3)
                                              : fmt::format("{:.0f} M", triangles / 1e6);
    diagram.text(at(triangles, kLeast_ms) + Vec2(0, 8), words, {15, kDim}, Diagram::Align::middle);
  }
  diagram.text(at(std::sqrt(kLeastTriangles * kMostTriangles), kLeast_ms) + Vec2(0, 30),
               "triangles of the model", {15, kDim}, Diagram::Align::middle);
}

}  // namespace

Image detail_plot(const std::vector<DetailCurve>& curves, const std::string& words) {
  Diagram diagram({kLeft_px + kWidth_px + 50, kTop_px + kHeight_px + 70}, kPaper);
  diagram.text({kLeft_px, 16}, "A frame, ms", {20, kInk, true});
  diagram.text({kLeft_px, 44}, words, {15, kDim});
  draw_axes(diagram);
  Vec2 legend(kLeft_px, 82);
  for (const DetailCurve& curve : curves) {
    diagram.line(legend, legend + Vec2(30, 0), 3, curve.colour);
    diagram.text(legend + Vec2(38, -9), curve.name, {16, kInk});
    legend.x() += 60 + 9.0 * static_cast<double>(curve.name.size());
    for (std::size_t i = 0; i < curve.triangles_and_ms.size(); ++i) {
      const auto& [triangles, ms] = curve.triangles_and_ms[i];
      if (i > 0)
        diagram.line(at(curve.triangles_and_ms[i - 1].first, curve.triangles_and_ms[i - 1].second),
                     at(triangles, ms), 3, curve.colour);
      diagram.disc(at(triangles, ms), 5, curve.colour);
    }
  }
  return diagram.image();
}

}  // namespace vindu
