#include "tracker/tracker.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace vindu {
namespace {

constexpr std::uint16_t kHome = 0x0080;

bool tracked(const PoseSample& pose) { return pose.level < TrackingLevel::held; }

ThesisMode thesis_mode(const std::string& mode) {
  return mode == "six-dof"    ? ThesisMode::six_dof
         : mode == "hybrid"   ? ThesisMode::hybrid
         : mode == "position" ? ThesisMode::position
                              : ThesisMode::automatic;
}

std::variant<ThesisMethod, JointMethod> method_named(const TrackingConfig& config,
                                                     std::span<const CameraConfig> cameras,
                                                     std::span<const HeadConfig> heads) {
  if (config.method == "thesis")
    return ThesisMethod(cameras, heads.front(), {.mode = thesis_mode(config.mode)});
  if (config.method == "joint")
    return JointMethod(cameras, heads, {.position_only = config.mode == "position"});
  throw Error({"there is no tracking method \"" + config.method + "\"", "--method",
               "use \"joint\" or \"thesis\""});
}

/// What a forced mode refuses.
TrackingLevel worst_allowed(const std::string& mode) {
  return mode == "six-dof"  ? TrackingLevel::six_dof
         : mode == "hybrid" ? TrackingLevel::hybrid
                            : TrackingLevel::bearing;
}

}  // namespace

std::uint64_t TrackerCounts::frames_tracked() const {
  const auto held = frames_by_level.begin() + static_cast<int>(TrackingLevel::held);
  return std::accumulate(frames_by_level.begin(), held, std::uint64_t{0});
}

Tracker::Tracker(std::span<const CameraConfig> cameras, std::span<const HeadConfig> heads,
                 const Rigid3& room_from_wall, const TrackingConfig& config)
    : config_(config),
      heads_(heads.begin(), heads.end()),
      wall_from_room_(inverse(room_from_wall)),
      buttons_(cameras.size(), 0),
      reported_(cameras.size()),
      method_(method_named(config, cameras, heads)) {}

void Tracker::absorb(const Observation& observation) {
  ++counts_.reports;
  reported_[static_cast<std::size_t>(observation.camera)] = observation.arrival;
  note_buttons(observation);
  std::visit([&](auto& method) { method.absorb(observation); }, method_);
}

void Tracker::note_buttons(const Observation& observation) {
  std::uint16_t& before = buttons_[static_cast<std::size_t>(observation.camera)];
  for (int bit = 0; bit < 16; ++bit) {
    const auto button = static_cast<std::uint16_t>(1 << bit);
    if (!((observation.buttons ^ before) & button)) continue;
    const bool pressed = observation.buttons & button;
    coming_changes_.push_back({observation.camera, button, pressed, observation.arrival});
    if (pressed && button == kHome) hand_over();
  }
  before = observation.buttons;
}

void Tracker::track_by_thesis(Time now) {
  ThesisResult result = std::get<ThesisMethod>(method_).track(now);
  points_ = std::move(result.points);
  if (result.pose) {
    poses_ = {*result.pose};
    return;
  }
  ++counts_.frames_lost_by_reason[static_cast<std::size_t>(result.reason)];
  for (PoseSample& pose : poses_)
    pose.level = now - pose.capture_time > kPoseHeldFor ? TrackingLevel::lost : TrackingLevel::held;
}

void Tracker::track_all(Time now, Time photon) {
  auto& joint = std::get<JointMethod>(method_);
  joint.update(now);
  poses_.clear();
  for (std::size_t head = 0; head < heads_.size(); ++head)
    if (auto pose = joint.pose(head, photon)) {
      apply_mode(*pose);
      poses_.push_back(*pose);
    }
}

void Tracker::apply_mode(PoseSample& pose) const {
  if (tracked(pose) && pose.level > worst_allowed(config_.mode)) pose.level = TrackingLevel::held;
}

double Tracker::distance_to_wall_m(const PoseSample& pose) const {
  return std::abs(eye_in_wall(pose).z());
}

// The nearest of those tracked; whoever is followed stays so until another is nearer by a step.
std::optional<PoseSample> Tracker::followed() {
  constexpr double kNearer_m = 0.3;
  if (poses_.empty()) return std::nullopt;
  const auto current = std::ranges::find_if(
      poses_, [&](const PoseSample& pose) { return following_ == pose.object; });
  const bool keeps = current != poses_.end() && tracked(*current);
  auto best = current != poses_.end() ? current : poses_.begin();
  if (config_.follow == "nearest" && !by_hand_) {
    for (auto pose = poses_.begin(); pose != poses_.end(); ++pose)
      if (tracked(*pose) &&
          (!tracked(*best) ||
           distance_to_wall_m(*pose) + (keeps ? kNearer_m : 0) < distance_to_wall_m(*best)))
        best = pose;
  } else if (config_.follow == "first" && !by_hand_) {
    if (!keeps) best = std::ranges::find_if(poses_, tracked);
    if (best == poses_.end()) best = current != poses_.end() ? current : poses_.begin();
  } else if (!by_hand_) {
    best = std::ranges::find_if(poses_, [&](const PoseSample& pose) {
      return heads_[static_cast<std::size_t>(pose.object)].name == config_.follow;
    });
    if (best == poses_.end()) return std::nullopt;
  }
  following_ = best->object;
  return *best;
}

void Tracker::hand_over() {
  for (std::size_t step = 1; step <= heads_.size(); ++step) {
    const int next =
        (following_.value_or(0) + static_cast<int>(step)) % static_cast<int>(heads_.size());
    const auto found = std::ranges::find(poses_, next, &PoseSample::object);
    if (found == poses_.end() || !tracked(*found)) continue;
    following_ = next;
    by_hand_ = true;
    return;
  }
}

std::optional<PoseSample> Tracker::track(Time now, Time photon) {
  button_changes_.swap(coming_changes_);
  coming_changes_.clear();
  if (std::holds_alternative<ThesisMethod>(method_))
    track_by_thesis(now);
  else
    track_all(now, photon);
  auto pose = followed();
  ++counts_.frames;
  ++counts_.frames_by_level[static_cast<std::size_t>(pose ? pose->level : TrackingLevel::lost)];
  return pose;
}

Vec3 Tracker::eye_in_wall(const PoseSample& pose) const {
  const HeadConfig& head = heads_[static_cast<std::size_t>(pose.object)];
  return wall_from_room_ * (pose.room_from_head * head.eye_in_head);
}

std::vector<CameraHealth> Tracker::camera_health() const {
  const auto* joint = std::get_if<JointMethod>(&method_);
  return joint ? joint->health() : std::vector<CameraHealth>{};
}

std::vector<bool> Tracker::heard(Time now) const {
  constexpr Duration kSilent = std::chrono::seconds(1);
  std::vector<bool> heard;
  for (const auto& arrival : reported_) heard.push_back(arrival && now - *arrival < kSilent);
  return heard;
}

double Tracker::disagreement_px() const {
  const auto* joint = std::get_if<JointMethod>(&method_);
  return joint ? joint->disagreement_px() : 0;
}

double Tracker::heads_look_larger() const {
  const auto* joint = std::get_if<JointMethod>(&method_);
  return joint ? joint->heads_look_larger() : 0;
}

bool Tracker::nothing_fits() const {
  const auto* joint = std::get_if<JointMethod>(&method_);
  return joint && joint->nothing_fits();
}

}  // namespace vindu
