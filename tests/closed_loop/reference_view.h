// The reference of the closed loop: what the eye sees, drawn by an ordinary symmetric look-at
// camera (GLM's lookAt and perspective), and carried over to a tile's pixels by the homography of
// its four corners. No frustum code of the product takes part.
#pragma once

#include "core/wall.h"
#include "renderer/image.h"
#include "renderer/scene_renderer.h"

namespace vindu::test {

/// A picture with fractions of levels, as bilinear sampling gives them.
struct Levels {
  int width_px = 0;
  int height_px = 0;
  std::vector<Eigen::Vector3f> pixels;
  const Eigen::Vector3f& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * width_px + x];
  }
};

/// What the eye sees where the tile hangs, in the tile's pixels.
Levels reference_of_tile(const Tile& tile, const Vec3& eye_in_wall, const SceneRenderer& renderer,
                         const GpuScene& scene);

}  // namespace vindu::test
