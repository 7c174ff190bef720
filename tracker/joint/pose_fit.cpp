#include "tracker/joint/pose_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "tracker/joint/rotation.h"

namespace vindu {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Cost and its quadratic model around a pose; half of neither: gradient = J^T W r.
struct Normal {
  Mat6 dots = Mat6::Zero();
  Mat6 all = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
  double cost = 0;
  double square_px = 0;
};

// Huber's cost with residual r in sigmas: r^2 up to k, then k (2 r - k); weight min(1, k / r).
void add_dot(const LedSighting& sighting, const DotOfLed& dot, double huber, Normal& normal) {
  const Vec2 residual_px = dot.raw_px - sighting.raw_px;
  const double sigmas = residual_px.norm() / sighting.sigma_px;
  const double weight = sigmas > huber ? huber / sigmas : 1;
  const double scale = std::sqrt(weight) / sighting.sigma_px;
  const Eigen::Matrix<double, 6, 2> slope = scale * dot.d_raw_d_pose.transpose();
  normal.dots += slope.lazyProduct(slope.transpose());
  normal.gradient += slope.lazyProduct(scale * residual_px);
  normal.cost += sigmas > huber ? huber * (2 * sigmas - huber) : sigmas * sigmas;
  normal.square_px += residual_px.squaredNorm();
}

void add_prior(const PosePrior& prior, const Rigid3& pose, Normal& normal) {
  const Vec3 turn = vector_of(pose.rotation * prior.room_from_head.rotation.conjugate());
  Vec6 residual;
  residual << pose.translation - prior.room_from_head.translation, turn;
  Mat6 jacobian = Mat6::Identity();
  jacobian.bottomRightCorner<3, 3>() = inverse_left_jacobian(turn);
  normal.all += jacobian.transpose() * prior.information * jacobian;
  normal.gradient += jacobian.transpose() * prior.information * residual;
  normal.cost += residual.dot(prior.information * residual);
}

std::optional<Normal> normal_at(const Rigid3& pose, std::span<const CameraModel> cameras,
                                std::span<const LedSighting> sightings, const PosePrior& prior,
                                double huber) {
  Normal normal;
  for (const LedSighting& sighting : sightings) {
    const CameraModel& camera = cameras[static_cast<std::size_t>(sighting.camera)];
    const auto dot = dot_of_led(camera, pose, sighting.led_in_head);
    if (!dot) return std::nullopt;
    add_dot(sighting, *dot, huber, normal);
  }
  normal.all = normal.dots;
  if (!prior.information.isZero(0)) add_prior(prior, pose, normal);
  return normal;
}

Rigid3 moved(const Rigid3& pose, const Vec6& step) {
  return {(rotation_of(step.tail<3>()) * pose.rotation).normalized(),
          pose.translation + step.head<3>()};
}

bool finite(const Normal& normal) { return std::isfinite(normal.cost) && normal.all.allFinite(); }

}  // namespace

std::optional<DotOfLed> dot_of_led(const CameraModel& camera, const Rigid3& room_from_head,
                                   const Vec3& led_in_head) {
  const Vec3 arm = room_from_head.rotation * led_in_head;
  const Rigid3& camera_from_room = camera.camera_from_room();
  const auto projection =
      camera.project_with_jacobian(camera_from_room * (room_from_head.translation + arm));
  if (!projection) return std::nullopt;
  DotOfLed dot{projection->raw_px, {}};
  const Eigen::Matrix<double, 2, 3> d_raw_d_room =
      projection->d_raw_d_x_in_camera * camera_from_room.rotation.toRotationMatrix();
  dot.d_raw_d_pose.leftCols<3>() = d_raw_d_room;
  dot.d_raw_d_pose.rightCols<3>().noalias() = -d_raw_d_room * cross_matrix(arm);
  return dot;
}

// Marquardt's damping, halved and doubled: the diagonal is scaled, so units do not matter.
std::optional<PoseFit> fit_pose(std::span<const CameraModel> cameras,
                                std::span<const LedSighting> sightings, const Rigid3& start,
                                const PosePrior& prior, const PoseFitOptions& options) {
  Rigid3 pose = start;
  auto normal = normal_at(pose, cameras, sightings, prior, options.huber_sigmas);
  if (!normal || !finite(*normal)) return std::nullopt;
  double damping = 1e-4;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    Mat6 damped = normal->all;
    damped.diagonal() *= 1 + damping;
    const Eigen::LDLT<Mat6> solver(damped);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0)) return std::nullopt;
    const Vec6 step = solver.solve(-normal->gradient);
    const Rigid3 next = moved(pose, step);
    const auto there = normal_at(next, cameras, sightings, prior, options.huber_sigmas);
    if (!there || !finite(*there) || there->cost > normal->cost) {
      damping *= 8;
      if (damping > 1e8) break;
      continue;
    }
    pose = next;
    normal = there;
    damping = std::max(damping / 8, 1e-9);
    if (step.norm() < options.converged) break;
  }
  const double count = std::max<double>(1, static_cast<double>(sightings.size()));
  return PoseFit{pose, normal->dots, normal->all, normal->cost,
                 std::sqrt(normal->square_px / count)};
}

TrackingLevel level_of(const Mat6& dot_information) {
  constexpr double kPosition_m = 0.05, kRotation_rad = radians(15);
  if (!(dot_information.trace() > 0)) return TrackingLevel::lost;
  const Mat3 position = dot_information.topLeftCorner<3, 3>();
  const double least = Eigen::SelfAdjointEigenSolver<Mat3>(position, Eigen::EigenvaluesOnly)
                           .eigenvalues()
                           .minCoeff();
  if (!(least > 1 / (kPosition_m * kPosition_m))) return TrackingLevel::bearing;
  const Mat3 cross = dot_information.topRightCorner<3, 3>();
  const Mat3 rotation =
      dot_information.bottomRightCorner<3, 3>() - cross.transpose() * position.inverse() * cross;
  const Vec3 known =
      Eigen::SelfAdjointEigenSolver<Mat3>(rotation, Eigen::EigenvaluesOnly).eigenvalues();
  const auto fixed = (known.array() > 1 / (kRotation_rad * kRotation_rad)).count();
  return fixed == 3  ? TrackingLevel::six_dof
         : fixed > 0 ? TrackingLevel::hybrid
                     : TrackingLevel::position;
}

}  // namespace vindu
