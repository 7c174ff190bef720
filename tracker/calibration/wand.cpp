#include "tracker/calibration/wand.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "tracker/calibration/wand_adjust.h"
#include "tracker/calibration/wand_judge.h"
#include "tracker/calibration/wand_noise.h"
#include "tracker/calibration/wand_start.h"
#include "tracker/point_fit.h"

namespace vindu {
namespace {

constexpr int kRounds = 4;
constexpr double kMostOutliers = 0.3;

std::vector<std::string> names_of(const std::vector<CameraConfig>& cameras) {
  std::vector<std::string> names;
  for (const CameraConfig& camera : cameras) names.push_back(camera.name);
  return names;
}

WandWorld begin_world(const std::vector<CameraConfig>& cameras, const std::vector<double>& leds_m) {
  WandWorld world;
  for (const CameraConfig& camera : cameras) {
    AdjustedCamera adjusted;
    adjusted.prior = lens_prior(camera);
    adjusted.lens = adjusted.prior.mean;
    adjusted.sigma_px = 2;
    world.cameras.push_back(adjusted);
  }
  for (const double led : leds_m) world.leds_m.push_back(led - 0.5 * leds_m.back());
  return world;
}

using Views = std::vector<std::vector<WandView>>;

Views find_views(const Capture& capture, const std::vector<CameraConfig>& cameras,
                 const std::vector<double>& leds_m) {
  const auto tracks = moving_dots(capture, cameras);
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (tracks[i].pictures.empty())
      throw Error({"sent nothing", "camera " + cameras[i].name,
                   "switch it on (vindu wiimote list), or take it out of the wall file"});
  Views views;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    views.push_back(find_wand(tracks[i], static_cast<int>(i), leds_m));
    if (views[i].empty())
      throw Error({"never saw the wand, its LEDs and nothing else like it",
                   "camera " + cameras[i].name,
                   "see vindu wiimote watch; take other lights away, wave within its view"});
  }
  return views;
}

/// By the outer LEDs alone: whether the middle one stands where it should is then to be seen.
void solve_by_ends(std::vector<WandMoment>& moments, WandWorld& world) {
  const auto use_middle = [&](bool used) {
    for (WandMoment& moment : moments)
      for (WandView& view : moment.views)
        if (view.used.size() == 3) view.used[1] = used;
  };
  use_middle(false);
  adjust(moments, Free::places, world);
  adjust(moments, Free::everything, world);
  adjust(moments, Free::poses_only, world);  // the held-out ones, too
  use_middle(true);
}

/// Moments, and a world that fits them roughly. Where cameras turn out to lag behind each other,
/// what belongs together is chosen anew.
std::vector<WandMoment> begin(const Views& views, const std::vector<std::string>& names,
                              const std::vector<CameraConfig>& cameras, const WandOptions& options,
                              WandWorld& world) {
  std::vector<double> lag_s(views.size(), 0);
  for (int round = 0;; ++round) {
    auto moments = join_views(views, lag_s, options.max_poses);
    refuse_too_little(moments, coverage_of(moments, cameras), names);
    start_world(moments, names, options.seed, world);
    solve_by_ends(moments, world);
    double most_ms = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      lag_s[i] = 1e-3 * world.cameras[i].lag_ms;
      most_ms = std::max(most_ms, std::abs(world.cameras[i].lag_ms));
    }
    if (round > 0 || most_ms < 8) return moments;
  }
}

void solve(std::vector<WandMoment>& moments, const std::vector<CameraSource>& kinds,
           WandWorld& world) {
  guess_sigma(moments, kinds, world);
  for (int round = 0; round < kRounds; ++round) {
    drop_outliers(moments, world);
    adjust(moments, Free::everything, world, kGate);
    adjust(moments, Free::poses_only, world, kGate);
    learn_sigma(moments, kinds, world);
  }
}

/// Level by gravity where a camera has felt it, the first camera where the wall file has it, turned
/// about the vertical until the others stand, seen from it, where the wall file has them.
Rigid3 room_from_world(const Capture& capture, const std::vector<CameraConfig>& cameras,
                       const WandWorld& world, WandResult& result) {
  const Rigid3& first = cameras[0].room_from_camera;
  Vec3 up_in_world = Vec3::Zero();
  for (std::size_t i = 0; i < capture.up_in_camera.size(); ++i)
    if (const auto& up = capture.up_in_camera[i])
      up_in_world += world.cameras[i].world_from_camera.rotation * *up;
  for (std::size_t i = 0; i < capture.up_in_camera.size(); ++i)
    if (const auto& up = capture.up_in_camera[i]) {
      const Vec3 own = world.cameras[i].world_from_camera.rotation * *up;
      if (own.dot(up_in_world.normalized()) < std::cos(radians(3)))
        result.remarks.push_back("camera " + cameras[i].name +
                                 ": its accelerometer disagrees about the vertical by more than 3 "
                                 "degrees");
    }
  result.level = up_in_world.norm() > 0.5;
  Quat rotation = first.rotation;
  if (result.level) rotation = least_turn(first.rotation * up_in_world, Vec3::UnitY()) * rotation;
  double sine = 0, cosine = 0;
  for (std::size_t i = 1; i < cameras.size(); ++i) {
    const Vec3 is = rotation * world.cameras[i].world_from_camera.translation;
    const Vec3 said = cameras[i].room_from_camera.translation - first.translation;
    sine += is.z() * said.x() - is.x() * said.z();
    cosine += is.x() * said.x() + is.z() * said.z();
  }
  if (result.level && std::hypot(sine, cosine) > 1e-3)
    rotation = Eigen::AngleAxisd(std::atan2(sine, cosine), Vec3::UnitY()) * rotation;
  return {rotation.normalized(), first.translation};
}

void fill_cameras(const std::vector<WandMoment>& moments, const std::vector<CameraConfig>& cameras,
                  const WandWorld& world, WandResult& result) {
  const auto sigmas = sigmas_of(moments, world, SigmaBy::residuals);
  const auto coverage = coverage_of(moments, cameras);
  const auto used = scatter_of(moments, world, false), held_out = scatter_of(moments, world, true);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const AdjustedCamera& camera = world.cameras[i];
    const CameraSigma& sigma = sigmas[i];
    WandCamera found;
    found.name = cameras[i].name;
    found.intrinsics = intrinsics_of(camera.lens);
    found.room_from_camera = camera.world_from_camera;
    found.lag_ms = cameras[0].lag_ms + camera.lag_ms;
    found.focal_sigma_px = sigma.lens[0];
    found.aspect_sigma = sigma.lens[1];
    found.centre_sigma_px = sigma.lens.segment<2>(2);
    found.k1_sigma = sigma.lens[4];
    found.position_sigma_mm = 1e3 * sigma.position_m;
    found.rotation_sigma_deg = degrees(sigma.rotation_rad);
    found.lag_sigma_ms = sigma.lag_ms;
    found.rms_px = used[i].rms();
    found.held_out_px = held_out[i].rms();
    for (const WandMoment& moment : moments)
      for (const WandView& view : moment.views)
        if (moment.used && view.camera == static_cast<int>(i)) ++found.views;
    found.coverage = coverage[i];
    result.cameras.push_back(std::move(found));
  }
}

void fill_lengths(const MeasuredWand& measured, double length_m, WandResult& result) {
  double sum = 0, sum2 = 0, predicted2 = 0;
  const auto count = static_cast<double>(std::max<std::size_t>(1, measured.outer_m.size()));
  for (std::size_t i = 0; i < measured.outer_m.size(); ++i) {
    const double off_m = measured.outer_m[i] - length_m;
    sum += off_m, sum2 += off_m * off_m;
    predicted2 += measured.predicted_sigma_m[i] * measured.predicted_sigma_m[i];
  }
  result.length_mean_mm = 1e3 * sum / count;
  result.length_rms_mm = 1e3 * std::sqrt(sum2 / count);
  result.predicted_length_rms_mm = 1e3 * std::sqrt(predicted2 / count);
}

void refuse_weak(const WandResult& result) {
  const std::string doubt = scatter_doubt(result);
  for (const WandCamera& camera : result.cameras) {
    const double f_px = camera.intrinsics.fx_px;
    if (!(camera.focal_sigma_px < 0.012 * f_px) || !(camera.position_sigma_mm.norm() < 60))
      throw Error({fmt::format("its focal length is known to {:.0f} px and its place to {:.0f} mm "
                               "only",
                               camera.focal_sigma_px, camera.position_sigma_mm.norm()),
                   "camera " + camera.name,
                   doubt.empty() ? "wave the wand longer, near and far, tilted towards the "
                                   "cameras and across"
                                 : doubt});
    if (camera.rms_px > 3)
      throw Error({fmt::format("the dots stray by {:.1f} px from any wand", camera.rms_px),
                   "camera " + camera.name,
                   "keep cameras still, check that the wand is stiff, wave slowly"});
  }
}

}  // namespace

WandResult calibrate_wand(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          const WandOptions& options) {
  check_leds(options.leds_m);
  if (cameras.size() < 2)
    throw Error({"has fewer than two cameras", "wall file",
                 "a wand needs two; for one: vindu calibrate intrinsics, then extrinsics"});
  const auto names = names_of(cameras);
  WandWorld world = begin_world(cameras, options.leds_m);
  auto moments =
      begin(find_views(capture, cameras, options.leds_m), names, cameras, options, world);
  refuse_other_wand(measure_wand(moments, world), options.leds_m);
  solve(moments, kinds_of(cameras), world);
  WandResult result;
  result.outliers = outliers_of(moments, world);
  if (result.outliers > kMostOutliers)
    throw Error({fmt::format("{:.0f} % of its dots fit no place of it", 100 * result.outliers),
                 "wand", "take other lights and shiny things away; keep the cameras still"});
  refuse_too_little(moments, coverage_of(moments, cameras), names);
  const MeasuredWand measured = measure_wand(moments, world);
  const double ratio = options.trust_wall_file ? size_ratio(world, cameras) : 1;
  refuse_other_size(ratio);
  fill_cameras(moments, cameras, world, result);
  fill_lengths(measured, options.leds_m.back(), result);
  refuse_weak(result);
  for (std::string& doubt : doubts_of(result, ratio)) result.remarks.push_back(std::move(doubt));
  result.poses = static_cast<int>(std::ranges::count_if(
      moments, [](const WandMoment& moment) { return moment.used && !moment.held_out; }));
  const Rigid3 to_room = room_from_world(capture, cameras, world, result);
  for (WandCamera& camera : result.cameras)
    camera.room_from_camera = to_room * camera.room_from_camera;
  return result;
}

}  // namespace vindu
