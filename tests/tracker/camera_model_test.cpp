// The camera model against OpenCV's own projection and against its own inverse, and the one mirror
// convention.
#include "tracker/camera_model.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>
#include <unsupported/Eigen/AutoDiff>

namespace vindu {
namespace {

CameraConfig camera_with_distortion(CameraSource source) {
  CameraConfig config;
  config.source = source;
  config.intrinsics = {1340, 1310, 500, 390, {0.08, -0.05, 0.002, -0.003, 0.01}};
  return config;
}

std::vector<Vec3> points_in_view() {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> aside(-0.38, 0.38), depth_m(0.5, 6);
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) {
    const double z = depth_m(engine);
    points.emplace_back(aside(engine) * z, 0.75 * aside(engine) * z, z);
  }
  return points;
}

cv::Vec2d projected_by_opencv(const Vec3& x_in_camera, const Intrinsics& intrinsics) {
  const cv::Matx33d matrix(intrinsics.fx_px, 0, intrinsics.cx_px, 0, intrinsics.fy_px,
                           intrinsics.cy_px, 0, 0, 1);
  const std::vector<cv::Point3d> points = {{x_in_camera.x(), x_in_camera.y(), x_in_camera.z()}};
  std::vector<cv::Point2d> image;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix,
                    cv::Mat(5, 1, CV_64F, const_cast<double*>(intrinsics.distortion.data())),
                    image);
  return {image[0].x, image[0].y};
}

TEST(CameraModel, projects_as_opencv_does) {
  const CameraConfig config = camera_with_distortion(CameraSource::video);
  const CameraModel camera(config);
  for (const Vec3& point : points_in_view()) {
    const cv::Vec2d expected = projected_by_opencv(point, config.intrinsics);
    const auto raw_px = camera.project(point);
    ASSERT_TRUE(raw_px);
    EXPECT_NEAR(raw_px->x(), expected[0], 1e-9);
    EXPECT_NEAR(raw_px->y(), expected[1], 1e-9);
  }
}

/// OpenCV's formula once more, for any number that can be differentiated.
template <typename T>
Eigen::Matrix<T, 2, 1> projected(const Eigen::Matrix<T, 3, 1>& x, const Intrinsics& camera) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const T u = x(0) / x(2), v = x(1) / x(2), r2 = u * u + v * v;
  const T radial = T(1) + r2 * k1 + r2 * r2 * k2 + r2 * r2 * r2 * k3;
  return {(u * radial + u * v * (2 * p1) + (r2 + u * u * 2.0) * p2) * camera.fx_px + camera.cx_px,
          (v * radial + (r2 + v * v * 2.0) * p1 + u * v * (2 * p2)) * camera.fy_px + camera.cy_px};
}

TEST(CameraModel, its_derivative_is_that_of_automatic_differentiation) {
  using Scalar = Eigen::AutoDiffScalar<Vec3>;
  for (const CameraSource source : {CameraSource::video, CameraSource::wiimote}) {
    const CameraConfig config = camera_with_distortion(source);
    const CameraModel camera(config);
    const double up = source == CameraSource::video ? 1 : -1;  // of raw rows
    for (const Vec3& point : points_in_view()) {
      Eigen::Matrix<Scalar, 3, 1> x;
      for (int axis = 0; axis < 3; ++axis) x(axis) = Scalar(point(axis), 3, axis);
      const auto expected = projected<Scalar>(x, config.intrinsics);
      const auto projection = camera.project_with_jacobian(point);
      ASSERT_TRUE(projection);
      EXPECT_EQ(projection->raw_px, *camera.project(point));
      const auto& jacobian = projection->d_raw_d_x_in_camera;
      EXPECT_LT((jacobian.row(0).transpose() - expected(0).derivatives()).norm(), 1e-9);
      EXPECT_LT((jacobian.row(1).transpose() - up * expected(1).derivatives()).norm(), 1e-9);
    }
  }
}

TEST(CameraModel, ray_through_a_projection_meets_the_point) {
  for (const CameraSource source : {CameraSource::video, CameraSource::emulated}) {
    CameraConfig config = camera_with_distortion(source);
    config.room_from_camera = look_at({-1, 2.3, 5}, {0, 1.65, 2});
    const CameraModel camera(config);
    for (const Vec3& point : points_in_view()) {
      const Vec3 x_in_room = camera.room_from_camera() * point;
      const Ray ray = camera.ray_through(*camera.project(point));
      const Vec3 way = x_in_room - ray.origin_in_room;
      EXPECT_LT(way.cross(ray.direction_in_room).norm(), 1e-7 * way.norm());
      EXPECT_GT(way.dot(ray.direction_in_room), 0);
    }
  }
}

TEST(CameraModel, upright_wiimote_reports_x_growing_to_its_right_and_y_growing_upwards) {
  CameraConfig config;  // focal length 1335, centre (512, 384) in the image
  config.source = CameraSource::wiimote;
  const CameraModel camera(config);
  // One tenth of the depth to the right and up: 133.5 units. In the image up is down:
  // 384 - 133.5 = 250.5, and the raw row is 767 - 250.5 = 516.5.
  const auto raw_px = camera.project({0.3, -0.3, 3});
  ASSERT_TRUE(raw_px);
  EXPECT_NEAR(raw_px->x(), 645.5, 1e-9);
  EXPECT_NEAR(raw_px->y(), 516.5, 1e-9);
}

TEST(CameraModel, viewer_right_of_a_camera_behind_him_is_at_its_right) {
  CameraConfig config;  // stands 3 m behind, level, and looks at the wall
  config.room_from_camera = look_at({0, 1.65, 5}, {0, 1.65, 0});
  const CameraModel camera(config);
  const auto raw_px = camera.project(camera.camera_from_room() * Vec3(0.5, 1.9, 2));
  ASSERT_TRUE(raw_px);
  EXPECT_GT(raw_px->x(), 512);
  EXPECT_GT(raw_px->y(), 384);
}

TEST(CameraModel, sees_nothing_behind_itself_nor_beyond_the_fold_of_its_distortion) {
  CameraConfig config;
  config.intrinsics.distortion = {-0.4, 0, 0, 0, 0};  // r (1 - 0.4 r^2) grows up to r = 0.913
  const CameraModel camera(config);
  EXPECT_FALSE(camera.project({0, 0, -1}));
  EXPECT_FALSE(camera.project({0, 0, 0}));
  EXPECT_TRUE(camera.project({0.90, 0, 1}));
  EXPECT_FALSE(camera.project({0.93, 0, 1}));
}

}  // namespace
}  // namespace vindu
