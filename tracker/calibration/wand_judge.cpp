#include "tracker/calibration/wand_judge.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "tracker/calibration/median.h"
#include "tracker/camera_model.h"

namespace vindu {
namespace {

constexpr int kFewestMoments = 60;
constexpr double kLeastCoverage = 0.35;

/// A point by least squares of its pixels in all views that have this LED, and its covariance.
struct SolvedPoint {
  Vec3 x_in_world = Vec3::Zero();
  Mat3 covariance = Mat3::Identity();
};

std::optional<SolvedPoint> solve_point(const std::vector<CameraModel>& models,
                                       const WandWorld& world, const WandMoment& moment,
                                       std::size_t led, const Vec3& start_in_world) {
  SolvedPoint point{start_in_world};
  int views = 0;
  for (int round = 0; round < 5; ++round) {
    Mat3 normal = Mat3::Zero();
    Vec3 gradient = Vec3::Zero();
    views = 0;
    for (const WandView& view : moment.views) {
      if (!view.used[led]) continue;
      const auto index = static_cast<std::size_t>(view.camera);
      const Rigid3& camera_from_world = models[index].camera_from_room();
      const auto seen = models[index].project_with_jacobian(camera_from_world * point.x_in_world);
      if (!seen) return std::nullopt;
      const double late_s = moment.t_s - view.t_s + 1e-3 * world.cameras[index].lag_ms;
      const Vec2 off_px = view.dots_px[led] + late_s * view.speed_px_s[led] - seen->raw_px;
      const Eigen::Matrix<double, 2, 3> slope = seen->d_raw_d_x_in_camera *
                                                camera_from_world.rotation.toRotationMatrix() /
                                                sigma_px(world.cameras[index], view, led);
      normal += slope.transpose() * slope;
      gradient += slope.transpose() * off_px / sigma_px(world.cameras[index], view, led);
      ++views;
    }
    if (views < 2) return std::nullopt;
    point.covariance = normal.inverse();
    point.x_in_world += point.covariance * gradient;
  }
  if (!point.x_in_world.allFinite()) return std::nullopt;
  return point;
}

std::vector<CameraModel> models_of(const WandWorld& world) {
  std::vector<CameraModel> models;
  for (const AdjustedCamera& camera : world.cameras) {
    CameraConfig config;
    config.source = CameraSource::video;  // dots are image coordinates here
    config.intrinsics = intrinsics_of(camera.lens);
    config.room_from_camera = camera.world_from_camera;
    models.emplace_back(config);
  }
  return models;
}

std::vector<SolvedPoint> solve_wand(const std::vector<CameraModel>& models, const WandWorld& world,
                                    const WandMoment& moment, const WandPose& pose) {
  std::vector<SolvedPoint> points;
  for (std::size_t led = 0; led < world.leds_m.size(); ++led) {
    const auto point = solve_point(models, world, moment, led,
                                   pose.head<3>() + world.leds_m[led] * pose.tail<3>());
    if (!point) return {};
    points.push_back(*point);
  }
  return points;
}

}  // namespace

void Coverage::add(const Vec2& image_px, const Vec2& size_px) {
  const auto cell = [](double share, int cells) {
    return std::clamp(static_cast<int>(share * cells), 0, cells - 1);
  };
  const int row = cell(image_px.y() / size_px.y(), kRows),
            column = cell(image_px.x() / size_px.x(), kColumns);
  ++dots[static_cast<std::size_t>(row) * kColumns + static_cast<std::size_t>(column)];
}

double Coverage::share() const {
  return static_cast<double>(std::ranges::count_if(dots, [](int count) { return count > 0; })) /
         static_cast<double>(dots.size());
}

void check_leds(const std::vector<double>& leds_m) {
  const auto falls = [](double a, double b) { return !(a < b); };  // or is no number
  const bool rising = std::ranges::adjacent_find(leds_m, falls) == leds_m.end();
  if (leds_m.size() < 2 || leds_m.size() > 3 || leds_m.front() != 0 || !rising ||
      !(leds_m.back() >= 0.05 && leds_m.back() <= 5))
    throw Error({"needs two or three LEDs, rising from 0 to a length of 0.05 to 5 m", "wand",
                 "give their places along it: 0,500 or 0,150,500 (mm)"});
  if (leds_m.size() == 3 && std::abs(leds_m[1] / leds_m[2] - 0.5) < 0.1)
    throw Error({"its middle LED stands halfway, so that its ends look alike", "wand",
                 "move the middle LED towards one end, to about a third"});
}

std::vector<Coverage> coverage_of(const std::vector<WandMoment>& moments,
                                  const std::vector<CameraConfig>& cameras) {
  std::vector<Coverage> coverage(cameras.size());
  for (const WandMoment& moment : moments) {
    if (!moment.used) continue;
    for (const WandView& view : moment.views) {
      const CameraConfig& camera = cameras[static_cast<std::size_t>(view.camera)];
      for (const Vec2& dot : view.dots_px)
        coverage[static_cast<std::size_t>(view.camera)].add(dot, picture_size_px(camera));
    }
  }
  return coverage;
}

MeasuredWand measure_wand(const std::vector<WandMoment>& moments, const WandWorld& world) {
  const auto models = models_of(world);
  MeasuredWand measured;
  std::vector<double> places;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (!moments[i].used) continue;
    const auto points = solve_wand(models, world, moments[i], world.poses[i]);
    if (points.empty()) continue;
    const Vec3 way_m = points.back().x_in_world - points.front().x_in_world;
    const double length_m = way_m.norm();
    if (points.size() == 3)
      places.push_back((points[1].x_in_world - points[0].x_in_world).dot(way_m) /
                       way_m.squaredNorm());
    if (!moments[i].held_out) continue;
    const Vec3 along = way_m / length_m;
    measured.outer_m.push_back(length_m);
    measured.predicted_sigma_m.push_back(
        std::sqrt(along.dot((points.front().covariance + points.back().covariance) * along)));
  }
  if (places.empty()) return measured;
  measured.place = median(places);
  std::vector<double> off;
  for (const double place : places) off.push_back(std::abs(place - measured.place));
  measured.place_sigma =
      1.25 * 1.4826 * median(off) / std::sqrt(static_cast<double>(places.size()));
  return measured;
}

void refuse_too_little(const std::vector<WandMoment>& moments,
                       const std::vector<Coverage>& coverage,
                       const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::ranges::none_of(coverage[i].dots, [](int count) { return count > 0; }))
      throw Error({"never sees the wand together with another camera", "camera " + names[i],
                   "wave it where this camera's view overlaps with others'"});
  const auto used = std::ranges::count_if(moments, &WandMoment::used);
  if (used < kFewestMoments)
    throw Error({fmt::format("was seen by two cameras at once at {} moments only", used), "wand",
                 fmt::format("wave it longer where views overlap: {} are needed, 500 are good",
                             kFewestMoments)});
  for (std::size_t i = 0; i < names.size(); ++i)
    if (coverage[i].share() < kLeastCoverage)
      throw Error(
          {fmt::format("saw the wand in {:.0f} % of its picture only", 100 * coverage[i].share()),
           "camera " + names[i],
           fmt::format("wave it through all of its view, corners too: {:.0f} % are needed",
                       100 * kLeastCoverage)});
}

void refuse_other_wand(const MeasuredWand& measured, const std::vector<double>& leds_m) {
  if (leds_m.size() < 3) return;
  const double said = leds_m[1] / leds_m[2];
  const double off = std::abs(measured.place - said);
  if (off < 0.01 + 4 * measured.place_sigma) return;
  throw Error({fmt::format("its middle LED stands at {:.1f} % of its length, not at {:.1f} %",
                           100 * measured.place, 100 * said),
               "wand", "measure its LEDs again and give their places along it"});
}

double size_ratio(const WandWorld& world, const std::vector<CameraConfig>& cameras) {
  double found_m = 0, said_m = 0;
  for (std::size_t a = 0; a < cameras.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      found_m += (world.cameras[a].world_from_camera.translation -
                  world.cameras[b].world_from_camera.translation)
                     .norm();
      said_m += (cameras[a].room_from_camera.translation - cameras[b].room_from_camera.translation)
                    .norm();
    }
  return said_m > 0.1 ? found_m / said_m : 1;
}

void refuse_other_size(double ratio) {
  if (ratio > 0.8 && ratio < 1.25) return;
  throw Error(
      {fmt::format("makes the cameras stand {:.2f} times as far apart as the wall file says",
                   ratio),
       "wand",
       "measure the wand and the cameras' position_m again, or say --ignore-places where "
       "those are guesses"});
}

std::string scatter_doubt(const WandResult& result) {
  constexpr double kUsualScatter = 1.4;
  const double scatter = result.length_rms_mm / result.predicted_length_rms_mm;
  if (!(scatter > kUsualScatter)) return "";
  return fmt::format(
      "the wand's length scatters by {:.1f} times what its dots' noise makes; if a camera moved "
      "meanwhile, or the wand bends, wave again",
      scatter);
}

std::vector<std::string> doubts_of(const WandResult& result, double size_ratio) {
  constexpr double kUsualSize = 0.05;
  std::vector<std::string> doubts;
  if (std::abs(size_ratio - 1) > kUsualSize)
    doubts.push_back(
        fmt::format("the cameras stand {:.2f} times as far apart as the wall file says; if "
                    "its position_m are good, measure the wand again",
                    size_ratio));
  if (const std::string doubt = scatter_doubt(result); !doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

}  // namespace vindu
