#include "app/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/common.h"

namespace vindu::app {
namespace {

/// One row of the table, all in milliseconds or millimetres.
struct Row {
  std::string name;
  std::string key;
  Spread spread;
};

template <class Part>
Spread spread_over(const std::vector<FrameRecord>& frames, Part part) {
  std::vector<double> values;
  for (const FrameRecord& frame : frames) values.push_back(part(frame));
  return spread_of(std::move(values));
}

bool tracked(const FrameRecord& frame) {
  return frame.pose && frame.pose->level < TrackingLevel::held;
}

std::vector<FrameRecord> tracked_frames(const std::vector<FrameRecord>& frames) {
  std::vector<FrameRecord> found;
  std::ranges::copy_if(frames, std::back_inserter(found), tracked);
  return found;
}

std::vector<Row> latency_rows(const RunReport& report) {
  const auto& all = report.loop.frames;
  const auto seen = tracked_frames(all);
  const auto ms = [](Part part) {
    return [part](const FrameRecord& frame) { return milliseconds(frame.parts[part]); };
  };
  std::vector<Row> rows;
  if (!seen.empty())
    rows.push_back({"capture age", "capture_age_ms", spread_over(seen, ms(Part::capture_age))});
  if (report.tracker)
    rows.push_back({"read cameras and solve", "solve_ms", spread_over(all, ms(Part::solve))});
  rows.push_back({"draw all tiles", "draw_ms", spread_over(all, ms(Part::draw))});
  rows.push_back({"present", "present_ms", spread_over(all, ms(Part::swap))});
  if (!all.empty() && all.front().parts[Part::display] > Duration{})
    rows.push_back({"display", "display_ms", spread_over(all, ms(Part::display))});
  if (!seen.empty())
    rows.push_back({"report to photon, sum", "report_to_photon_ms",
                    spread_over(seen, [](const FrameRecord& frame) {
                      return milliseconds(frame.parts.motion_to_photon());
                    })});
  return rows;
}

/// Eye that was drawn against the true one, when the frame's light leaves the wall, and when it was
/// captured.
std::vector<Row> error_rows(const RunReport& report) {
  std::vector<FrameRecord> seen;
  std::ranges::copy_if(report.loop.frames, std::back_inserter(seen),
                       &FrameRecord::shows_the_tracked_eye);
  if (!report.truth || seen.empty()) return {};
  const auto at_photon = spread_over(seen, [&](const FrameRecord& frame) {
    const Person& person = followed_person(*report.truth, frame);
    return 1e3 * (frame.state.eye_in_wall - person.eye_in_wall(frame.state.photon_time)).norm();
  });
  return {{"eye error when the light leaves", "eye_error_mm", at_photon}};
}

int black_frames(const RunReport& report) {
  return static_cast<int>(std::ranges::count_if(
      report.loop.frames, [](const auto& frame) { return frame.black_tiles > 0; }));
}

std::ptrdiff_t led_frames(const RunReport& report) {
  return std::ranges::count(report.loop.frames, false, &FrameRecord::shows_the_tracked_eye);
}

std::string row_text(const Row& row, const char* unit) {
  return fmt::format("  {:<34}{:>9.2f}{:>9.2f}{:>9.2f}  {}\n", row.name, row.spread.mean,
                     row.spread.p95, row.spread.largest, unit);
}

/// What a tracker found, and why not, as members of a JSON object.
std::string tracking_json(const TrackerCounts& counts) {
  std::string levels, reasons;
  for (std::size_t level = 0; level < counts.frames_by_level.size(); ++level)
    levels +=
        fmt::format("{}\"{}\": {}", level ? ", " : "", name_of(static_cast<TrackingLevel>(level)),
                    counts.frames_by_level[level]);
  for (std::size_t reason = 0; reason < kNoPoseReasons; ++reason)
    reasons += fmt::format("{}\"{}\": {}", reason ? ", " : "", name_of(static_cast<NoPose>(reason)),
                           counts.frames_lost_by_reason[reason]);
  return fmt::format(
      ", \"reports\": {}, \"frames_tracked\": {}, \"frames_lost\": {}, \"frames_by_level\": "
      "{{{}}}, \"frames_lost_by_reason\": {{{}}}",
      counts.reports, counts.frames_tracked(), counts.frames_lost(), levels, reasons);
}

std::string cameras_json(const std::vector<CameraState>& cameras) {
  std::string text;
  for (const CameraState& camera : cameras) {
    text += fmt::format("{}{{\"name\": {}, \"trouble\": {}, \"gaps\": {}}}",
                        text.empty() ? "" : ", ", json_text(camera.name), json_text(camera.trouble),
                        json_of(camera.gaps.value_or(GapCounts{})));
  }
  return text;
}

std::string tracking_text(const RunReport& report) {
  if (!report.tracker) return "";
  const TrackerCounts& counts = report.tracker->counts();
  const double frames = static_cast<double>(std::max<std::uint64_t>(counts.frames, 1));
  std::string text = fmt::format(
      "  {:<34}{} of {} frames ({:.1f} %), {} reports\n", "head found", counts.frames_tracked(),
      counts.frames, 100 * static_cast<double>(counts.frames_tracked()) / frames, counts.reports);
  for (std::size_t level = 0; level < counts.frames_by_level.size(); ++level)
    if (counts.frames_by_level[level])
      text += fmt::format("  {:<34}{} frames\n",
                          fmt::format("  {}", name_of(static_cast<TrackingLevel>(level))),
                          counts.frames_by_level[level]);
  for (std::size_t reason = 0; reason < kNoPoseReasons; ++reason)
    if (counts.frames_lost_by_reason[reason])
      text += fmt::format("  {:<34}{} frames\n",
                          fmt::format("  lost: {}", name_of(static_cast<NoPose>(reason))),
                          counts.frames_lost_by_reason[reason]);
  return text;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const auto p95 =
      static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1;
  return {sum / static_cast<double>(values.size()), values[p95], values.back()};
}

std::string table_of(const RunReport& report) {
  const LoopResult& loop = report.loop;
  const double length_s = std::max(seconds(loop.length), 1e-9);
  std::string text = fmt::format(
      "\n{} frames in {:.1f} s: {:.1f} a second, {} ticks missed{}; wall drawn at {}x{} ({:.3g} of "
      "full size)\non {}\n\n",
      loop.frames.size(), length_s, static_cast<double>(loop.frames.size()) / length_s,
      loop.ticks_missed, loop.ticks_at_rest ? fmt::format(", {} at rest", loop.ticks_at_rest) : "",
      report.wall_px.width, report.wall_px.height, report.scale, report.gl);
  text += fmt::format("  {:<34}{:>9}{:>9}{:>9}\n", "", "mean", "p95", "max");
  for (const Row& row : latency_rows(report)) text += row_text(row, "ms");
  for (const Row& row : error_rows(report)) text += row_text(row, "mm");
  text += tracking_text(report);
  for (const CameraState& camera : report.cameras) {
    if (camera.gaps)
      text += fmt::format("  {:<34}{}\n", "gaps of camera " + camera.name, text_of(*camera.gaps));
    if (!camera.trouble.empty())
      text += fmt::format("  {:<34}{}\n", "camera " + camera.name, camera.trouble);
  }
  if (report.tracker)
    text += fmt::format("  {:<34}{} drawn frames\n", "eye held or led back in", led_frames(report));
  if (const int black = black_frames(report))
    text += fmt::format("  {:<34}{} drawn frames: the eye was behind a tile's plane\n",
                        "black tiles in", black);
  return text;
}

const Person& followed_person(const EmulatedRoom& room, const FrameRecord& frame) {
  const auto head = static_cast<std::size_t>(frame.pose ? frame.pose->object : 0);
  return room.person(std::min(head, room.people() - 1));
}

std::string json_of(const RunReport& report) {
  std::string rows;
  auto all = latency_rows(report);
  std::ranges::copy(error_rows(report), std::back_inserter(all));
  for (const Row& row : all)
    rows += fmt::format(", \"{}\": {{\"mean\": {:.4f}, \"p95\": {:.4f}, \"max\": {:.4f}}}", row.key,
                        row.spread.mean, row.spread.p95, row.spread.largest);
  if (report.tracker)
    rows += tracking_json(report.tracker->counts()) +
            fmt::format(", \"frames_with_eye_held\": {}", led_frames(report));
  if (!report.cameras.empty()) rows += ", \"cameras\": [" + cameras_json(report.cameras) + "]";
  return fmt::format(
      "{{\"frames\": {}, \"seconds\": {:.3f}, \"ticks_missed\": {}, \"ticks_at_rest\": {}, "
      "\"frames_with_black_tiles\": {}, \"scale\": {:.4f}, \"width_px\": {}, \"height_px\": {}, "
      "\"gl\": {}{}}}\n",
      report.loop.frames.size(), seconds(report.loop.length), report.loop.ticks_missed,
      report.loop.ticks_at_rest, black_frames(report), report.scale, report.wall_px.width,
      report.wall_px.height, json_text(report.gl), rows);
}

}  // namespace vindu::app
