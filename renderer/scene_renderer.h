// Draws scenes and flat pictures as seen through views: one lit pass, physically plausible
// (metallic-roughness, one key light with its shadow, an analytic environment), or unlit for
// measuring. Depth is reversed and infinite. Bound to the render thread.
#pragma once

#include <span>

#include "renderer/draw_list.h"
#include "renderer/shadow_map.h"

namespace vindu {

/// A picture that hangs in the world, facing its front side; a part of a texture from uv_low to
/// uv_high.
struct Panel {
  TileCorners corners_in_world;
  const Picture* picture = nullptr;
  Vec2 uv_low = {0, 0};
  Vec2 uv_high = {1, 1};
};

class SceneRenderer {
 public:
  explicit SceneRenderer(const Look& look);
  explicit SceneRenderer(Style style) : SceneRenderer(Look{style}) {}

  const Look& look() const { return look_; }
  Style style() const { return look_.style; }

  /// Links the programs that the scene needs, so that drawing does not wait for them.
  void prepare(const GpuScene& scene, const ShadowMap* shadow) const;

  /// Into the canvas that was begun last. The scenes must be posed. Blended surfaces are sorted by
  /// distance from the eye. `shadow`: of these scenes, as they stand.
  DrawCount draw(const View& view, std::span<const GpuScene* const> scenes,
                 std::span<const Panel> panels = {}, const ShadowMap* shadow = nullptr) const;

  /// Flat pictures alone, in the dark: what an eye sees of the wall.
  void draw_panels(const View& view, std::span<const Panel> panels) const;

  /// A picture into the part of the bound framebuffer that the viewport names.
  void present(const Picture& picture, const TileMount& mount) const;
  void present(const Picture& picture, const TileMount& mount, const RectPx& part) const;

 private:
  /// What the batches of a pass have in common.
  struct Pass {
    const View& view;
    const ShadowMap* shadow;
    bool blended;
  };
  void draw_scene(const Pass& pass, const GpuScene& scene,
                  std::span<const GpuScene::Draw* const> draws) const;
  SurfaceKind kind_drawn(const GpuScene::Draw& draw, const ShadowMap* shadow) const;
  void use_program(const Pass& pass, const GpuScene& scene, SurfaceKind kind) const;
  void draw_panel(const View& view, const Panel& panel) const;
  void draw_background(const View& view) const;

  Look look_;
  ScenePrograms scene_programs_;
  gl::Program background_program_;
  gl::Program panel_program_;
  gl::Program present_program_;
  gl::VertexArray no_vertices_;
};

/// picture = matrix * (x, y, 1) for the display's x, y from -1 to 1.
Mat3 picture_from_display(const TileMount& mount);
/// The same of a part of a picture: whole = matrix * (x, y, 1) for the part's x, y from -1 to 1.
Mat3 whole_from_part(const RectPx& part, SizePx whole);

}  // namespace vindu
