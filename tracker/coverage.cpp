#include "tracker/coverage.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "tracker/joint/pose_fit.h"
#include "tracker/joint/rotation.h"

namespace vindu {
namespace {

constexpr std::size_t kMostLeds = 16;

struct SeenDot {
  double distance_m = 0;
  Mat6 information;
};

std::optional<Mat6> inverse_of(const Mat6& information) {
  const Eigen::LLT<Mat6> factor(information);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Mat6 covariance = factor.solve(Mat6::Identity());
  if (!(covariance.diagonal().minCoeff() > 0) || !covariance.allFinite()) return std::nullopt;
  return covariance;
}

PoseBound with_deviations(TrackingLevel level, const Mat6& covariance, const Vec3& towards) {
  PoseBound bound{.level = level};
  const Mat3 eye = covariance.topLeftCorner<3, 3>();
  const Vec3 axis = towards.normalized();
  const double depth2 = axis.dot(eye * axis);
  bound.eye_m = std::sqrt(eye.trace());
  bound.depth_m = std::sqrt(depth2);
  bound.lateral_m = std::sqrt(std::max(0.0, eye.trace() - depth2));
  bound.rotation_rad = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  return bound;
}

}  // namespace

double rounded_noise_px(double sigma0_px) { return std::sqrt(sigma0_px * sigma0_px + 1.0 / 12); }

Sight& Sight::operator+=(const Sight& other) {
  information += other.information;
  dots += other.dots;
  towards += other.towards;
  return *this;
}

Onlooker::Onlooker(const CameraConfig& camera)
    : model_(camera), size_px_(picture_size_px(camera)), most_dots_(most_dots(camera)) {}

// With the pose disturbed as x_led = eye + d_eye + exp(d_rotation) (x_led - eye), a dot moves by
// P C (d_eye - [x_led - eye]x d_rotation): P the projection's derivative, C camera_from_room.
Sight Onlooker::look(const HeadConfig& head, const Rigid3& room_from_head,
                     const DotNoise& noise) const {
  assert(head.leds_in_head.size() <= kMostLeds);
  const Vec3 camera_in_room = model_.room_from_camera().translation;
  const Vec3 camera_in_head = inverse(room_from_head) * camera_in_room;
  const Mat3 camera_from_room = model_.camera_from_room().rotation.toRotationMatrix();
  const Vec3 eye_in_room = room_from_head * head.eye_in_head;
  std::array<SeenDot, kMostLeds> seen;
  std::size_t count = 0;
  for (std::size_t led = 0; led < head.leds_in_head.size(); ++led) {
    const Vec3 led_in_room = room_from_head * head.leds_in_head[led];
    const auto dot = model_.project_with_jacobian(model_.camera_from_room() * led_in_room);
    if (!dot || !((dot->raw_px.array() > -0.5).all() &&
                  (dot->raw_px.array() < size_px_.array() - 0.5).all()))
      continue;
    const auto sigma_px = noise(led, camera_in_head);
    if (!sigma_px) continue;
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>() = dot->d_raw_d_x_in_camera * camera_from_room / *sigma_px;
    jacobian.rightCols<3>() = -jacobian.leftCols<3>() * cross_matrix(led_in_room - eye_in_room);
    seen[count++] = {(led_in_room - camera_in_room).norm(), jacobian.transpose() * jacobian};
  }
  if (count == 0) return {};
  std::sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count),
            [](const SeenDot& a, const SeenDot& b) { return a.distance_m < b.distance_m; });
  count = std::min(count, most_dots_);
  Sight sight{.dots = static_cast<int>(count)};
  sight.towards = (eye_in_room - camera_in_room).normalized();
  for (std::size_t i = 0; i < count; ++i) sight.information += seen[i].information;
  return sight;
}

PoseBound bound_of(const Sight& sight) {
  const TrackingLevel level = level_of(sight.information);
  if (level > TrackingLevel::position) return {.level = level};
  if (level == TrackingLevel::six_dof && sight.dots >= 4) return unaided_bound_of(sight);
  Mat6 information = sight.information;
  information.diagonal().tail<3>().array() +=
      1 / (kRememberedRotation_rad * kRememberedRotation_rad);
  const auto covariance = inverse_of(information);
  return covariance
             ? with_deviations(std::max(level, TrackingLevel::hybrid), *covariance, sight.towards)
             : PoseBound{.level = TrackingLevel::bearing};
}

PoseBound unaided_bound_of(const Sight& sight) {
  const auto covariance = inverse_of(sight.information);
  return covariance ? with_deviations(TrackingLevel::six_dof, *covariance, sight.towards)
                    : PoseBound{};
}

std::vector<PoseBound> survey(std::span<const CameraConfig> cameras, const HeadConfig& head,
                              const DotNoise& noise, std::span<const Rigid3> poses) {
  const std::vector<Onlooker> onlookers(cameras.begin(), cameras.end());
  std::vector<PoseBound> bounds;
  bounds.reserve(poses.size());
  for (const Rigid3& room_from_head : poses) {
    Sight sight;
    for (const Onlooker& onlooker : onlookers) sight += onlooker.look(head, room_from_head, noise);
    bounds.push_back(bound_of(sight));
  }
  return bounds;
}

Rigid3 head_at(const Vec3& eye_in_room, double yaw_rad, const HeadConfig& head) {
  const Quat rotation(Eigen::AngleAxisd(yaw_rad, Vec3::UnitY()));
  return {rotation, eye_in_room - rotation * head.eye_in_head};
}

}  // namespace vindu
