#include "tracker/joint/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracker/point_fit.h"
#include "tracker/triangulation.h"

namespace vindu {
namespace {

constexpr double kLargestGap_rad = 8.0 / 1335;  // eight pixels of a Wiimote
constexpr double kMotion_m = 0.01;              // of a head between two cameras' pictures
constexpr std::size_t kDotsForOne = 6;          // of one camera: their triples are tried

struct MetPoint {
  std::size_t dot_a = 0, dot_b = 0;
  Vec3 x_in_room = Vec3::Zero();
  double sigma_m = 0;  // along the rays, where it is largest
};

struct Match {
  std::vector<std::pair<std::size_t, std::size_t>> led_point;
  double mismatch_m2 = 0;  // of distances, per pair
};

std::vector<Ray> rays_of(const CameraModel& camera, const CameraView& view) {
  std::vector<Ray> rays;
  for (const Vec2& dot_px : view.dots_px) rays.push_back(camera.ray_through(dot_px));
  return rays;
}

// Rays that cross at an angle alpha leave depth uncertain by D sigma / (sqrt 2 sin(alpha / 2)).
std::vector<MetPoint> meeting_points(const CameraModel& camera_a, const CameraView& a,
                                     const CameraModel& camera_b, const CameraView& b) {
  const std::vector<Ray> rays_a = rays_of(camera_a, a), rays_b = rays_of(camera_b, b);
  std::vector<MetPoint> points;
  for (std::size_t i = 0; i < rays_a.size(); ++i)
    for (std::size_t j = 0; j < rays_b.size(); ++j) {
      const Ray &ray_a = rays_a[i], &ray_b = rays_b[j];
      const auto met = triangulate(ray_a, ray_b);
      if (!met) continue;
      const double distance_m = (met->x_in_room - ray_a.origin_in_room).norm();
      if (met->gap_m > kLargestGap_rad * distance_m + kMotion_m) continue;
      const double half_sine = std::sqrt(
          std::max(1e-6, 0.5 * (1 - ray_a.direction_in_room.dot(ray_b.direction_in_room))));
      const double ray_sigma_m = distance_m * std::max(a.sigma_px, b.sigma_px) / 1335;
      points.push_back({i, j, met->x_in_room, ray_sigma_m / (std::sqrt(2.0) * half_sine)});
    }
  return points;
}

/// All sets of pairs LED - point whose distances agree, each dot used once.
class Matcher {
 public:
  Matcher(std::span<const Vec3> leds, const std::vector<MetPoint>& points, std::size_t least)
      : leds_(leds), points_(points), least_(least), gaps_(points.size() * points.size()) {
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = 0; b < points.size(); ++b) gaps_[a * points.size() + b] = gap(a, b);
  }

  std::vector<Match> matches() {
    extend(0);
    std::ranges::sort(found_, [](const Match& a, const Match& b) {
      return a.led_point.size() != b.led_point.size() ? a.led_point.size() > b.led_point.size()
                                                      : a.mismatch_m2 < b.mismatch_m2;
    });
    return std::move(found_);
  }

 private:
  static constexpr std::size_t kMost = 4000;  // matches; beyond, the picture is full of false dots

  void extend(std::size_t led) {
    if (found_.size() >= kMost) return;
    if (current_.led_point.size() + leds_.size() - led < least_) return;
    if (led == leds_.size()) return found_.push_back(current_);
    for (std::size_t point = 0; point < points_.size(); ++point) {
      const auto mismatch_m2 = mismatch(led, point);
      if (!mismatch_m2) continue;
      current_.led_point.emplace_back(led, point);
      current_.mismatch_m2 += *mismatch_m2;
      extend(led + 1);
      current_.mismatch_m2 -= *mismatch_m2;
      current_.led_point.pop_back();
    }
    extend(led + 1);
  }

  std::optional<double> mismatch(std::size_t led, std::size_t point) const {
    double sum_m2 = 0;
    for (const auto& [other_led, other] : current_.led_point) {
      const Gap& between = gaps_[point * points_.size() + other];
      const double error_m = between.length_m - (leds_[led] - leds_[other_led]).norm();
      if (std::abs(error_m) > between.tolerance_m) return std::nullopt;
      sum_m2 += error_m * error_m;
    }
    return sum_m2;
  }

  /// Between two points; nothing may be so long where both cannot be there.
  struct Gap {
    double length_m = 0;
    double tolerance_m = -1;
  };
  Gap gap(std::size_t a, std::size_t b) const {
    const MetPoint &p = points_[a], &q = points_[b];
    if (p.dot_a == q.dot_a || p.dot_b == q.dot_b) return {};
    const double sigma_m = std::sqrt(p.sigma_m * p.sigma_m + q.sigma_m * q.sigma_m);
    return {(p.x_in_room - q.x_in_room).norm(), kMotion_m + 3 * sigma_m};
  }

  std::span<const Vec3> leds_;
  const std::vector<MetPoint>& points_;
  std::size_t least_;
  std::vector<Gap> gaps_;  // of each two points
  Match current_;
  std::vector<Match> found_;
};

bool upright(const Rigid3& room_from_head, double steepest_rad) {
  return room_from_head.rotation.angularDistance(Quat::Identity()) < steepest_rad;
}

/// Of two LEDs: the least turn from facing the wall that points from one to the other.
Rigid3 pose_of(const Match& match, std::span<const Vec3> leds,
               const std::vector<MetPoint>& points) {
  std::vector<Vec3> in_head, in_room;
  for (const auto& [led, point] : match.led_point) {
    in_head.push_back(leds[led]);
    in_room.push_back(points[point].x_in_room);
  }
  if (in_head.size() != 2) {
    const PointFit fit = fit_points(in_room, in_head);
    return Rigid3::from(fit.rotation, fit.translation);
  }
  const Quat rotation = least_turn(in_head[1] - in_head[0], in_room[1] - in_room[0]);
  const Vec3 middle_in_head = 0.5 * (in_head[0] + in_head[1]);
  return {rotation, 0.5 * (in_room[0] + in_room[1]) - rotation * middle_in_head};
}

/// A camera turned to a direction: what it sees there has no perspective.
struct Gaze {
  Vec3 eye_in_room;
  Quat room_from_gaze;  // z: the direction

  Vec2 seen(const Ray& ray) const {
    const Vec3 direction = room_from_gaze.conjugate() * ray.direction_in_room;
    return direction.head<2>() / direction.z();
  }
  /// A point that is seen there, so far away.
  Vec3 in_room(const Vec2& seen, double scale, double depth_m) const {
    const Vec3 in_gaze(seen.x() / scale, seen.y() / scale, 1 / scale + depth_m);
    return eye_in_room + room_from_gaze * in_gaze;
  }
};

/// The upright ones of the two poses in which three LEDs are seen in three dots, as far as the head
/// is small beside its distance (weak perspective: Alter, "3-D pose from 3 points using weak
/// perspective", 1994). Unlike those of P3P they are always there: noise does not take them away
/// where they nearly meet. None of LEDs in a line.
void add_poses_of_three(const std::array<Ray, 3>& rays, const std::array<Vec3, 3>& leds,
                        double steepest_rad, std::vector<Rigid3>& poses) {
  Vec3 mean = Vec3::Zero();
  for (const Ray& ray : rays) mean += ray.direction_in_room;
  const Gaze gaze = {rays[0].origin_in_room, least_turn(Vec3::UnitZ(), mean)};
  std::array<Vec2, 3> dots;
  for (std::size_t i = 0; i < 3; ++i) dots[i] = gaze.seen(rays[i]);
  const double r01 = (leds[1] - leds[0]).squaredNorm(), r02 = (leds[2] - leds[0]).squaredNorm(),
               r12 = (leds[2] - leds[1]).squaredNorm();
  const double d01 = (dots[1] - dots[0]).squaredNorm(), d02 = (dots[2] - dots[0]).squaredNorm(),
               d12 = (dots[2] - dots[1]).squaredNorm();
  // 16 times the squares of the triangles' areas, and what stands between them.
  const double a = 4 * r01 * r02 - (r01 + r02 - r12) * (r01 + r02 - r12);
  const double c = 4 * d01 * d02 - (d01 + d02 - d12) * (d01 + d02 - d12);
  const double b = d01 * (-r01 + r02 + r12) + d02 * (r01 - r02 + r12) + d12 * (r01 + r02 - r12);
  if (a < 1e-4 * r01 * r02) return;
  const double scale2 = (b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
  if (!(scale2 > 0)) return;
  const double scale = std::sqrt(scale2);
  const double h1 = std::sqrt(std::max(0.0, scale2 * r01 - d01)) / scale;
  const bool alike = d01 + d02 - d12 <= scale2 * (r01 + r02 - r12);
  const double h2 = (alike ? 1 : -1) * std::sqrt(std::max(0.0, scale2 * r02 - d02)) / scale;
  for (const double sign : {1.0, -1.0}) {
    const std::array<Vec3, 3> in_room = {gaze.in_room(dots[0], scale, 0),
                                         gaze.in_room(dots[1], scale, sign * h1),
                                         gaze.in_room(dots[2], scale, sign * h2)};
    const PointFit fit = fit_points(in_room, leds);
    const Rigid3 pose = Rigid3::from(fit.rotation, fit.translation);
    if (upright(pose, steepest_rad)) poses.push_back(pose);
  }
}

/// Three dots, and the LED that each of them may be.
struct Three {
  std::array<std::size_t, 3> dots, leds;
};

std::vector<Three> threes_of(std::size_t dots, std::size_t leds) {
  std::vector<Three> threes;
  for (std::size_t a = 0; a < dots; ++a)
    for (std::size_t b = a + 1; b < dots; ++b)
      for (std::size_t c = b + 1; c < dots; ++c)
        for (std::size_t i = 0; i < leds; ++i)
          for (std::size_t j = 0; j < leds; ++j)
            for (std::size_t k = 0; k < leds; ++k)
              if (i != j && j != k && k != i) threes.push_back({{a, b, c}, {i, j, k}});
  return threes;
}

}  // namespace

RoughPoses candidates_from_pair(std::span<const CameraModel> cameras, const CameraView& a,
                                const CameraView& b, std::span<const Vec3> leds_in_head,
                                std::size_t least_leds, std::size_t kept, double steepest_rad) {
  auto points = meeting_points(cameras[static_cast<std::size_t>(a.camera)], a,
                               cameras[static_cast<std::size_t>(b.camera)], b);
  auto matches = Matcher(leds_in_head, points, least_leds).matches();
  return [=, points = std::move(points), matches = std::move(matches), left = kept,
          next = std::size_t{0}]() mutable -> std::optional<std::vector<Rigid3>> {
    while (left > 0 && next < matches.size()) {
      const Rigid3 pose = pose_of(matches[next++], leds_in_head, points);
      if (!upright(pose, steepest_rad)) continue;
      --left;
      return std::vector{pose};
    }
    return std::nullopt;
  };
}

RoughPoses candidates_from_one(std::span<const CameraModel> cameras, const CameraView& view,
                               std::span<const Vec3> leds_in_head, double steepest_rad) {
  auto rays = rays_of(cameras[static_cast<std::size_t>(view.camera)], view);
  auto threes = threes_of(std::min(rays.size(), kDotsForOne), leds_in_head.size());
  return [leds_in_head, steepest_rad, rays = std::move(rays), threes = std::move(threes),
          next = std::size_t{0}]() mutable -> std::optional<std::vector<Rigid3>> {
    if (next == threes.size()) return std::nullopt;
    const auto& [dots, leds] = threes[next++];
    std::vector<Rigid3> poses;
    add_poses_of_three({rays[dots[0]], rays[dots[1]], rays[dots[2]]},
                       {leds_in_head[leds[0]], leds_in_head[leds[1]], leds_in_head[leds[2]]},
                       steepest_rad, poses);
    return poses;
  };
}

std::size_t candidates_from_one(std::size_t dots, std::size_t leds) {
  const std::size_t used = std::min(dots, kDotsForOne);
  return used < 3 || leds < 3 ? 0
                              : used * (used - 1) * (used - 2) / 6 * leds * (leds - 1) * (leds - 2);
}

}  // namespace vindu
