#include "app/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "core/parallel.h"

namespace vindu::app {
namespace {

HeadConfig head_of(int leds) { return leds == 3 ? HeadConfig{} : four_led_head(); }

std::size_t leds_of(const HeadConfig& head) { return head.leds_in_head.size(); }

std::vector<FrameRow> frame_rows(const AccuracyOptions& options) {
  const auto distances = options.quick ? std::vector{3.0} : std::vector{2.0, 3.0, 4.0, 5.0};
  const auto baselines = options.quick ? std::vector{2.0} : std::vector{1.0, 2.0, 3.0};
  std::vector<FrameRow> rows;
  const auto add = [&](const CameraRow& row, int leds, std::optional<int> dots_of_last) {
    rows.push_back({{.row = row,
                     .head = head_of(leds),
                     .poses = options.poses,
                     .seed = options.seed,
                     .dots_of_last = dots_of_last},
                    {}});
  };
  for (const int cameras : {2, 4})
    for (const int leds : {3, 4})
      for (const double distance_m : distances)
        for (const double baseline_m : baselines)
          add({distance_m, baseline_m, cameras}, leds, std::nullopt);
  for (const int leds : {3, 4})
    for (int dots = 0; dots < leds; ++dots) add({}, leds, dots);
  return rows;
}

std::vector<MovingRow> moving_rows(const AccuracyOptions& options) {
  std::vector<MovingRow> rows;
  const auto add = [&](HeadMoves moves, double peak_m_s, Link link, int lag_ms, int cameras) {
    for (const int leds : {3, 4})
      rows.push_back({{.moves = moves,
                       .peak_m_s = peak_m_s,
                       .link = link,
                       .photon_lag = std::chrono::milliseconds(lag_ms),
                       .row = {.cameras = cameras},
                       .head = head_of(leds),
                       .length_s = options.length_s,
                       .seed = options.seed},
                      {},
                      {}});
  };
  const auto all_motions = [&](Link link, int lag_ms, int cameras) {
    add(HeadMoves::still, 0, link, lag_ms, cameras);
    for (const double peak_m_s : {0.57, 1.13})
      for (const auto moves : {HeadMoves::sways, HeadMoves::walks, HeadMoves::starts_and_stops})
        if (!options.quick || (moves == HeadMoves::sways && peak_m_s < 1))
          add(moves, peak_m_s, link, lag_ms, cameras);
  };
  all_motions(Link::bursts, 30, 2);
  if (options.quick) return rows;
  for (const Link link : {Link::good, Link::loss, Link::false_dots}) all_motions(link, 30, 2);
  all_motions(Link::bursts, 50, 2);
  all_motions(Link::bursts, 30, 4);
  return rows;
}

/// Does all tasks, the last ones first: they take longest.
void run_all(const std::vector<std::function<void()>>& tasks,
             const std::function<void(double)>& progress) {
  std::mutex mutex;
  std::size_t done = 0;
  for_each_in_parallel(tasks.size(), [&](std::size_t i) {
    tasks[tasks.size() - 1 - i]();
    const std::lock_guard lock(mutex);
    progress(static_cast<double>(++done) / static_cast<double>(tasks.size()));
  });
}

/// What the thesis' method did with its own helmet before two cameras.
void lend_thesis(Accuracy& accuracy) {
  for (MovingRow& row : accuracy.moving) {
    const MovingStudyOptions& options = row.options;
    const auto own = std::ranges::find_if(accuracy.moving, [&](const MovingRow& other) {
      return other.study.thesis && other.options.moves == options.moves &&
             other.options.peak_m_s == options.peak_m_s && other.options.link == options.link &&
             other.options.photon_lag == options.photon_lag;
    });
    if (own != accuracy.moving.end()) row.thesis = own->study.thesis;
  }
}

/// The largest value of the rows that have one; nothing when none has.
template <class Row, class Value>
void add_target(std::vector<AccuracyTarget>& targets, const std::string& what, double limit,
                const std::vector<Row>& rows, Value value) {
  AccuracyTarget target{.what = what, .limit = limit};
  for (const Row& row : rows) {
    const std::optional<double> of_row = value(row);
    if (!of_row || (!target.where.empty() && *of_row <= target.worst)) continue;
    target.worst = *of_row;
    target.where = name_of(row);
  }
  if (!target.where.empty()) targets.push_back(target);
}

/// At the speed and lag that the targets are set for; two cameras.
bool is_usual(const MovingRow& row, Link link) {
  return row.options.peak_m_s == 0.57 && row.options.photon_lag == std::chrono::milliseconds(30) &&
         row.options.link == link && row.options.row.cameras == 2;
}

}  // namespace

std::optional<double> MovingRow::over_thesis() const {
  if (!thesis || thesis->six_dof.found == 0) return std::nullopt;
  return study.joint.eye_rms_m / thesis->six_dof.eye_rms_m;
}

Accuracy measure_accuracy(const AccuracyOptions& options,
                          const std::function<void(double)>& progress) {
  Accuracy accuracy{frame_rows(options), moving_rows(options)};
  std::vector<std::function<void()>> tasks;
  for (FrameRow& row : accuracy.frames)
    tasks.emplace_back([&row] { row.study = study_frames(row.options); });
  for (MovingRow& row : accuracy.moving)
    tasks.emplace_back([&row] { row.study = study_moving(row.options); });
  run_all(tasks, progress);
  lend_thesis(accuracy);
  return accuracy;
}

std::vector<AccuracyTarget> targets_of(const Accuracy& accuracy) {
  using Ratio = std::optional<double>;
  std::vector<AccuracyTarget> targets;
  add_target(targets, "single frame: over the bound", 1.15, accuracy.frames,
             [](const FrameRow& row) -> Ratio {
               if (row.options.dots_of_last) return std::nullopt;
               return row.over_bound();
             });
  add_target(targets, "single frame, l-m-r helmet, base 2 m, 2 cameras: over thesis", 0.6,
             accuracy.frames, [](const FrameRow& row) -> Ratio {
               if (leds_of(row.options.head) != 3 || row.options.row.cameras != 2 ||
                   row.options.row.baseline_m != 2 || row.options.dots_of_last)
                 return std::nullopt;
               return row.study.joint_over_thesis;
             });
  add_target(targets, "still, 2 cameras, 4 LEDs: mm", 1.5, accuracy.moving,
             [](const MovingRow& row) -> Ratio {
               if (row.options.moves != HeadMoves::still || leds_of(row.options.head) != 4 ||
                   row.options.row.cameras != 2 || row.options.link != Link::bursts)
                 return std::nullopt;
               return 1e3 * row.study.joint.eye_rms_m;
             });
  add_target(targets, "0.57 m/s, 30 ms, bursts: over the best fixed noise", 1.2, accuracy.moving,
             [](const MovingRow& row) -> Ratio {
               if (!is_usual(row, Link::bursts)) return std::nullopt;
               return row.over_fixed();
             });
  for (const auto& [link, limit] : {std::pair(Link::bursts, 0.2), std::pair(Link::loss, 0.25)})
    for (const auto moves : {HeadMoves::sways, HeadMoves::walks, HeadMoves::starts_and_stops})
      add_target(targets,
                 fmt::format("{} 0.57 m/s, 30 ms, {}: over thesis", vindu::name_of(moves),
                             vindu::name_of(link)),
                 limit, accuracy.moving, [&, link = link](const MovingRow& row) -> Ratio {
                   if (!is_usual(row, link) || row.options.moves != moves) return std::nullopt;
                   return row.over_thesis();
                 });
  return targets;
}

std::string name_of(const FrameRow& row) {
  const auto& [distance_m, baseline_m, cameras] = row.options.row;
  return fmt::format(
      "{:g} m, base {:g} m, {} cameras, {} LEDs{}", distance_m, baseline_m, cameras,
      leds_of(row.options.head),
      row.options.dots_of_last ? fmt::format(", {} in camera 2", *row.options.dots_of_last) : "");
}

std::string name_of(const MovingRow& row) {
  const MovingStudyOptions& options = row.options;
  const std::string speed =
      options.peak_m_s > 0 ? fmt::format(" {:.2f} m/s", options.peak_m_s) : "";
  return fmt::format("{}{}, {}, {:g} ms, {} cameras, {} LEDs", vindu::name_of(options.moves), speed,
                     vindu::name_of(options.link), vindu::milliseconds(options.photon_lag),
                     options.row.cameras, leds_of(options.head));
}

}  // namespace vindu::app
