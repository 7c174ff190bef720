#include "tracker/calibration/grid.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "core/error.h"
#include "tracker/calibration/lens.h"
#include "tracker/camera_model.h"

namespace vindu {
namespace {

constexpr int kFewestViews = 10;

/// One view: the dots in the order of the grid's LEDs.
struct GridView {
  double t_s = 0;
  std::vector<Vec2> dots_px;
  Rigid3 camera_from_rig;
};

std::vector<GridView> all_views(const Capture& capture, const std::vector<CameraConfig>& cameras,
                                std::size_t camera, const Grid& grid) {
  Vec2 up_in_image(0, -1);
  if (camera < capture.up_in_camera.size() && capture.up_in_camera[camera])
    if (const Vec2 up = capture.up_in_camera[camera]->head<2>(); up.norm() > 0.3)
      up_in_image = up.normalized();
  std::vector<GridView> views;
  for (const Observation& seen : capture.observations) {
    if (static_cast<std::size_t>(seen.camera) != camera) continue;
    std::vector<Vec2> dots;
    for (const Dot& dot : seen.dots)
      dots.push_back(image_from_raw(cameras[camera].source, {dot.x_px, dot.y_px}));
    const auto labels = label_grid(dots, grid, up_in_image);
    if (!labels) continue;
    GridView view{seconds(seen.arrival.time_since_epoch()), {}, {}};
    for (const std::size_t dot : *labels) view.dots_px.push_back(dots[dot]);
    views.push_back(std::move(view));
  }
  return views;
}

/// Planar PnP (IPPE: Collins & Bartoli 2014): both poses of a plane, the better one first.
std::vector<Rigid3> plane_poses(const Grid& grid, const std::vector<Vec2>& dots_px,
                                const Lens& lens) {
  std::vector<cv::Point3d> leds;
  std::vector<cv::Point2d> dots;
  for (const Vec3& led : grid.leds_in_rig()) leds.emplace_back(led.x(), led.y(), led.z());
  for (const Vec2& dot : dots_px) dots.emplace_back(dot.x(), dot.y());
  const cv::Matx33d matrix(lens[0], 0, lens[2], 0, lens[0] * lens[1], lens[3], 0, 0, 1);
  const cv::Matx<double, 5, 1> distortion(lens[4], lens[5], lens[6], lens[7], lens[8]);
  std::vector<cv::Mat> turns, places;
  cv::solvePnPGeneric(leds, dots, matrix, distortion, turns, places, false, cv::SOLVEPNP_IPPE);
  std::vector<Rigid3> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Vec3 turn(turns[i].at<double>(0), turns[i].at<double>(1), turns[i].at<double>(2));
    const Vec3 place(places[i].at<double>(0), places[i].at<double>(1), places[i].at<double>(2));
    const double angle = turn.norm();
    const Vec3 axis = angle > 0 ? Vec3(turn / angle) : Vec3::UnitX();
    if (turn.allFinite() && place.z() > 0)
      poses.push_back({Quat(Eigen::AngleAxisd(angle, axis)), place});
  }
  return poses;
}

struct LedCost {
  Vec2 dot_px;
  Vec3 led_in_rig;
  double sigma_px = 1;

  template <class T>
  bool operator()(const T* lens, const T* turn, const T* place, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(turn);
    Eigen::Matrix<T, 2, 1> image_px;
    const Eigen::Matrix<T, 3, 1> x_in_camera =
        rotation * led_in_rig.cast<T>() + Eigen::Map<const Eigen::Matrix<T, 3, 1>>(place);
    if (!project<T>(lens, x_in_camera, image_px)) return false;
    residual[0] = (T(dot_px.x()) - image_px.x()) / T(sigma_px);
    residual[1] = (T(dot_px.y()) - image_px.y()) / T(sigma_px);
    return true;
  }
};

struct LensPriorCost {
  LensPrior prior;

  template <class T>
  bool operator()(const T* lens, T* residual) const {
    for (int i = 0; i < 9; ++i)
      residual[i] = prior.sigma[i] > 0 ? (lens[i] - T(prior.mean[i])) / T(prior.sigma[i]) : T(0);
    return true;
  }
};

/// Lens and views together; with the lens held the views alone.
class GridProblem {
 public:
  GridProblem(std::vector<GridView>& views, const Grid& grid, Lens& lens, const LensPrior& prior,
              double sigma_px)
      : views_(views), lens_(lens), leds_(grid.leds_in_rig()) {
    const bool hold_lens = prior.sigma.isZero();
    std::vector<int> held;
    for (int i = 0; i < 9; ++i)
      if (!(prior.sigma[i] > 0)) held.push_back(i);
    problem_.AddParameterBlock(
        lens.data(), 9, held.empty() || hold_lens ? nullptr : new ceres::SubsetManifold(9, held));
    if (hold_lens) problem_.SetParameterBlockConstant(lens.data());
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<LensPriorCost, 9, 9>(new LensPriorCost{prior}), nullptr,
        lens.data());
    for (GridView& view : views) {
      double* turn = view.camera_from_rig.rotation.coeffs().data();
      problem_.AddParameterBlock(turn, 4, new ceres::EigenQuaternionManifold);
      for (std::size_t i = 0; i < leds_.size(); ++i)
        problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<LedCost, 2, 9, 4, 3>(
                                      new LedCost{view.dots_px[i], leds_[i], sigma_px}),
                                  new ceres::HuberLoss(2), lens.data(), turn,
                                  view.camera_from_rig.translation.data());
    }
  }

  void solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
  }

  /// One sigma of a block's ambient coordinates for dots of sigma 1 px; empty where it is not
  /// fixed.
  Eigen::VectorXd sigma(const double* block, int size) {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.apply_loss_function = false;
    ceres::Covariance covariance(options);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(size, size);
    if (!covariance.Compute(std::vector<std::pair<const double*, const double*>>{{block, block}},
                            &problem_) ||
        !covariance.GetCovarianceBlock(block, block, values.data()))
      return {};
    return values.diagonal().cwiseMax(0).cwiseSqrt();
  }

  double rms() const {
    double sum2 = 0;
    int count = 0;
    for (const GridView& view : views_)
      for (std::size_t i = 0; i < view.dots_px.size(); ++i, count += 2) sum2 += off(view, i);
    return std::sqrt(sum2 / std::max(1, count));
  }

 private:
  double off(const GridView& view, std::size_t i) const {
    Vec2 residual = Vec2::Constant(1e3);
    LedCost{view.dots_px[i], leds_[i], 1}(lens_.data(),
                                          view.camera_from_rig.rotation.coeffs().data(),
                                          view.camera_from_rig.translation.data(), residual.data());
    return residual.squaredNorm();
  }

  std::vector<GridView>& views_;
  Lens& lens_;
  std::vector<Vec3> leds_;
  ceres::Problem problem_;
};

std::vector<GridView> spaced(std::vector<GridView> views, const LensOptions& options) {
  std::vector<GridView> chosen;
  for (GridView& view : views)
    if (chosen.empty() || view.t_s >= chosen.back().t_s + options.interval_s)
      chosen.push_back(std::move(view));
  if (chosen.size() <= static_cast<std::size_t>(options.views)) return chosen;
  std::vector<GridView> thinned;
  for (int i = 0; i < options.views; ++i)
    thinned.push_back(chosen[static_cast<std::size_t>(i) * chosen.size() /
                             static_cast<std::size_t>(options.views)]);
  return thinned;
}

}  // namespace

LensResult calibrate_lens(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          std::size_t camera, const Grid& grid, const LensOptions& options) {
  const std::string where = "camera " + cameras[camera].name;
  const LensPrior prior = lens_prior(cameras[camera]);
  Lens lens = prior.mean;
  auto views = spaced(all_views(capture, cameras, camera, grid), options);
  std::erase_if(views, [&](GridView& view) {
    const auto poses = plane_poses(grid, view.dots_px, lens);
    if (!poses.empty()) view.camera_from_rig = poses.front();
    return poses.empty();
  });
  if (views.size() < kFewestViews)
    throw Error({fmt::format("saw the whole rig, and nothing else, in {} views", views.size()),
                 where,
                 fmt::format("move it about before the camera for {:.0f} s, all LEDs in view",
                             options.views * options.interval_s)});
  GridProblem rough(views, grid, lens, prior, 1);
  rough.solve();
  // six freedoms of each view's pose are taken from its dots' scatter
  const double coordinates = 2.0 * grid.columns * grid.rows;
  const double noise_px = rough.rms() * std::sqrt(coordinates / (coordinates - 6));
  GridProblem problem(views, grid, lens, prior, std::max(0.3, noise_px));
  problem.solve();
  LensResult result;
  result.views = static_cast<int>(views.size());
  result.intrinsics = intrinsics_of(lens);
  result.rms_px = problem.rms();
  const Eigen::VectorXd sigma = problem.sigma(lens.data(), 9);
  for (const GridView& view : views)
    for (const Vec2& dot : view.dots_px) result.coverage.add(dot, picture_size_px(cameras[camera]));
  if (sigma.size() == 9) {
    result.focal_sigma_px = sigma[0];
    result.centre_sigma_px = sigma.segment<2>(2);
    result.k1_sigma = sigma[4];
  }
  if (sigma.size() != 9 || result.focal_sigma_px > 0.032 * lens[0])
    throw Error({fmt::format("its focal length is known to {:.0f} px only", result.focal_sigma_px),
                 where,
                 "tilt the rig by 45 degrees in all directions, near the camera, in all "
                 "corners of its view"});
  if (result.rms_px > 3)
    throw Error(
        {fmt::format("the dots stray by {:.1f} px from any view of such a rig", result.rms_px),
         where, "measure the rig again and give its --grid and --spacing-mm"});
  return result;
}

PlaceResult calibrate_place(const Capture& capture, const std::vector<CameraConfig>& cameras,
                            std::size_t camera, const Grid& grid, const Rigid3& room_from_rig) {
  const std::string where = "camera " + cameras[camera].name;
  const auto seen = all_views(capture, cameras, camera, grid);
  if (seen.size() < 20)
    throw Error({"does not see the whole rig, or other lights beside it", where,
                 "turn the rig towards it; vindu wiimote watch shows what it sees"});
  GridView mean{0, std::vector<Vec2>(seen.front().dots_px.size(), Vec2::Zero()), {}};
  for (const GridView& view : seen)
    for (std::size_t i = 0; i < mean.dots_px.size(); ++i)
      mean.dots_px[i] += view.dots_px[i] / static_cast<double>(seen.size());
  for (const GridView& view : seen)
    for (std::size_t i = 0; i < mean.dots_px.size(); ++i)
      if ((view.dots_px[i] - mean.dots_px[i]).norm() > 12)
        throw Error({"sees the rig move", where, "put the rig down, and keep the camera still"});
  Lens lens = lens_of(cameras[camera].intrinsics);
  PlaceResult best;
  double least = 1e300;
  for (const Rigid3& pose : plane_poses(grid, mean.dots_px, lens)) {
    std::vector<GridView> view{mean};
    view[0].camera_from_rig = pose;
    // what rounding leaves of a dot that stands still is not averaged away
    GridProblem problem(view, grid, lens, {lens, Lens::Zero()}, 0.3);
    problem.solve();
    const Rigid3 room_from_camera = room_from_rig * inverse(view[0].camera_from_rig);
    double cost = problem.rms();
    if (const auto& up = capture.up_in_camera[camera])  // tells the two poses of a plane apart
      cost += 20 * (1 - (room_from_camera.rotation * *up).y());
    if (cost >= least) continue;
    least = cost;
    const Eigen::VectorXd sigma = problem.sigma(view[0].camera_from_rig.translation.data(), 3);
    best = {room_from_camera, problem.rms(), sigma.size() == 3 ? 1e3 * sigma.norm() : 0,
            static_cast<int>(seen.size()), mean.dots_px};
  }
  if (!(best.rms_px < 3) || least > 1e200)
    throw Error(
        {fmt::format("the dots stray by {:.1f} px from any view of such a rig", best.rms_px), where,
         "measure the rig again and give its --grid and --spacing-mm"});
  return best;
}

}  // namespace vindu
