#include "tracker/eye_rest.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

/// By how much more than the eye a ray's point on a tile may move. Something infinitely far keeps
/// its ray's direction r: the point moves by d - r (n d) / (n r), at most d |r| / (n r). Something
/// at a height h over the tile moves the ray's other end: h / (height of the eye - h) of it.
double gain(const TileCorners& corners, const Vec3& corner_in_wall, const Vec3& eye_in_wall,
            std::span<const Vec3> scene_in_wall) {
  const Vec3 normal = corners.normal_in_wall();
  const double height_m = normal.dot(eye_in_wall - corner_in_wall);
  double nearest = 1;
  for (const Vec3& point : scene_in_wall) {
    const double before_m = normal.dot(point - corner_in_wall);
    const double room_m = std::max(height_m - before_m, 1e-9);
    nearest = std::max(nearest, before_m / room_m);
  }
  return nearest * (eye_in_wall - corner_in_wall).norm() / height_m;
}

Vec3 shortened(const Vec3& vector, double most) {
  const double length = vector.norm();
  return length > most ? Vec3(most / length * vector) : vector;
}

}  // namespace

double eye_slack_m(const Wall& wall, const Vec3& eye_in_wall,
                   std::span<const Vec3> corners_in_wall) {
  double slack_m = 1;
  for (const Tile& tile : wall.tiles) {
    const TileCorners& corners = tile.corners;
    if (corners.normal_in_wall().dot(eye_in_wall - corners.lower_left_in_wall) <= 0) continue;
    const double pixel_m =
        std::min(corners.width_m() / tile.width_px, corners.height_m() / tile.height_px);
    for (const Vec3& corner : {corners.lower_left_in_wall, corners.lower_right_in_wall,
                               corners.upper_left_in_wall, corners.upper_right_in_wall()})
      slack_m =
          std::min(slack_m, 0.5 * pixel_m / gain(corners, corner, eye_in_wall, corners_in_wall));
  }
  return slack_m;
}

// An error of the head's rotation moves the eye by its lever: J = [1, -[lever]x].
double eye_sigma_m(const PoseSample& pose, const Vec3& eye_in_head) {
  const Vec3 lever = pose.room_from_head.rotation * eye_in_head;
  Eigen::Matrix<double, 3, 6> eye_by_pose;
  eye_by_pose << Mat3::Identity(), Mat3::Zero();
  eye_by_pose.rightCols<3>() << 0, lever.z(), -lever.y(), -lever.z(), 0, lever.x(), lever.y(),
      -lever.x(), 0;
  const double variance = (eye_by_pose * pose.covariance * eye_by_pose.transpose()).trace() / 3;
  return std::sqrt(std::max(variance, 0.0));
}

Vec3 EyeRest::update(const Vec3& eye_in_wall, double slack_m, double sigma_m, Time now) {
  const double reach_m = std::max(slack_m, options_.noise_sigmas * sigma_m);
  const bool first = last_.empty();
  last_.push_back({now, eye_in_wall});
  while (now - last_[0].time > options_.quiet_for && now - last_[1].time >= options_.quiet_for)
    last_.pop_front();
  const bool rested = resting_;
  const Vec3 held_before = held_in_wall_;
  resting_ = rested ? stays(eye_in_wall, slack_m, reach_m, now) : quiet(reach_m);
  if (resting_ && !rested) held_in_wall_ = mean_in_wall_ = sigma_m > 0 ? mean() : eye_in_wall;
  const Vec3 wanted = resting_ ? held_in_wall_ : eye_in_wall;
  if (first || resting_ != rested || held_in_wall_ != held_before) {
    offset_ = first ? Vec3::Zero() : Vec3(shown_in_wall_ - wanted);
    turned_ = now;
  }
  const double left = std::max(0.0, 1 - (now - turned_) / (1.0 * options_.blend_within));
  const Vec3 eased = left > 0 ? Vec3(wanted + left * offset_) : wanted;
  const Vec3 off = eased - eye_in_wall;
  shown_in_wall_ = off.norm() > reach_m ? Vec3(eye_in_wall + shortened(off, reach_m)) : eased;
  return shown_in_wall_;
}

// An eye that drifts in its noise is followed in steps of what nobody sees.
bool EyeRest::stays(const Vec3& eye_in_wall, double slack_m, double reach_m, Time now) {
  const Duration step = last_.size() > 1 ? now - last_[last_.size() - 2].time : Duration{};
  mean_in_wall_ += std::min(1.0, step / (1.0 * options_.mean_over)) * (eye_in_wall - mean_in_wall_);
  if ((mean_in_wall_ - held_in_wall_).norm() > slack_m) held_in_wall_ = mean_in_wall_;
  return (eye_in_wall - held_in_wall_).norm() <= reach_m;
}

bool EyeRest::quiet(double reach_m) const {
  if (last_.back().time - last_.front().time < options_.quiet_for) return false;
  const Vec3 middle = mean();
  return std::ranges::all_of(last_, [&](const Sample& sample) {
    return (sample.eye_in_wall - middle).norm() <= options_.quiet_share * reach_m;
  });
}

Vec3 EyeRest::mean() const {
  Vec3 sum = Vec3::Zero();
  for (const Sample& sample : last_) sum += sample.eye_in_wall;
  return sum / static_cast<double>(last_.size());
}

}  // namespace vindu
