// The eye as a tracker elsewhere on the bus sees it; this machine's own cameras in reserve.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/eye_source.h"
#include "cluster/bus.h"
#include "cluster/clock_offset.h"
#include "core/pose_history.h"

namespace vindu::app {

/// Takes the topic pose, to which the bus must be subscribed; both must outlive this.
class RemoteEye final : public EyeSource {
 public:
  /// `own`: asked while no tracker is heard; empty: the eye is held and led to the default
  /// viewpoint.
  RemoteEye(Bus& bus, const Site& site, std::unique_ptr<EyeSource> own);

  EyeNow at(Time now, Time photon) override;

  /// Whose poses were heard last; empty: no tracker is heard.
  const std::string& tracker() const { return tracker_; }

 private:
  bool follows(const PoseMessage& message) const;
  void hear(const PoseMessage& message, Time now);

  Bus& bus_;
  const Site& site_;
  std::unique_ptr<EyeSource> own_;
  OneWayOffset clock_;
  PoseHistory history_;
  EyeEase ease_;
  std::optional<Time> heard_;
  std::string tracker_;
  std::uint32_t strength_ = 0;
  Duration capture_delay_{};  // from the capture of the newest pose to its time
};

}  // namespace vindu::app
