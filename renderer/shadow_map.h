// Where the key light does not reach: one depth map, seen from the light, of what lies around the
// wall. It is fitted to scene and wall, never to a tile or an eye, so neighbouring tiles have the
// same shadows and nothing crawls when the viewer walks. Bound to the render thread.
#pragma once

#include <span>
#include <vector>

#include "core/wall.h"
#include "renderer/gpu_scene.h"
#include "renderer/scene_programs.h"

namespace vindu {

/// Towards the key light, a unit vector in world: from the upper left before the wall.
Vec3 to_key_light();

/// What a viewer before this wall can look at closely: as far as fitted models reach behind it and
/// a step before it. In wall.
Box3f shadow_region(const Wall& wall);

/// The map's place in the world: map = map_from_world * x gives the texture's u and v and the depth
/// (1 nearest to the light), all from 0 to 1.
struct ShadowFit {
  Mat4 map_from_world = Mat4::Identity();
  double texel_m = 0;
};

/// A square around `receivers`, deep enough for `casters`. Its size takes few steps and its corner
/// whole texels, so that shadows keep still while things move (M. Valient, "Stable Rendering of
/// Cascaded Shadow Maps", ShaderX6, 2008).
ShadowFit fit_shadow(const Box3f& receivers_in_world, const Box3f& casters_in_world, int side_px);

class ShadowMap {
 public:
  /// `look.shadows` must not be none.
  explicit ShadowMap(const Look& look);

  /// Before the canvas of the frame is begun: draws the map anew where a scene has moved or is
  /// another.
  void update(std::span<const GpuScene* const> scenes, const Box3f& region_in_world);

  /// Something may be in the shadow.
  bool in_use() const { return in_use_; }
  const ShadowFit& fit() const { return fit_; }
  /// Of the level of detail that throws a shadow.
  double largest_error_m() const { return 0.25 * fit_.texel_m; }
  GLuint texture() const { return depth_.name(); }

 private:
  void draw(std::span<const GpuScene* const> scenes) const;

  int side_px_;
  ScenePrograms programs_;
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
  std::vector<GpuScene::Stand> drawn_;
  bool in_use_ = false;
  ShadowFit fit_;
};

}  // namespace vindu
