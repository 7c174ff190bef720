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

Vec2 picture_size_px(const CameraConfig& camera) {
  if (camera.source == CameraSource::video)
    return Vec2(camera.video.width_px, camera.video.height_px);
  return {kWiimoteWidth_px, kWiimoteHeight_px};
}

std::size_t most_dots(const CameraConfig& camera) {
  constexpr std::size_t kWiimoteDots = 4;
  return camera.source == CameraSource::video
             ? static_cast<std::size_t>(camera.video.blobs.max_dots)
             : kWiimoteDots;
}

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

bool CameraModel::in_view(const Vec3& x_in_camera) const {
  const double z2 = x_in_camera.z() * x_in_camera.z();
  return x_in_camera.z() > 0 && x_in_camera.head<2>().squaredNorm() <= largest_radius2_ * z2;
}

// The model of OpenCV's calib3d ("Camera Calibration and 3D Reconstruction", detailed description).
Vec2 CameraModel::bent(double x, double y) const {
  const double r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = intrinsics_.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

std::optional<Vec2> CameraModel::project(const Vec3& x_in_camera) const {
  if (!in_view(x_in_camera)) return std::nullopt;
  const Vec2 image = bent(x_in_camera.x() / x_in_camera.z(), x_in_camera.y() / x_in_camera.z());
  return image_from_raw(source_, {intrinsics_.fx_px * image.x() + intrinsics_.cx_px,
                                  intrinsics_.fy_px * image.y() + intrinsics_.cy_px});
}

std::optional<Projection> CameraModel::project_with_jacobian(const Vec3& x_in_camera) const {
  const auto raw_px = project(x_in_camera);
  if (!raw_px) return std::nullopt;
  const double near = 1 / x_in_camera.z();
  const double x = x_in_camera.x() * near, y = x_in_camera.y() * near, r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = intrinsics_.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));  // of radial, times 1/x or 1/y
  const double cross = x * y * slope + 2 * (p1 * x + p2 * y);
  const double flip = source_ == CameraSource::video ? 1 : -1;
  Eigen::Matrix2d d_raw_d_xy;
  d_raw_d_xy << intrinsics_.fx_px * (radial + x * x * slope + 2 * p1 * y + 6 * p2 * x),
      intrinsics_.fx_px * cross, flip * intrinsics_.fy_px * cross,
      flip * intrinsics_.fy_px * (radial + y * y * slope + 6 * p1 * y + 2 * p2 * x);
  Eigen::Matrix<double, 2, 3> d_xy_d_x;
  d_xy_d_x << near, 0, -x * near, 0, near, -y * near;
  return Projection{*raw_px, d_raw_d_xy * d_xy_d_x};
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
