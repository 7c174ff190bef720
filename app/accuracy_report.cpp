#include "app/accuracy_report.h"

#include <fmt/format.h>

#include "app/common.h"

namespace vindu::app {
namespace {

constexpr const char* kNone = "-";

std::string ratio(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : kNone;
}

std::string percent(double share) { return fmt::format("{:.1f}", 100 * share); }

/// Shares of the frames with six degrees of freedom, hybrid, by position; per cent.
template <std::size_t N>
std::string levels_text(const std::array<double, N>& levels) {
  return fmt::format("{:.0f}/{:.0f}/{:.0f}", 100 * levels[0], 100 * levels[1], 100 * levels[2]);
}

std::string frame_line(const FrameRow& row) {
  const FrameErrors &ours = row.study.joint, &bound = row.study.bound;
  if (!row.over_bound())
    return fmt::format("{:<49}{:>6} ({:>4} /{:>5}){:>6}{:>7}{:>6} |\n", name_of(row), kNone, kNone,
                       kNone, kNone, percent(ours.found), percent(ours.wrong));
  std::string line =
      fmt::format("{:<49}{:>6.1f} ({:>4.1f} /{:>5.1f}){:>6.2f}{:>7}{:>6} |{:>6.1f}{:>6.2f}{:>6} |",
                  name_of(row), 1e3 * ours.eye_m, 1e3 * ours.lateral_m, 1e3 * ours.depth_m,
                  degrees(ours.rotation_rad), percent(ours.found), percent(ours.wrong),
                  1e3 * bound.eye_m, degrees(bound.rotation_rad), ratio(row.over_bound()));
  const auto& thesis = row.study.thesis;
  if (!thesis) return line + "\n";
  if (thesis->found == 0) return line + fmt::format("{:>6}\n", kNone);
  return line + fmt::format("{:>6.1f}{:>6.2f}{:>10}{:>6}{:>6}\n", 1e3 * thesis->eye_m,
                            degrees(thesis->rotation_rad), levels_text(thesis->levels),
                            percent(thesis->wrong), ratio(row.study.joint_over_thesis));
}

std::string moving_line(const MovingRow& row) {
  const TrialErrors &ours = row.study.joint, &fixed = row.study.best_fixed;
  std::string line = fmt::format(
      "{:<65}{:>6.1f}{:>7.1f}{:>6.2f}{:>7} |{:>6g}{:>6.1f}{:>6.2f} |", name_of(row),
      1e3 * ours.eye_rms_m, 1e3 * ours.eye_p95_m, degrees(ours.turn_rms_rad), percent(ours.found),
      row.study.best_noise_m2_s5, 1e3 * fixed.eye_rms_m, row.over_fixed());
  if (!row.thesis) return line + "\n";
  const TrialErrors &thesis = row.thesis->all, &six_dof = row.thesis->six_dof;
  return line + fmt::format("{:>6.1f}{:>6.2f}{:>10}{:>7.1f}{:>6}\n", 1e3 * thesis.eye_rms_m,
                            degrees(thesis.turn_rms_rad), levels_text(thesis.levels),
                            1e3 * six_dof.eye_rms_m, ratio(row.over_thesis()));
}

std::string frame_table(const Accuracy& accuracy, const AccuracyOptions& options) {
  std::string table = fmt::format(
      "Single frames: {} poses a row, 0.5 px of noise, then rounding; rms in mm and degrees\n"
      "{:<49}{:>6} ({:>4} /{:>5}){:>6}{:>7}{:>6} |{:>6}{:>6}{:>6} |{:>6}{:>6}{:>10}{:>6}{:>6}\n",
      options.poses, "", "eye", "lat", "depth", "rot", "found%", "wrong", "bound", "rot", "ratio",
      "thesis", "rot", "6/h/p %", "wrong", "ratio");
  for (const FrameRow& row : accuracy.frames) table += frame_line(row);
  return table;
}

std::string moving_table(const Accuracy& accuracy, const AccuracyOptions& options) {
  std::string table = fmt::format(
      "Moving, 3 m, base 2 m: {:g} s a row; the eye when the light leaves the wall, in mm\n"
      "{:<65}{:>6}{:>7}{:>6}{:>7} |{:>6}{:>6}{:>6} |{:>6}{:>6}{:>10}{:>7}{:>6}\n",
      options.length_s, "", "eye", "p95", "rot", "found%", "noise", "fixed", "ratio", "thesis",
      "rot", "6/h/p %", "6 DoF", "ratio");
  for (const MovingRow& row : accuracy.moving) table += moving_line(row);
  return table;
}

std::string target_table(const Accuracy& accuracy) {
  std::string table = "Targets, each with the row that is farthest from it\n";
  for (const AccuracyTarget& target : targets_of(accuracy))
    table += fmt::format("{:<66}<= {:<5g}{:>7.2f} {:<7}{}\n", target.what, target.limit,
                         target.worst, target.met() ? "met" : "MISSED", target.where);
  return table;
}

std::string json_of(const FrameErrors& errors) {
  return fmt::format(
      R"({{"eye_mm":{},"lateral_mm":{},"depth_mm":{},"rotation_deg":{},"found":{},"wrong":{}}})",
      1e3 * errors.eye_m, 1e3 * errors.lateral_m, 1e3 * errors.depth_m,
      degrees(errors.rotation_rad), errors.found, errors.wrong);
}

std::string json_of(const TrialErrors& errors) {
  return fmt::format(
      R"({{"eye_mm":{},"eye_p95_mm":{},"eye_max_mm":{},"rotation_deg":{},"found":{}}})",
      1e3 * errors.eye_rms_m, 1e3 * errors.eye_p95_m, 1e3 * errors.eye_max_m,
      degrees(errors.turn_rms_rad), errors.found);
}

/// Shares of the frames.
template <std::size_t N>
std::string json_of_levels(const std::array<double, N>& levels) {
  return fmt::format(R"({{"six_dof":{},"hybrid":{},"position":{}}})", levels[0], levels[1],
                     levels[2]);
}

std::string json_of(const FrameRow& row) {
  const FrameStudyOptions& options = row.options;
  std::string text = fmt::format(R"({{"distance_m":{},"baseline_m":{},"cameras":{},"leds":{},)",
                                 options.row.distance_m, options.row.baseline_m,
                                 options.row.cameras, options.head.leds_in_head.size());
  if (options.dots_of_last)
    text += fmt::format(R"("dots_of_last_camera":{},)", *options.dots_of_last);
  text += fmt::format(R"("poses":{},"passed_over":{},"ours":{},"bound":{})", row.study.poses,
                      row.study.passed_over, json_of(row.study.joint), json_of(row.study.bound));
  if (const auto value = row.over_bound()) text += fmt::format(R"(,"ours_over_bound":{})", *value);
  if (row.study.thesis)
    text += fmt::format(R"(,"thesis":{},"thesis_levels":{})", json_of(*row.study.thesis),
                        json_of_levels(row.study.thesis->levels));
  if (const auto value = row.study.joint_over_thesis)
    text += fmt::format(R"(,"ours_over_thesis":{})", *value);
  return text + "}";
}

std::string json_of(const MovingRow& row) {
  const MovingStudyOptions& options = row.options;
  std::string text = fmt::format(
      R"({{"motion":"{}","peak_m_s":{},"link":"{}","photon_lag_ms":{},"cameras":{},"leds":{},)",
      vindu::name_of(options.moves), options.peak_m_s, vindu::name_of(options.link),
      vindu::milliseconds(options.photon_lag), options.row.cameras,
      options.head.leds_in_head.size());
  text += fmt::format(
      R"("ours":{},"best_fixed":{},"best_fixed_noise_m2_s5":{},"ours_over_best_fixed":{})",
      json_of(row.study.joint), json_of(row.study.best_fixed), row.study.best_noise_m2_s5,
      row.over_fixed());
  if (row.thesis)
    text += fmt::format(R"(,"thesis":{},"thesis_levels":{},"thesis_six_dof":{})",
                        json_of(row.thesis->all), json_of_levels(row.thesis->all.levels),
                        json_of(row.thesis->six_dof));
  if (const auto value = row.over_thesis())
    text += fmt::format(R"(,"ours_over_thesis":{})", *value);
  return text + "}";
}

std::string json_of(const AccuracyTarget& target) {
  return fmt::format(R"({{"what":{},"limit":{},"worst":{},"where":{},"met":{}}})",
                     json_text(target.what), target.limit, target.worst, json_text(target.where),
                     target.met());
}

template <class Row>
std::string json_list(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) text += (text.empty() ? "" : ",") + json_of(row);
  return "[" + text + "]";
}

}  // namespace

std::string accuracy_tables(const Accuracy& accuracy, const AccuracyOptions& options) {
  return frame_table(accuracy, options) + "\n" + moving_table(accuracy, options) + "\n" +
         "The thesis' method: 6/h/p: shares of its frames with six degrees of freedom, hybrid, by "
         "position;\nratio: single frames: over poses that both find right; moving: over 6 "
         "DoF\n\n" +
         target_table(accuracy);
}

std::string accuracy_json(const Accuracy& accuracy, const AccuracyOptions& options,
                          const std::string& picture) {
  return fmt::format(
      R"({{"poses":{},"seconds":{},"seed":{},"single_frame":{},"moving":{},"targets":{},)"
      R"("picture":{}}})"
      "\n",
      options.poses, options.length_s, options.seed, json_list(accuracy.frames),
      json_list(accuracy.moving), json_list(targets_of(accuracy)), json_text(picture));
}

}  // namespace vindu::app
