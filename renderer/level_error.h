// What a coarser surface costs the picture, as one length: how far off full detail it may look.
#pragma once

#include <vector>

#include "renderer/surface_distance.h"

namespace vindu {

/// Vertices that share their place with another one: at seams of textures and sharp edges. What
/// lies nearest to them may belong to the other side, so nothing but places is compared there.
std::vector<bool> vertices_of_shared_places(std::span<const Vertex> vertices);

/// Gathers what is seen from vertices of full detail.
class LevelError {
 public:
  /// Both must outlive it.
  LevelError(std::span<const Vertex> vertices, const std::vector<bool>& shared_place)
      : vertices_(vertices), shared_place_(shared_place) {}

  /// `index` of a vertex; `nearest`: what the coarser surface has nearest to it.
  void add(std::uint32_t index, const SurfacePatches::Nearest& nearest);

  /// In units of the node. The largest of: the farthest any vertex is off the surface; how far
  /// textures slide on it, but for the twentieth that slides most (across seams); and of what
  /// colours and normals lose, the share that would be seen, times the length of the coarser
  /// triangles' edges: small triangles may lose them all, as they are less than a pixel.
  float in_node(float mean_edge_in_node) const;

 private:
  std::span<const Vertex> vertices_;
  const std::vector<bool>& shared_place_;
  float farthest_ = 0;
  std::vector<float> slides_;
  double colour_squares_ = 0;  // of the largest difference of a channel, from 0 to 1
  double normal_squares_ = 0;  // of the sine of half the angle, doubled
};

}  // namespace vindu
