// The point of a piece of surface that is nearest to a given one.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// Weights of the corners for the point of a triangle that is nearest to `point` (C. Ericson,
/// "Real-Time Collision Detection", 2005, 5.1.5).
Eigen::Vector3f nearest_in_triangle(const Eigen::Vector3f& point,
                                    const std::array<Eigen::Vector3f, 3>& corners);

/// Reentrant. `vertices` must outlive it.
class SurfacePatches {
 public:
  struct Nearest {
    float distance = 0;
    std::size_t patch = 0;
    std::array<std::uint32_t, 3> corners{};             ///< vertices of the triangle
    Eigen::Vector3f weights = Eigen::Vector3f::Zero();  ///< of its corners
  };

  explicit SurfacePatches(std::span<const Vertex> vertices) : vertices_(vertices) {}

  /// Three indices for each triangle; compact patches make a search fast.
  void add(std::vector<std::uint32_t> indices);

  /// Infinitely far where no triangle has an area.
  Nearest nearest_to(const Eigen::Vector3f& point) const;

  /// The mean length of the triangles' edges.
  float mean_edge() const;

 private:
  struct Patch {
    std::vector<std::uint32_t> indices;
    Box3f bounds;
  };
  std::array<Eigen::Vector3f, 3> corners_at(const Patch& patch, std::size_t first) const;
  void search(std::size_t index, const Eigen::Vector3f& point, Nearest& nearest) const;

  std::span<const Vertex> vertices_;
  std::vector<Patch> patches_;
};

}  // namespace vindu
