#include "simulator/helmet.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

HeadShape shape_of(const HeadConfig& head) {
  HeadShape shape{head.eye_in_head + Vec3(0, 0.01, 0.09), {0.078, 0.120, 0.098}};
  double nearest = 1;  // of the LEDs, in half axes from the centre
  for (const Vec3& led : head.leds_in_head)
    nearest =
        std::min(nearest, (led - shape.centre_in_head).cwiseQuotient(shape.half_axes_m).norm());
  shape.half_axes_m *= 0.98 * nearest;
  return shape;
}

Vec3 normal_of(const Vec3& led_in_head, const Vec3& centre_in_head) {
  constexpr double kAbove_m = 0.01;
  constexpr double kInFront_m = 0.02;
  const Vec3 outwards_m = led_in_head - centre_in_head;
  const Vec3 level_m(outwards_m.x(), 0, outwards_m.z());
  if (level_m.norm() < kAbove_m) return Vec3::UnitY();  // on top of the head
  const double back = outwards_m.z() < -kInFront_m ? -1 : 1;
  return (level_m.normalized() + Vec3(0, 0, 2 * back)).normalized();
}

}  // namespace

double emission(double angle_rad) {
  const double beyond_fan = std::max(0.0, angle_rad - kFan_rad) / kLedHalfAngle_rad;
  if (beyond_fan >= 1) return 0;
  const double cosine = std::cos(kPi / 2 * beyond_fan);
  return cosine * cosine;
}

Helmet::Helmet(const HeadConfig& head) : shape_(shape_of(head)) {
  for (const Vec3& led : head.leds_in_head)
    clusters_.push_back({led, normal_of(led, shape_.centre_in_head)});
}

// In units of the half axes the head is the unit sphere: does the segment pass nearer than 1?
bool Helmet::hidden(const LedCluster& cluster, const Vec3& viewer_in_head) const {
  const Vec3 from = (cluster.x_in_head - shape_.centre_in_head).cwiseQuotient(shape_.half_axes_m);
  const Vec3 way = (viewer_in_head - cluster.x_in_head).cwiseQuotient(shape_.half_axes_m);
  const double nearest = std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (from + nearest * way).squaredNorm() < 1;
}

double Helmet::brightness(const LedCluster& cluster, const Vec3& viewer_in_head) const {
  const Vec3 way_m = viewer_in_head - cluster.x_in_head;
  const double distance_m = way_m.norm();
  if (!(distance_m > 0) || hidden(cluster, viewer_in_head)) return 0;
  const double cosine = std::clamp(cluster.normal_in_head.dot(way_m) / distance_m, -1.0, 1.0);
  return emission(std::acos(cosine)) / (distance_m * distance_m);
}

}  // namespace vindu
