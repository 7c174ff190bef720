#include "core/pose_history.h"

#include <algorithm>

namespace vindu {
namespace {

PoseAt between(const PoseSample& before, const PoseSample& after, Time time) {
  const double fraction =
      seconds(time - before.capture_time) / seconds(after.capture_time - before.capture_time);
  PoseSample sample = fraction < 0.5 ? before : after;
  sample.capture_time = after.capture_time;
  sample.level = std::max(before.level, after.level);
  sample.room_from_head = interpolate(before.room_from_head, after.room_from_head, fraction);
  return {sample, PoseAnswer::interpolated};
}

}  // namespace

PoseSample extrapolate(const PoseSample& sample, Duration ahead) {
  const double ahead_s = seconds(ahead);
  PoseSample moved = sample;
  moved.room_from_head.translation += ahead_s * sample.velocity_in_room_m_s;
  const Vec3 turn_rad = ahead_s * sample.angular_velocity_in_room_rad_s;
  const double angle_rad = turn_rad.norm();
  if (angle_rad > 0)
    moved.room_from_head.rotation =
        Quat(Eigen::AngleAxisd(angle_rad, turn_rad / angle_rad)) * sample.room_from_head.rotation;
  return moved;
}

void PoseHistory::add(const PoseSample& sample) {
  const std::scoped_lock lock(mutex_);
  const auto after =
      std::ranges::upper_bound(samples_, sample.capture_time, {}, &PoseSample::capture_time);
  if (after != samples_.begin() && std::prev(after)->capture_time == sample.capture_time)
    *std::prev(after) = sample;
  else
    samples_.insert(after, sample);
  while (samples_.back().capture_time - samples_.front().capture_time > options_.kept)
    samples_.pop_front();
}

std::optional<PoseAt> PoseHistory::at(Time time) const {
  const std::scoped_lock lock(mutex_);
  if (samples_.empty()) return std::nullopt;
  const auto after = std::ranges::lower_bound(samples_, time, {}, &PoseSample::capture_time);
  if (after != samples_.end() && after->capture_time == time)
    return PoseAt{*after, PoseAnswer::exact};
  if (after == samples_.begin()) return PoseAt{*after, PoseAnswer::stale};
  if (after != samples_.end()) return between(*std::prev(after), *after, time);
  const PoseSample& newest = samples_.back();
  const Duration ahead = time - newest.capture_time;
  if (ahead > options_.prediction_limit) return PoseAt{newest, PoseAnswer::stale};
  return PoseAt{extrapolate(newest, ahead), PoseAnswer::predicted};
}

}  // namespace vindu
