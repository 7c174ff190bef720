#include "tracker/calibration/wand_adjust.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <limits>

namespace vindu {
namespace {

/// The dot is moved along its speed to the moment at which its camera would have shown it.
struct DotCost {
  Vec2 dot_px, speed_px_s;
  double early_s;  // moment less picture's time
  double along_m;
  double weight;

  template <class T>
  bool operator()(const T* rotation, const T* place, const T* lens, const T* lag_ms, const T* pose,
                  T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> world_from_camera(rotation);
    const Vector3 x_in_world = Eigen::Map<const Vector3>(pose) +
                               T(along_m) * Eigen::Map<const Vector3>(pose + 3) -
                               Eigen::Map<const Vector3>(place);
    Eigen::Matrix<T, 2, 1> image_px;
    if (!project<T>(lens, world_from_camera.conjugate() * x_in_world, image_px)) return false;
    const T late_s = T(early_s) + T(1e-3) * lag_ms[0];
    for (int axis = 0; axis < 2; ++axis)
      residual[axis] =
          T(weight) * (T(dot_px[axis]) + T(speed_px_s[axis]) * late_s - image_px[axis]);
    return true;
  }
};

struct PriorCost {
  LensPrior prior;

  template <class T>
  bool operator()(const T* lens, const T* lag_ms, T* residual) const {
    for (int i = 0; i < 9; ++i)
      residual[i] = prior.sigma[i] > 0 ? (lens[i] - T(prior.mean[i])) / T(prior.sigma[i]) : T(0);
    residual[9] = lag_ms[0] / T(200);
    return true;
  }
};

/// The parameter blocks of a world, in the form that Ceres takes.
struct Blocks {
  struct Camera {
    std::array<double, 4> rotation;
    std::array<double, 3> place;
    Lens lens;
    double lag_ms;
  };
  std::vector<Camera> cameras;
  std::vector<WandPose> poses;

  explicit Blocks(const WandWorld& world) : poses(world.poses) {
    for (const AdjustedCamera& camera : world.cameras) {
      Camera block{{}, {}, camera.lens, camera.lag_ms};
      Eigen::Map<Quat>(block.rotation.data()) = camera.world_from_camera.rotation;
      Eigen::Map<Vec3>(block.place.data()) = camera.world_from_camera.translation;
      cameras.push_back(block);
    }
  }
  void copy_to(WandWorld& world) const {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      AdjustedCamera& camera = world.cameras[i];
      camera.world_from_camera = {Eigen::Map<const Quat>(cameras[i].rotation.data()).normalized(),
                                  Eigen::Map<const Vec3>(cameras[i].place.data())};
      camera.lens = cameras[i].lens;
      camera.lag_ms = cameras[i].lag_ms;
    }
    world.poses = poses;
  }
};

std::vector<int> held_parameters(const LensPrior& prior) {
  std::vector<int> held;
  for (int i = 0; i < 9; ++i)
    if (!(prior.sigma[i] > 0)) held.push_back(i);
  return held;
}

void add_camera(const WandWorld& world, std::size_t index, Free free, Blocks& blocks,
                ceres::Problem& problem) {
  Blocks::Camera& camera = blocks.cameras[index];
  const LensPrior& prior = world.cameras[index].prior;
  problem.AddParameterBlock(camera.rotation.data(), 4, new ceres::EigenQuaternionManifold);
  problem.AddParameterBlock(camera.place.data(), 3);
  const auto held = held_parameters(prior);
  problem.AddParameterBlock(
      camera.lens.data(), 9,
      held.empty() || held.size() == 9 ? nullptr : new ceres::SubsetManifold(9, held));
  problem.AddParameterBlock(&camera.lag_ms, 1);
  if (free != Free::everything || held.size() == 9)
    problem.SetParameterBlockConstant(camera.lens.data());
  if (free == Free::poses_only || index == 0) {
    problem.SetParameterBlockConstant(camera.rotation.data());
    problem.SetParameterBlockConstant(camera.place.data());
    problem.SetParameterBlockConstant(&camera.lag_ms);
  }
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<PriorCost, 10, 9, 1>(new PriorCost{prior}), nullptr,
      camera.lens.data(), &camera.lag_ms);
}

void add_moment(const WandWorld& world, const WandMoment& moment, WandPose& pose,
                ceres::LossFunction* loss, Blocks& blocks, ceres::Problem& problem) {
  for (const WandView& view : moment.views)
    for (std::size_t led = 0; led < view.dots_px.size(); ++led) {
      if (!view.used[led]) continue;
      const auto index = static_cast<std::size_t>(view.camera);
      Blocks::Camera& camera = blocks.cameras[index];
      auto* cost = new DotCost{view.dots_px[led], view.speed_px_s[led], moment.t_s - view.t_s,
                               world.leds_m[led], 1 / sigma_px(world.cameras[index], view, led)};
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<DotCost, 2, 4, 3, 9, 1, 6>(cost),
                               loss, camera.rotation.data(), camera.place.data(),
                               camera.lens.data(), &camera.lag_ms, pose.data());
    }
  if (problem.HasParameterBlock(pose.data()))
    problem.SetManifold(
        pose.data(),
        new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::SphereManifold<3>>);
}

bool takes_part(const WandMoment& moment, Free free) {
  return moment.used && (free == Free::poses_only || !moment.held_out);
}

/// The problem's Jacobian; the cameras' columns first, then five of each wand pose.
struct Columns {
  std::vector<double*> blocks;
  std::vector<int> camera_begin;  // by camera: rotation, place, lens, lag; the first: lens alone
  int cameras = 0;                // columns of all cameras
};

Columns columns_of(const WandWorld& world, const std::vector<WandMoment>& moments, Blocks& blocks) {
  Columns columns;
  for (std::size_t i = 0; i < blocks.cameras.size(); ++i) {
    Blocks::Camera& camera = blocks.cameras[i];
    columns.camera_begin.push_back(columns.cameras);
    const int lens = 9 - static_cast<int>(held_parameters(world.cameras[i].prior).size());
    if (i > 0)
      columns.blocks.insert(columns.blocks.end(), {camera.rotation.data(), camera.place.data()});
    if (lens > 0) columns.blocks.push_back(camera.lens.data());
    if (i > 0) columns.blocks.push_back(&camera.lag_ms);
    columns.cameras += lens + (i > 0 ? 7 : 0);
  }
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (takes_part(moments[i], Free::everything)) columns.blocks.push_back(blocks.poses[i].data());
  return columns;
}

/// What the dots tell of the cameras' columns, the wand's poses eliminated (Schur complement).
struct CameraEquations {
  Eigen::MatrixXd normal;
  std::vector<Eigen::VectorXd> pulls;  ///< of each pose's dots: J'r; about zero altogether
};

CameraEquations camera_equations(const ceres::CRSMatrix& jacobian,
                                 const std::vector<double>& residuals, int cameras) {
  using Row5 = Eigen::Matrix<double, 5, 1>;
  const int poses = (jacobian.num_cols - cameras) / 5;
  CameraEquations equations{Eigen::MatrixXd::Zero(cameras, cameras), {}};
  std::vector<Eigen::Matrix<double, 5, 5>> pose_normal(poses, Eigen::Matrix<double, 5, 5>::Zero());
  std::vector<Row5> pose_pull(poses, Row5::Zero());
  std::vector<Eigen::MatrixXd> mixed(poses, Eigen::MatrixXd::Zero(cameras, 5));
  equations.pulls.assign(poses, Eigen::VectorXd::Zero(cameras));
  for (int row = 0; row < jacobian.num_rows; ++row) {
    Eigen::VectorXd of_cameras = Eigen::VectorXd::Zero(cameras);
    Row5 of_pose = Row5::Zero();
    int pose = -1;
    for (int i = jacobian.rows[row]; i < jacobian.rows[row + 1]; ++i) {
      const int column = jacobian.cols[i];
      if (column < cameras) {
        of_cameras[column] = jacobian.values[i];
      } else {
        pose = (column - cameras) / 5;
        of_pose[(column - cameras) % 5] = jacobian.values[i];
      }
    }
    equations.normal += of_cameras * of_cameras.transpose();
    if (pose < 0) continue;
    pose_normal[pose] += of_pose * of_pose.transpose();
    pose_pull[pose] += residuals[row] * of_pose;
    mixed[pose] += of_cameras * of_pose.transpose();
    equations.pulls[pose] += residuals[row] * of_cameras;
  }
  for (int i = 0; i < poses; ++i) {
    const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> solver(pose_normal[i]);
    equations.normal -= mixed[i] * solver.solve(mixed[i].transpose());
    equations.pulls[i] -= mixed[i] * solver.solve(pose_pull[i]);
  }
  return equations;
}

/// Empty where the normal equations are singular.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& normal) {
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  if (solver.info() != Eigen::Success || !solver.isPositive() || solver.vectorD().minCoeff() < 1e-9)
    return {};
  return solver.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
}

/// The variance by how differently the stretches of a capture pull (the sandwich of Liang & Zeger
/// 1986, Biometrika 73; its factor for few stretches).
Eigen::VectorXd variance_of_stretches(const std::vector<Eigen::VectorXd>& pulls,
                                      const Eigen::MatrixXd& covariance) {
  constexpr std::size_t kStretches = 4;
  Eigen::MatrixXd by_stretch = Eigen::MatrixXd::Zero(covariance.rows(), kStretches);
  for (std::size_t i = 0; i < pulls.size(); ++i)
    by_stretch.col(static_cast<Eigen::Index>(i * kStretches / pulls.size())) += pulls[i];
  by_stretch.colwise() -= by_stretch.rowwise().mean().eval();
  const Eigen::MatrixXd moved = covariance * by_stretch;
  return moved.rowwise().squaredNorm() * (1.0 * kStretches / (kStretches - 1));
}

CameraSigma sigma_from(const Eigen::VectorXd& variance, const LensPrior& prior, int begin,
                       bool first) {
  CameraSigma sigma;
  if (!first) {  // the quaternion's columns are half angles
    sigma.rotation_rad = 2 * std::sqrt(variance.segment(begin, 3).sum());
    sigma.position_m = variance.segment<3>(begin + 3).cwiseSqrt();
    begin += 6;
  }
  for (int i = 0; i < 9; ++i)
    if (prior.sigma[i] > 0) sigma.lens[i] = std::sqrt(variance[begin++]);
  if (!first) sigma.lag_ms = std::sqrt(variance[begin]);
  return sigma;
}

}  // namespace

double sigma_px(const AdjustedCamera& camera, const WandView& view, std::size_t led) {
  return std::hypot(camera.sigma_px, view.speed_px_s[led].norm() * view.sigma_s);
}

Vec2 residual_px(const WandWorld& world, const WandPose& pose, const WandMoment& moment,
                 const WandView& view, std::size_t led) {
  const AdjustedCamera& camera = world.cameras[static_cast<std::size_t>(view.camera)];
  const DotCost cost{view.dots_px[led], view.speed_px_s[led], moment.t_s - view.t_s,
                     world.leds_m[led], 1};
  Vec2 residual;
  const bool seen = cost(camera.world_from_camera.rotation.coeffs().data(),
                         camera.world_from_camera.translation.data(), camera.lens.data(),
                         &camera.lag_ms, pose.data(), residual.data());
  return seen ? residual : Vec2::Constant(1e6);
}

void adjust(const std::vector<WandMoment>& moments, Free free, WandWorld& world,
            double huber_sigma) {
  Blocks blocks(world);
  ceres::HuberLoss loss(huber_sigma);
  ceres::Problem::Options ours;
  ours.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ours);
  ceres::Solver::Options options;
  auto* order = new ceres::ParameterBlockOrdering;
  for (std::size_t i = 0; i < blocks.cameras.size(); ++i) {
    Blocks::Camera& camera = blocks.cameras[i];
    add_camera(world, i, free, blocks, problem);
    for (double* block :
         {camera.rotation.data(), camera.place.data(), camera.lens.data(), &camera.lag_ms})
      order->AddElementToGroup(block, 1);
  }
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (!takes_part(moments[i], free)) continue;
    add_moment(world, moments[i], blocks.poses[i], &loss, blocks, problem);
    if (problem.HasParameterBlock(blocks.poses[i].data()))
      order->AddElementToGroup(blocks.poses[i].data(), 0);
  }
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering.reset(order);
  options.max_num_iterations = 60;
  options.function_tolerance = 1e-8;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.IsSolutionUsable()) blocks.copy_to(world);
}

std::vector<CameraSigma> sigmas_of(const std::vector<WandMoment>& moments, const WandWorld& world,
                                   SigmaBy by) {
  Blocks blocks(world);
  ceres::Problem problem;
  for (std::size_t i = 0; i < blocks.cameras.size(); ++i)
    add_camera(world, i, Free::everything, blocks, problem);
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (takes_part(moments[i], Free::everything))
      add_moment(world, moments[i], blocks.poses[i], nullptr, blocks, problem);
  const Columns columns = columns_of(world, moments, blocks);
  ceres::Problem::EvaluateOptions which;
  which.parameter_blocks = columns.blocks;
  ceres::CRSMatrix jacobian;
  std::vector<double> residuals;
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(columns.cameras, infinity);
  if (problem.Evaluate(which, nullptr, &residuals, nullptr, &jacobian)) {
    const auto equations = camera_equations(jacobian, residuals, columns.cameras);
    if (const auto covariance = inverse_of(equations.normal); covariance.size() > 0) {
      variance = covariance.diagonal();
      if (by == SigmaBy::residuals)
        variance = variance.cwiseMax(variance_of_stretches(equations.pulls, covariance));
    }
  }
  std::vector<CameraSigma> sigmas(world.cameras.size());
  for (std::size_t i = 0; i < sigmas.size(); ++i)
    sigmas[i] = sigma_from(variance, world.cameras[i].prior, columns.camera_begin[i], i == 0);
  return sigmas;
}

}  // namespace vindu
