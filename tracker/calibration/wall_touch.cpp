#include "tracker/calibration/wall_touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "tracker/camera_model.h"
#include "tracker/point_fit.h"

namespace vindu {
namespace {

constexpr double kStill_s = 0.8;
constexpr double kStill_px = 4;       // that a held LED may wander
constexpr double kElsewhere_m = 0.1;  // the next touch
constexpr double kNow_s = 0.3;        // what cameras saw within it, they see now
constexpr double kWidestGap_mm = 200;

int cameras_that_see(const Site& site, const Vec3& x_in_wall) {
  return static_cast<int>(std::ranges::count_if(site.cameras, [&](const CameraConfig& camera) {
    const CameraModel model(camera);
    const auto raw_px =
        model.project(model.camera_from_room() * (site.wall.room_from_wall * x_in_wall));
    constexpr double kEdge_px = 30;
    return raw_px && raw_px->minCoeff() > kEdge_px &&
           (picture_size_px(camera) - *raw_px).minCoeff() > kEdge_px;
  }));
}

std::vector<WallTarget> seen_corners(const Site& site) {
  std::vector<WallTarget> corners;
  for (const Tile& tile : site.wall.tiles)
    for (const auto& [name, place] : {std::pair("lower left", tile.corners.lower_left_in_wall),
                                      std::pair("lower right", tile.corners.lower_right_in_wall),
                                      std::pair("upper left", tile.corners.upper_left_in_wall),
                                      std::pair("upper right", tile.corners.upper_right_in_wall())})
      if (cameras_that_see(site, place) >= 2)
        corners.push_back({fmt::format("{} corner of {}", name, tile.name), tile.name, place});
  return corners;
}

/// A stretch of one camera's pictures in which its only dot stands still.
struct Still {
  double begin_s = 0, end_s = 0;
  Vec2 raw_px = Vec2::Zero();  // mean
  int count = 0;
};

std::vector<Still> stretches_of(const Capture& capture, int camera) {
  std::vector<Still> stretches;
  for (const Observation& seen : capture.observations) {
    if (seen.camera != camera || seen.dots.size() != 1) continue;
    const double t_s = seconds(seen.arrival.time_since_epoch());
    const Vec2 dot(seen.dots[0].x_px, seen.dots[0].y_px);
    const bool goes_on = !stretches.empty() && t_s - stretches.back().end_s < kNow_s &&
                         (dot - stretches.back().raw_px).norm() < kStill_px;
    if (!goes_on) stretches.push_back({t_s, t_s, dot, 0});
    Still& still = stretches.back();
    still.end_s = t_s;
    still.raw_px += (dot - still.raw_px) / ++still.count;
  }
  return stretches;
}

std::vector<Still> still_stretches(const Capture& capture, int camera) {
  auto stretches = stretches_of(capture, camera);
  std::erase_if(stretches, [](const Still& s) { return s.end_s - s.begin_s < kStill_s; });
  return stretches;
}

/// The point nearest to all rays, and the rms of their distances.
Touch meet(const std::vector<Ray>& rays) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Ray& ray : rays) {
    const Mat3 across =
        Mat3::Identity() - ray.direction_in_room * ray.direction_in_room.transpose();
    normal += across;
    right += across * ray.origin_in_room;
  }
  Touch touch{normal.inverse() * right};
  double sum2 = 0;
  for (const Ray& ray : rays)
    sum2 += ray.direction_in_room.cross(touch.x_in_room - ray.origin_in_room).squaredNorm();
  touch.gap_mm = 2e3 * std::sqrt(sum2 / static_cast<double>(rays.size()));
  return touch;
}

/// What the cameras see at the end of a capture.
struct Now {
  std::optional<Touch> touch;  // of two cameras or more that see one dot stand still
  double still_s = 0;          // for so long
  std::string remark;          // where they cannot see a touch; ""
};

/// How many dots most of a camera's newest pictures show: none, one, or 2 for several.
int lights_now(const Capture& capture, int camera, Time end) {
  std::array<int, 3> pictures{};
  for (auto newest = capture.observations.rbegin(); newest != capture.observations.rend();
       ++newest) {
    const Observation& seen = *newest;
    if (end - seen.arrival > from_seconds(2 * kNow_s)) break;
    if (seen.camera == camera && end - seen.arrival < from_seconds(kNow_s))
      ++pictures[std::min<std::size_t>(seen.dots.size(), 2)];
  }
  return static_cast<int>(std::ranges::max_element(pictures) - pictures.begin());
}

std::string lights_remark(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          Time end) {
  std::vector<std::string> seeing;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const int lights = lights_now(capture, static_cast<int>(i), end);
    if (lights > 1)
      return fmt::format("{} sees several lights: show it the LED alone", cameras[i].name);
    if (lights == 1) seeing.push_back(cameras[i].name);
  }
  if (seeing.size() == 1) return fmt::format("only {} sees the LED: do not hide it", seeing[0]);
  return "";
}

Now seen_now(const Capture& capture, const std::vector<CameraConfig>& cameras) {
  Now now;
  if (capture.observations.empty()) return now;
  Time end{};
  for (const Observation& seen : capture.observations) end = std::max(end, seen.arrival);
  now.remark = lights_remark(capture, cameras, end);
  const double end_s = seconds(end.time_since_epoch());
  std::vector<Ray> rays;
  double begin_s = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto stretches = stretches_of(capture, static_cast<int>(i));
    if (stretches.empty() || end_s - stretches.back().end_s > kNow_s) continue;
    rays.push_back(CameraModel(cameras[i]).ray_through(stretches.back().raw_px));
    begin_s = std::max(begin_s, stretches.back().begin_s);
  }
  if (rays.size() < 2 || !now.remark.empty()) return now;
  now.still_s = end_s - begin_s;
  now.touch = meet(rays);
  if (now.touch->gap_mm < kWidestGap_mm || now.still_s < kNow_s) return now;
  now.remark = fmt::format("the cameras disagree by {:.0f} mm: calibrate them by a wand first",
                           now.touch->gap_mm);
  now.touch.reset();
  return now;
}

/// Why a touch cannot be of the next target, by its distances from those before; "" where it can.
std::string misplaced(const Touch& touch, const std::vector<Touch>& before,
                      const std::vector<WallTarget>& targets) {
  const std::size_t next = before.size();
  for (std::size_t i = 0; i < next; ++i) {
    const double seen_m = (touch.x_in_room - before[i].x_in_room).norm();
    const double there_m = (targets[next].x_in_wall - targets[i].x_in_wall).norm();
    if (std::abs(seen_m - there_m) > 0.06 + 0.03 * there_m)
      return fmt::format("that was {:.2f} m from point {}, but point {} is {:.2f} m from it",
                         seen_m, i + 1, next + 1, there_m);
  }
  return "";
}

}  // namespace

std::vector<WallTarget> choose_targets(const Site& site, int count) {
  const auto corners = seen_corners(site);
  std::vector<WallTarget> chosen;
  if (corners.empty()) return chosen;
  chosen.push_back(*std::ranges::max_element(
      corners, {}, [](const WallTarget& corner) { return corner.x_in_wall.norm(); }));
  while (static_cast<int>(chosen.size()) < count) {
    const auto farthest = std::ranges::max_element(corners, {}, [&](const WallTarget& corner) {
      double nearest_m = 1e300;
      for (const WallTarget& other : chosen)
        nearest_m = std::min(nearest_m, (corner.x_in_wall - other.x_in_wall).norm());
      return nearest_m;
    });
    const bool again = std::ranges::any_of(chosen, [&](const WallTarget& other) {
      return (other.x_in_wall - farthest->x_in_wall).norm() < kElsewhere_m;
    });
    if (again) break;
    chosen.push_back(*farthest);
  }
  return chosen;
}

std::vector<Touch> find_touches(const Capture& capture, const std::vector<CameraConfig>& cameras) {
  std::vector<std::vector<Still>> stretches;
  std::vector<CameraModel> models;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    stretches.push_back(still_stretches(capture, static_cast<int>(i)));
    models.emplace_back(cameras[i]);
  }
  std::vector<Touch> touches;
  for (std::size_t first = 0; first < cameras.size(); ++first)
    for (const Still& still : stretches[first]) {
      std::vector<Ray> rays{models[first].ray_through(still.raw_px)};
      for (std::size_t other = first + 1; other < cameras.size(); ++other)
        for (const Still& at_once : stretches[other])
          if (std::min(still.end_s, at_once.end_s) - std::max(still.begin_s, at_once.begin_s) >
              0.5 * kStill_s) {
            rays.push_back(models[other].ray_through(at_once.raw_px));
            break;
          }
      if (rays.size() < 2) continue;
      Touch touch = meet(rays);
      touch.since_s = still.begin_s;
      if (touch.gap_mm < kWidestGap_mm) touches.push_back(touch);
    }
  std::ranges::sort(touches, {}, &Touch::since_s);
  std::vector<Touch> apart;
  for (const Touch& touch : touches)
    if (apart.empty() || (touch.x_in_room - apart.back().x_in_room).norm() > kElsewhere_m)
      apart.push_back(touch);
  return apart;
}

TouchProgress follow_touches(const Capture& capture, const std::vector<CameraConfig>& cameras,
                             const std::vector<WallTarget>& targets) {
  TouchProgress progress;
  const auto touches = find_touches(capture, cameras);
  for (const Touch& touch : touches) {
    if (progress.touches.size() == targets.size()) break;
    progress.remark = misplaced(touch, progress.touches, targets);
    if (progress.remark.empty()) progress.touches.push_back(touch);
  }
  if (progress.touches.size() == targets.size()) return progress;
  const Now now = seen_now(capture, cameras);
  if (!now.remark.empty()) progress.remark = now.remark;
  const bool held_before = now.touch && !touches.empty() &&
                           (now.touch->x_in_room - touches.back().x_in_room).norm() < kElsewhere_m;
  if (now.touch && !held_before) progress.held = std::min(1.0, now.still_s / kStill_s);
  return progress;
}

WallFit fit_wall(const std::vector<Touch>& touches, const std::vector<WallTarget>& targets,
                 const Rigid3& room_from_wall) {
  if (targets.size() < 3 || touches.size() != targets.size())
    throw Error({fmt::format("{} touches were seen, of {} points", touches.size(), targets.size()),
                 "wall",
                 "hold the only LED still for a second at each point, in their order; at "
                 "least three points, each seen by two cameras that a wand has calibrated"});
  std::vector<Vec3> there, seen;
  double length = 0, length_seen = 0;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    there.push_back(room_from_wall * targets[i].x_in_wall);
    seen.push_back(touches[i].x_in_room);
    for (std::size_t k = 0; k < i; ++k) {
      length += (there[i] - there[k]).norm();
      length_seen += (seen[i] - seen[k]).norm();
    }
  }
  double widest = 0;
  for (const Vec3& point : there)
    widest = std::max(widest, (point - there[0]).cross(there[1] - there[0]).norm());
  if (widest < 0.1 * (there[1] - there[0]).norm())
    throw Error({"the points stand on one line", "wall", "choose more points: --targets 6"});
  const PointFit fit = fit_points(there, seen);
  WallFit result;
  result.room_from_before = Rigid3::from(fit.rotation, fit.translation);
  result.rms_mm = 1e3 * fit.rms;
  result.targets_in_room = there;
  result.scale = length / length_seen;
  for (std::size_t i = 0; i < there.size(); ++i)
    result.residuals_mm.push_back(1e3 * (result.room_from_before * seen[i] - there[i]).norm());
  if (result.rms_mm > 40)
    throw Error(
        {fmt::format("the touches are {:.0f} mm rms from where these points are", result.rms_mm),
         "wall",
         "touch them in the order given; where the cameras have no wand "
         "calibration, make one first"});
  return result;
}

}  // namespace vindu
