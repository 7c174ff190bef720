#include "app/pose_lines.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "app/common.h"
#include "app/replay_json.h"

namespace vindu::app {
namespace {

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Empty for a text that is none.
std::optional<LookTarget> target_from(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t comma; (comma = text.find(',', begin)) != std::string::npos; begin = comma + 1)
    parts.push_back(text.substr(begin, comma - begin));
  parts.push_back(text.substr(begin));
  if (parts.size() != 5 || parts[0].empty()) return std::nullopt;
  std::array<double, 4> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = number(parts[i + 1]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  if (!(values[3] > 0)) return std::nullopt;
  return LookTarget{parts[0], {values[0], values[1], values[2]}, values[3]};
}

}  // namespace

void add_targets(CLI::App& app, std::vector<std::string>& texts) {
  app.add_option("--target", texts,
                 "NAME,x,y,z,radius: a thing in wall, in metres; that somebody looks at it is told")
      ->type_name("TARGET")
      ->allow_extra_args(false)
      ->check([](const std::string& text) -> std::string {
        if (target_from(text)) return "";
        return "\"" + text + "\" is no target; write NAME,x,y,z,radius in metres in wall, as in " +
               "globe,0.5,0.2,-1,0.3";
      });
}

std::vector<LookTarget> targets_from(const std::vector<std::string>& texts) {
  std::vector<LookTarget> targets;
  for (const std::string& text : texts) targets.push_back(target_from(text).value());
  return targets;
}

PoseLines::PoseLines(const Site& site, std::vector<LookTarget> targets)
    : site_(site), targets_(std::move(targets)) {}

std::vector<std::string> PoseLines::news(const Tracker& tracker, Duration shift) {
  std::vector<std::string> lines;
  events_.clear();
  for (const PoseSample& pose : tracker.poses()) {
    const auto said = said_.find(pose.object);
    const bool news = said == said_.end() || said->second.capture_time != pose.capture_time ||
                      said->second.level != pose.level;
    if (!news) continue;
    said_.insert_or_assign(pose.object, pose);
    lines.push_back(json_of(pose, tracker.eye_in_wall(pose), shift));
    add_events(pose, shift, lines);
    add_health(tracker, pose.time, shift, lines);
  }
  return lines;
}

void PoseLines::add_events(const PoseSample& pose, Duration shift,
                           std::vector<std::string>& lines) {
  const HeadConfig& head = site_.heads[static_cast<std::size_t>(pose.object)];
  auto& detector =
      detectors_.try_emplace(pose.object, head.eye_in_head, site_.wall.room_from_wall, targets_)
          .first->second;
  const auto event = detector.absorb(pose);
  if (!event) return;
  events_.push_back(*event);
  const std::string target =
      event->target.empty() ? "" : fmt::format(R"(,"target":{})", json_text(event->target));
  lines.push_back(fmt::format(R"({{"t_ns":{},"object":{},"event":"{}"{},"confidence":{:.3f}}})",
                              nanoseconds(event->time + shift), event->object,
                              name_of(event->gesture), target, event->confidence));
}

void PoseLines::add_health(const Tracker& tracker, Time time, Duration shift,
                           std::vector<std::string>& lines) {
  const auto health = tracker.camera_health();
  if (health == health_) return;
  health_.resize(health.size());
  for (std::size_t i = 0; i < health.size(); ++i)
    if (health[i] != health_[i])
      lines.push_back(
          fmt::format(R"({{"t_ns":{},"camera":{},"moved":{},"device_time":{},"masks":{}}})",
                      nanoseconds(time + shift), json_text(site_.cameras[i].name), health[i].moved,
                      health[i].device_time, health[i].masks));
  health_ = health;
}

}  // namespace vindu::app
