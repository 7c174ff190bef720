// The motion that lays points upon others, and the turn that lays a direction upon another.
#pragma once

#include <span>

#include "core/rigid3.h"

namespace vindu {

struct PointFit {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
  double rms = 0;  ///< of the distances that are left, in the points' unit
};

/// x_in_a = rotation * x_in_b + translation for as many points, at least one, by least squares
/// (Kabsch 1976); `mirrored`: the best with a reflection. Of points in a line the turn about it is
/// arbitrary.
PointFit fit_points(std::span<const Vec3> in_a, std::span<const Vec3> in_b, bool mirrored = false);

/// How far off a point is to be expected, rms, that moves by such a fit of three points or more
/// which left `rms` over: the target registration error (Fitzpatrick, West & Maurer 1998, equations
/// 10 and 46). In the points' unit.
double expected_error(std::span<const Vec3> fitted, double rms, const Vec3& point);

/// The least rotation that turns one direction into another; of opposite ones some half turn. Their
/// lengths do not count, but must not be 0.
Quat least_turn(const Vec3& from, const Vec3& to);

}  // namespace vindu
