#include "app/still_eye.h"

namespace vindu::app {

Vec3 StillEye::at(const EyeNow& eye, std::span<const Vec3> corners_in_wall, Time now) {
  const double slack_m = eye_slack_m(site_.wall, eye.eye_in_wall, corners_in_wall);
  double sigma_m = 0;
  if (eye.pose && !site_.heads.empty()) {
    const auto head = static_cast<std::size_t>(eye.pose->object) % site_.heads.size();
    sigma_m = eye_sigma_m(*eye.pose, site_.heads[head].eye_in_head);
  }
  return rest_.update(eye.eye_in_wall, slack_m, sigma_m, now);
}

}  // namespace vindu::app
