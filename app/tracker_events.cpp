#include "app/tracker_events.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "app/buttons.h"

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

CLI::Option* add_targets(CLI::App& app, std::vector<std::string>& texts) {
  return app
      .add_option(
          "--target", texts,
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

HeadGestures::HeadGestures(const Site& site, std::vector<LookTarget> targets)
    : site_(site), targets_(std::move(targets)) {}

std::vector<GestureEvent> HeadGestures::news(const Tracker& tracker) {
  std::vector<GestureEvent> events;
  for (const PoseSample& pose : tracker.poses()) {
    const HeadConfig& head = site_.heads[static_cast<std::size_t>(pose.object)];
    GestureDetector& detector =
        detectors_.try_emplace(pose.object, head.eye_in_head, site_.wall.room_from_wall, targets_)
            .first->second;
    if (const auto event = detector.absorb(pose)) events.push_back(*event);
  }
  return events;
}

EventMessage message_of(const GestureEvent& event, const std::string& host) {
  const bool pick = event.gesture == Gesture::look;
  return {.source = host + "/track",
          .kind = pick ? EventKind::pick : EventKind::gesture,
          .id = event.object,
          .value = event.confidence,
          .text = pick ? event.target : std::string(name_of(event.gesture))};
}

EventMessage message_of(const ButtonChange& change, const Site& site, const std::string& host) {
  return {.source = host + "/" + site.cameras[static_cast<std::size_t>(change.camera)].name,
          .kind = EventKind::key,
          .phase = change.pressed ? EventPhase::begin : EventPhase::end,
          .id = change.button,
          .text = text_of(Buttons{change.button})};
}

}  // namespace vindu::app
