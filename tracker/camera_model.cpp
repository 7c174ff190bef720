#include "tracker/camera_model.h"

#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace vindu {
namespace {

// Where r (1 + k1 r^2 + k2 r^4 + k3 r^6) stops growing, as r^2: the first zero of its derivative,
// found to 0.1 %. Beyond r^2 = 25 (79 degrees off the axis) nothing is asked.
double radius2_of_fold(const Intrinsics& intrinsics) {
  const auto& [k1, k2, p1, p2, k3] = intrinsics.distortion;
  for (double r2 = 1e-3; r2 < 25; r2 *= 1.001)
    if (1 + r2 * (3 * k1 + r2 * (5 * k2 + r2 * 7 * k3)) <= 0) return r2;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

Vec2 image_from_raw(CameraSource source, const Vec2& raw_px) {
  if (source == CameraSource::video) return raw_px;
  return {raw_px.x(), kWiimoteHeight_px - 1 - raw_px.y()};
}

CameraModel::CameraModel(const CameraConfig& config)
    : source_(config.source),
      intrinsics_(config.intrinsics),
      room_from_camera_(config.room_from_camera),
      camera_from_room_(inverse(config.room_from_camera)),
      distorts_(std::ranges::any_of(intrinsics_.distortion, [](double k) { return k != 0; })),
      largest_radius2_(radius2_of_fold(intrinsics_)) {}

// The model of OpenCV's calib3d ("Camera Calibration and 3D Reconstruction", detailed description).
std::optional<Vec2> CameraModel::project(const Vec3& x_in_camera) const {
  if (!(x_in_camera.z() > 0)) return std::nullopt;
  const double x = x_in_camera.x() / x_in_camera.z(), y = x_in_camera.y() / x_in_camera.z();
  const double r2 = x * x + y * y;
  if (r2 > largest_radius2_) return std::nullopt;
  const auto& [k1, k2, p1, p2, k3] = intrinsics_.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double bent_x = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double bent_y = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return image_from_raw(source_, {intrinsics_.fx_px * bent_x + intrinsics_.cx_px,
                                  intrinsics_.fy_px * bent_y + intrinsics_.cy_px});
}

Vec2 CameraModel::undistorted(const Vec2& image_px) const {
  if (!distorts_)
    return {(image_px.x() - intrinsics_.cx_px) / intrinsics_.fx_px,
            (image_px.y() - intrinsics_.cy_px) / intrinsics_.fy_px};
  const cv::Matx33d matrix(intrinsics_.fx_px, 0, intrinsics_.cx_px, 0, intrinsics_.fy_px,
                           intrinsics_.cy_px, 0, 0, 1);
  const cv::Matx<double, 5, 1> distortion(intrinsics_.distortion.data());
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-10);
  cv::Matx<double, 1, 2> point(image_px.x(), image_px.y());
  const cv::Mat from(1, 1, CV_64FC2, point.val);
  cv::Mat to;
  cv::undistortPoints(from, to, matrix, distortion, cv::noArray(), cv::noArray(), until);
  const cv::Vec2d straight = to.at<cv::Vec2d>(0);
  return {straight[0], straight[1]};
}

Ray CameraModel::ray_through(const Vec2& raw_px) const {
  const Vec2 straight = undistorted(image_from_raw(source_, raw_px));
  const Vec3 direction_in_camera = Vec3(straight.x(), straight.y(), 1).normalized();
  return {room_from_camera_.translation, room_from_camera_.rotation * direction_in_camera};
}

}  // namespace vindu
