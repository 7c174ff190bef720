// The point that two rays have in common, or nearly so: measured rays pass each other (thesis
// 3.2.1).
#pragma once

#include <optional>

#include "core/rigid3.h"

namespace vindu {

/// Half-line from a camera's centre through a dot; direction has length 1.
struct Ray {
  Vec3 origin_in_room = Vec3::Zero();
  Vec3 direction_in_room = Vec3::UnitZ();
};

struct TriangulatedPoint {
  Vec3 x_in_room = Vec3::Zero();  ///< middle of the shortest segment between the rays
  double gap_m = 0;  ///< that segment's length: the error which the thesis emits (4.3.1)
};

/// Empty when the rays are parallel (closer than a microradian) or would meet behind an origin.
std::optional<TriangulatedPoint> triangulate(const Ray& a, const Ray& b);

}  // namespace vindu
