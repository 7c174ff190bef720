// Which boxes a view sees: one alone, or many, eight at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/rigid3.h"
#include "renderer/scene.h"

namespace vindu {

/// The half-spaces in which a view sees: in clip space -w <= x, y <= w and z <= w are half-spaces
/// of the world, also for points behind the eye, so this holds for any off-axis frustum (G. Gribb
/// and K. Hartmann, "Fast Extraction of Viewing Frustum Planes", 2001).
class ViewPlanes {
 public:
  explicit ViewPlanes(const Mat4& clip_from_world);

  /// The box lies wholly outside one of them. Never by rounding alone.
  bool miss(const Box3f& box_in_world) const;

 private:
  friend class BoxRows;
  struct Plane {
    Eigen::Vector3f normal, steepness;  // steepness: how fast it grows towards a box's corner
    float offset = 0;                   // normal * point + offset is negative outside
  };
  std::array<Plane, 5> planes_;
};

/// Boxes in the order in which they were added.
class BoxRows {
 public:
  void add(const Box3f& box_in_world);
  std::size_t size() const { return size_; }

  /// The indices of those that the planes do not miss, in their order.
  std::vector<std::uint32_t> seen_by(const ViewPlanes& planes) const;

 private:
  using Eight = Eigen::Array<float, 8, 1>;
  struct Row {
    std::array<Eight, 3> middle, half;  // along each axis
  };

  std::size_t size_ = 0;
  std::vector<Row> rows_;
};

}  // namespace vindu
