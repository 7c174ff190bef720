// The light that the helmet sends out: at each LED position a cluster of LEDs fanned around one
// direction, and a head in the way.
#pragma once

#include <vector>

#include "core/site.h"

namespace vindu {

struct LedCluster {
  Vec3 x_in_head = Vec3::Zero();
  Vec3 normal_in_head = Vec3::UnitZ();  ///< middle of the fan; length 1
};

/// A cluster is nine LEDs of +-25 degrees (thesis 1.5) whose axes are fanned up to 70 degrees from
/// the normal: equally bright up to there, then falling to nothing at 95 (the thesis: "a viewing
/// angle of more than 180 degrees").
constexpr double kFan_rad = radians(70);
constexpr double kLedHalfAngle_rad = radians(25);

/// Brightness over the one straight ahead; `angle_rad` is from the cluster's normal.
double emission(double angle_rad);

/// The head as an ellipsoid with axes along those of head.
struct HeadShape {
  Vec3 centre_in_head;
  Vec3 half_axes_m;
};

/// Reentrant; immutable once made.
class Helmet {
 public:
  /// A cluster points away from the head's middle, level, but more backwards than aside (one that
  /// sits in front of the middle: forwards). The head fills 156 x 240 x 196 mm behind the eyes
  /// (breadth and length of a median adult's; height with the neck), less where LEDs sit deeper.
  explicit Helmet(const HeadConfig& head);

  const std::vector<LedCluster>& clusters() const { return clusters_; }
  const HeadShape& shape() const { return shape_; }

  /// Whether the head stands between a cluster and a point.
  bool hidden(const LedCluster& cluster, const Vec3& viewer_in_head) const;

  /// Brightness of a cluster, 1 straight ahead at 1 m; 0 when it cannot be seen.
  double brightness(const LedCluster& cluster, const Vec3& viewer_in_head) const;

 private:
  HeadShape shape_;
  std::vector<LedCluster> clusters_;
};

}  // namespace vindu
