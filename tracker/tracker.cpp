#include "tracker/tracker.h"

#include <numeric>

#include "core/error.h"

namespace vindu {
namespace {

ThesisMethod method_named(const TrackerOptions& options, std::span<const CameraConfig> cameras,
                          const HeadConfig& head) {
  if (options.method != "thesis")
    throw Error(
        {"there is no tracking method \"" + options.method + "\"", "--method", "use \"thesis\""});
  return ThesisMethod(cameras, head);
}

}  // namespace

std::uint64_t TrackerCounts::frames_lost() const {
  return std::accumulate(frames_lost_by_reason.begin(), frames_lost_by_reason.end(),
                         std::uint64_t{0});
}

Tracker::Tracker(std::span<const CameraConfig> cameras, const HeadConfig& head,
                 const Rigid3& room_from_wall, const TrackerOptions& options)
    : method_(method_named(options, cameras, head)),
      eye_in_head_(head.eye_in_head),
      wall_from_room_(inverse(room_from_wall)) {}

void Tracker::absorb(const Observation& observation) {
  ++counts_.reports;
  method_.absorb(observation);
}

std::optional<PoseSample> Tracker::track(Time now) {
  ThesisResult result = method_.track(now);
  points_ = std::move(result.points);
  if (result.pose) {
    ++counts_.frames_tracked;
    last_ = result.pose;
    return last_;
  }
  ++counts_.frames_lost_by_reason[static_cast<std::size_t>(result.reason)];
  if (last_)
    last_->level =
        now - last_->capture_time > kPoseHeldFor ? TrackingLevel::lost : TrackingLevel::held;
  return last_;
}

Vec3 Tracker::eye_in_wall(const PoseSample& pose) const {
  return wall_from_room_ * (pose.room_from_head * eye_in_head_);
}

}  // namespace vindu
