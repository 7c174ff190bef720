#include "app/pose_lines.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/buttons.h"
#include "app/common.h"
#include "app/replay_json.h"

namespace vindu::app {
namespace {

std::string json_of(const GestureEvent& event, Duration shift) {
  const std::string target =
      event.target.empty() ? "" : fmt::format(R"(,"target":{})", json_text(event.target));
  return fmt::format(R"({{"t_ns":{},"object":{},"event":"{}"{},"confidence":{:.3f}}})",
                     nanoseconds(event.time + shift), event.object, name_of(event.gesture), target,
                     event.confidence);
}

std::string json_of(const ButtonChange& change, const Site& site, Duration shift) {
  return fmt::format(R"({{"t_ns":{},"camera":{},"button":"{}","pressed":{}}})",
                     nanoseconds(change.arrival + shift),
                     json_text(site.cameras[static_cast<std::size_t>(change.camera)].name),
                     text_of(Buttons{change.button}), change.pressed);
}

/// The whole number next to it, unless that of before is nearly as near.
double steadily_rounded(double value, double before) {
  return std::abs(value - before) < 0.75 ? before : std::round(value);
}

}  // namespace

PoseLines::PoseLines(const Site& site, std::vector<LookTarget> targets)
    : site_(site), gestures_(site, std::move(targets)) {}

std::vector<std::string> PoseLines::news(const Tracker& tracker,
                                         const std::optional<PoseSample>& followed, Time now,
                                         Duration shift) {
  std::vector<std::string> lines;
  add_poses(tracker, followed, shift, lines);
  add_misfit(tracker, now, shift, lines);
  add_health(tracker, now, shift, lines);
  events_ = gestures_.news(tracker);
  for (const GestureEvent& event : events_) lines.push_back(json_of(event, shift));
  for (const ButtonChange& change : tracker.button_changes())
    lines.push_back(json_of(change, site_, shift));
  return lines;
}

void PoseLines::add_poses(const Tracker& tracker, const std::optional<PoseSample>& followed,
                          Duration shift, std::vector<std::string>& lines) {
  for (const PoseSample& pose : tracker.poses()) {
    const auto said = said_.find(pose.object);
    const bool news = said == said_.end() || said->second.capture_time != pose.capture_time ||
                      said->second.level != pose.level;
    if (!news) continue;
    said_.insert_or_assign(pose.object, pose);
    const bool shown = followed && followed->object == pose.object;
    lines.push_back(app::json_of(pose, tracker.eye_in_wall(pose), shown, shift));
  }
}

void PoseLines::add_misfit(const Tracker& tracker, Time now, Duration shift,
                           std::vector<std::string>& lines) {
  const Misfit misfit{std::lround(tracker.disagreement_px()),
                      std::lround(200 * tracker.heads_look_larger())};
  if (std::exchange(misfit_, misfit) != misfit)
    lines.push_back(fmt::format(R"({{"t_ns":{},"disagreement_px":{},"heads_look_larger":{:.3f}}})",
                                nanoseconds(now + shift), misfit.disagreement_px,
                                0.005 * static_cast<double>(misfit.half_percents)));
}

void PoseLines::add_health(const Tracker& tracker, Time now, Duration shift,
                           std::vector<std::string>& lines) {
  auto cameras = tracker.camera_health();
  cameras.resize(site_.cameras.size());  // the thesis' method knows nothing of them
  health_.resize(cameras.size());
  const auto heard = tracker.heard(now);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraHealth& camera = cameras[i];
    const double before_px = health_[i] ? health_[i]->aside_px : 0;
    const Health health{heard[i], camera.moved, camera.device_time, camera.masks,
                        steadily_rounded(camera.aside_px, before_px)};
    if (std::exchange(health_[i], health) == health) continue;
    lines.push_back(
        fmt::format(R"({{"t_ns":{},"camera":{},"heard":{},"moved":{},"device_time":{},"masks":{},)"
                    R"("aside_px":{}}})",
                    nanoseconds(now + shift), json_text(site_.cameras[i].name), health.heard,
                    health.moved, health.device_time, health.masks, health.aside_px));
  }
}

}  // namespace vindu::app
