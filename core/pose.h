// A tracked head: pose, motion, uncertainty, and how well it is known.
#pragma once

#include <string_view>

#include "core/clock.h"
#include "core/rigid3.h"

namespace vindu {

/// From best to worst; the thesis' three modes are the first three.
enum class TrackingLevel { six_dof, hybrid, position, bearing, held, lost };

constexpr std::string_view name_of(TrackingLevel level) {
  constexpr std::string_view names[] = {"six-dof", "hybrid", "position", "bearing", "held", "lost"};
  return names[static_cast<int>(level)];
}

using Mat6 = Eigen::Matrix<double, 6, 6>;

struct PoseSample {
  int object = 0;
  Time time{};          ///< that the pose is for
  Time capture_time{};  ///< of the newest dot that it rests on
  TrackingLevel level = TrackingLevel::lost;
  Rigid3 room_from_head;
  Vec3 velocity_in_room_m_s = Vec3::Zero();
  Vec3 angular_velocity_in_room_rad_s = Vec3::Zero();
  Mat6 covariance =
      Mat6::Zero();  ///< position (m), then rotation (rad), both in room; zero: not known
};

/// Constant velocity over `ahead`, which may be negative.
PoseSample extrapolate(const PoseSample& sample, Duration ahead);

}  // namespace vindu
