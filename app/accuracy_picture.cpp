#include "app/accuracy_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/diagram.h"

namespace vindu::app {
namespace {

constexpr Rgba8 kBand{246, 247, 249, 255};
constexpr Rgba8 kBest{60, 60, 60, 255};

constexpr int kEdge_px = 36;
constexpr int kHeading_px = 120;
constexpr int kNames_px = 390;
constexpr int kScale_px = 470;
constexpr int kBetween_px = 48;
constexpr int kRow_px = 21;
constexpr double kLeast_mm = 0.5, kLargest_mm = 100;

/// One measurement: what is known of its errors, in metres.
struct Line {
  std::string name;
  double ours_m = 0;  ///< 0: nothing was found right
  std::optional<double> thesis_m = {};
  double best_m = 0;          ///< the bound, or the best fixed noise
  bool starts_group = false;  ///< some space before it
};

std::vector<Line> lines_of(const std::vector<FrameRow>& rows) {
  std::vector<Line> lines;
  const auto group = [](const FrameRow& row) {
    return std::tuple(row.options.row.cameras, row.options.head.leds_in_head.size(),
                      row.options.dots_of_last.has_value());
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FrameRow& row = rows[i];
    Line line{.name = name_of(row), .ours_m = row.study.joint.eye_m};
    if (row.study.joint_over_thesis) line.thesis_m = row.study.thesis->eye_m;
    line.best_m = row.study.bound.eye_m;
    line.starts_group = i > 0 && group(row) != group(rows[i - 1]);
    lines.push_back(line);
  }
  return lines;
}

std::vector<Line> lines_of(const std::vector<MovingRow>& rows) {
  std::vector<Line> lines;
  const auto group = [](const MovingRow& row) {
    return std::tuple(row.options.link, row.options.photon_lag, row.options.row.cameras);
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MovingRow& row = rows[i];
    Line line{.name = name_of(row), .ours_m = row.study.joint.eye_rms_m};
    if (row.over_thesis()) line.thesis_m = row.thesis->six_dof.eye_rms_m;
    line.best_m = row.study.best_fixed.eye_rms_m;
    line.starts_group = i > 0 && group(row) != group(rows[i - 1]);
    lines.push_back(line);
  }
  return lines;
}

int height_of(const std::vector<Line>& lines) {
  const auto groups = std::ranges::count_if(lines, &Line::starts_group);
  return kRow_px * static_cast<int>(lines.size()) + kRow_px / 2 * static_cast<int>(groups);
}

double offset_px(double error_m) {
  const double mm = std::clamp(1e3 * error_m, kLeast_mm, kLargest_mm);
  return kScale_px * std::log(mm / kLeast_mm) / std::log(kLargest_mm / kLeast_mm);
}

void draw_scale(Diagram& diagram, const Vec2& corner_px, int height_px) {
  for (const double mm : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    const double x_px = corner_px.x() + offset_px(1e-3 * mm);
    diagram.line({x_px, corner_px.y()}, {x_px, corner_px.y() + height_px}, 1, kFaint);
    diagram.text({x_px, corner_px.y() - 22}, fmt::format("{:g}", mm), {15, kDim},
                 Diagram::Align::middle);
  }
}

void draw_best(Diagram& diagram, const Vec2& at_px) {
  diagram.line(at_px - Vec2(0, 8), at_px + Vec2(0, 8), 2.5, kBest);
}

void draw_marks(Diagram& diagram, const Vec2& left_px, const Line& line) {
  if (line.ours_m == 0) return;
  const auto at = [&](double error_m) -> Vec2 { return left_px + Vec2(offset_px(error_m), 0); };
  if (line.thesis_m) {
    diagram.line(at(line.ours_m), at(*line.thesis_m), 1.5, {213, 94, 0, 90});
    diagram.disc(at(*line.thesis_m), 5, kVermilion);
  }
  diagram.disc(at(line.ours_m), 5.5, kBlue);
  draw_best(diagram, at(line.best_m));
}

void draw_panel(Diagram& diagram, const Vec2& corner_px, const std::string& title,
                const std::vector<Line>& lines) {
  diagram.text(corner_px - Vec2(0, 52), title, {18, kInk, true});
  diagram.text(corner_px + Vec2(kNames_px - 30, -22), "eye, rms, mm", {15, kDim},
               Diagram::Align::right);
  const Vec2 scale_px = corner_px + Vec2(kNames_px, 0);
  double y_px = corner_px.y();
  std::vector<double> rows_px;
  bool shaded = false;
  for (const Line& line : lines) {
    if (line.starts_group) y_px += 0.5 * kRow_px, shaded = false;
    if (shaded)
      diagram.rectangle({corner_px.x() - 6, y_px}, {scale_px.x() + kScale_px + 8, y_px + kRow_px},
                        kBand);
    shaded = !shaded;
    rows_px.push_back(y_px);
    y_px += kRow_px;
  }
  draw_scale(diagram, scale_px, height_of(lines));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    diagram.text({corner_px.x(), rows_px[i] + 2}, lines[i].name, {15, kInk});
    draw_marks(diagram, {scale_px.x(), rows_px[i] + 0.5 * kRow_px}, lines[i]);
  }
}

void draw_legend(Diagram& diagram, Vec2 at_px) {
  const auto name = [&](const std::string& words) {
    diagram.text(at_px + Vec2(14, -9), words, {16, kInk});
    at_px.x() += 40 + text_width_px(words, {16, kInk});
  };
  diagram.disc(at_px, 5.5, kBlue);
  name("Vindu");
  diagram.disc(at_px, 5, kVermilion);
  name("the thesis' method, three LEDs, two cameras");
  draw_best(diagram, at_px);
  name("left: the Cramér-Rao bound; right: the best of six fixed process noises");
}

}  // namespace

Image accuracy_picture(const Accuracy& accuracy, const AccuracyOptions& options) {
  const std::vector<Line> frames = lines_of(accuracy.frames), moving = lines_of(accuracy.moving);
  const int panel_px = kNames_px + kScale_px;
  const int top_px = kHeading_px + 60;
  const int height_px = top_px + std::max(height_of(frames), height_of(moving)) + kEdge_px;
  Diagram diagram({2 * kEdge_px + 2 * panel_px + kBetween_px, height_px}, kPaper);
  diagram.text({kEdge_px, 20}, "How far the tracked eye is from the true one", {32, kInk, true});
  diagram.text({kEdge_px, 62},
               fmt::format("Emulated Wiimotes behind the head, 0.5 px of noise, then rounding; {} "
                           "poses or {:g} s a row, seed {}.",
                           options.poses, options.length_s, options.seed),
               {18, kDim});
  draw_legend(diagram, {kEdge_px + 8, 108});
  draw_panel(diagram, {kEdge_px, static_cast<double>(top_px)}, "One frame, unfiltered", frames);
  draw_panel(diagram, {kEdge_px + panel_px + kBetween_px, static_cast<double>(top_px)},
             "Filtered, predicted to when the light leaves the wall", moving);
  return diagram.image();
}

}  // namespace vindu::app
