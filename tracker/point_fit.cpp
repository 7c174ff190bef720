#include "tracker/point_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

namespace vindu {

PointFit fit_points(std::span<const Vec3> in_a, std::span<const Vec3> in_b, bool mirrored) {
  const auto count = static_cast<double>(in_a.size());
  Vec3 middle_a = Vec3::Zero(), middle_b = Vec3::Zero();
  for (std::size_t i = 0; i < in_a.size(); ++i)
    middle_a += in_a[i] / count, middle_b += in_b[i] / count;
  Mat3 spread = Mat3::Zero();
  for (std::size_t i = 0; i < in_a.size(); ++i)
    spread += (in_a[i] - middle_a) * (in_b[i] - middle_b).transpose();
  const Eigen::JacobiSVD<Mat3> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double turn = svd.matrixU().determinant() * svd.matrixV().determinant();
  Vec3 signs(1, 1, (mirrored ? -1 : 1) * (turn < 0 ? -1 : 1));
  PointFit fit;
  fit.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  fit.translation = middle_a - fit.rotation * middle_b;
  double sum2 = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i)
    sum2 += (fit.rotation * in_b[i] + fit.translation - in_a[i]).squaredNorm();
  fit.rms = std::sqrt(sum2 / count);
  return fit;
}

double expected_error(std::span<const Vec3> fitted, double rms, const Vec3& point) {
  const auto count = static_cast<double>(fitted.size());
  Vec3 middle = Vec3::Zero();
  for (const Vec3& each : fitted) middle += each / count;
  Mat3 spread = Mat3::Zero();
  for (const Vec3& each : fitted) spread += (each - middle) * (each - middle).transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  double by_turns = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vec3 axis = axes.eigenvectors().col(i);
    const double fitted2 = spread.trace() - axes.eigenvalues()[i];  // mean square from the axis
    by_turns += (point - middle).cross(axis).squaredNorm() / fitted2 / 3;
  }
  const double of_a_point2 = rms * rms * count / (count - 2);
  return std::sqrt(of_a_point2 / count * (1 + by_turns));
}

Quat least_turn(const Vec3& from, const Vec3& to) {
  const Vec3 start = from.normalized(), end = to.normalized();
  const double one_and_cosine = 1 + start.dot(end);
  if (one_and_cosine < 1e-12) return Quat(Eigen::AngleAxisd(kPi, start.unitOrthogonal()));
  const Vec3 axis = start.cross(end);
  return Quat(one_and_cosine, axis.x(), axis.y(), axis.z()).normalized();
}

}  // namespace vindu
