// What core's tests say about points, rotations and transforms. Every matcher asks for a distance
// that is at most a tolerance, so that NaN never matches.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/rigid3.h"

namespace vindu::testing {

/// Angle of the rotation between two orientations; radians. Well conditioned for small angles,
/// where the arc cosine of a dot product is not.
inline double angle_between_rad(const Quat& a, const Quat& b) {
  const Quat turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

MATCHER_P2(IsNearPoint, expected, tolerance_m, "") {
  const Vec3 wanted = expected;
  const double distance_m = (Vec3(arg) - wanted).norm();
  *result_listener << "which is " << distance_m << " m away from " << wanted.transpose();
  return distance_m <= tolerance_m;
}

MATCHER_P2(IsNearRotation, expected, tolerance_rad, "") {
  const double angle_rad = angle_between_rad(Quat(arg), Quat(expected));
  *result_listener << "which is turned by " << angle_rad << " rad";
  return angle_rad <= tolerance_rad;
}

/// Translation in metres and rotation in radians, one tolerance for both.
MATCHER_P2(IsNearRigid, expected, tolerance, "") {
  const double distance_m = (arg.translation - expected.translation).norm();
  const double angle_rad = angle_between_rad(arg.rotation, expected.rotation);
  *result_listener << "which is " << distance_m << " m and " << angle_rad << " rad away";
  return distance_m <= tolerance && angle_rad <= tolerance;
}

/// Largest difference of two matrices' elements.
MATCHER_P2(IsNearMatrix, expected, tolerance, "") {
  const double difference = (arg - expected).cwiseAbs().maxCoeff();
  *result_listener << "which differs by " << difference;
  return !arg.hasNaN() && difference <= tolerance;
}

}  // namespace vindu::testing
