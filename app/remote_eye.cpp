#include "app/remote_eye.h"

#include "core/log.h"

namespace vindu::app {
namespace {

/// The lease of a tracker on its poses is 200 ms; then another one, or this machine, is asked.
constexpr Duration kHeardFor = std::chrono::milliseconds(250);

}  // namespace

RemoteEye::RemoteEye(Bus& bus, const Site& site, std::unique_ptr<EyeSource> own)
    : bus_(bus), site_(site), own_(std::move(own)), ease_(site.viewer.default_eye_in_wall) {}

/// One at a time: of two trackers that see different heads the bus lets both be heard.
bool RemoteEye::follows(const PoseMessage& message) const {
  return !heard_ || message.tracker == tracker_ || message.strength > strength_;
}

void RemoteEye::hear(const PoseMessage& message, Time now) {
  if (!message.followed || !follows(message)) return;
  if (message.tracker != tracker_) {
    log_info("master", "poses come from " + message.tracker);
    clock_ = {};
  }
  clock_.add(message.sent_time, now);
  PoseSample pose = message.pose;
  capture_delay_ = pose.time - pose.capture_time;
  pose.time = *clock_.here(pose.time);
  pose.capture_time = pose.time;  // by which the history is in order
  history_.add(pose);
  tracker_ = message.tracker;
  strength_ = message.strength;
  heard_ = now;
}

EyeNow RemoteEye::at(Time now, Time photon) {
  const bool silent = heard_ && now - *heard_ > kHeardFor;
  if (silent) heard_.reset();
  for (const PoseMessage& message : bus_.take<PoseMessage>()) hear(message, now);
  if (silent && !heard_) {
    log_warning("master", own_ ? "no tracker is heard any more: its own cameras are asked"
                               : "no tracker is heard any more");
    tracker_.clear();
  }
  if (!heard_ && own_) return own_->at(now, photon);
  EyeNow eye{.eye_in_wall = Vec3::Zero(), .mode = Mode::track};
  std::optional<Vec3> seen_in_wall;
  if (const auto pose = heard_ ? history_.at(photon) : std::nullopt) {
    eye.pose = pose->sample;
    eye.pose->capture_time -= capture_delay_;
    eye.tracked = true;
    const HeadConfig& head =
        site_.heads[static_cast<std::size_t>(eye.pose->object) % site_.heads.size()];
    seen_in_wall =
        inverse(site_.wall.room_from_wall) * (eye.pose->room_from_head * head.eye_in_head);
  }
  eye.eye_in_wall = ease_.update(seen_in_wall, now);
  return eye;
}

}  // namespace vindu::app
