// Draws scenes and flat pictures as seen through views: one lit pass, physically plausible
// (metallic-roughness, one key light, an analytic environment), or unlit for measuring. Depth is
// reversed and infinite. Bound to the render thread.
#pragma once

#include <array>
#include <span>

#include "renderer/canvas.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/view.h"

namespace vindu {

/// A picture that hangs in the world, facing its front side; a part of a texture from uv_low to
/// uv_high.
struct Panel {
  TileCorners corners_in_world;
  const Picture* picture = nullptr;
  Vec2 uv_low = {0, 0};
  Vec2 uv_high = {1, 1};
};

struct DrawCount {
  int draws = 0;
  int culled = 0;
  std::uint64_t triangles = 0;         ///< of all draws
  std::uint64_t culled_triangles = 0;  ///< of the culled ones

  DrawCount& operator+=(const DrawCount& other);
};

class SceneRenderer {
 public:
  explicit SceneRenderer(Style style);

  Style style() const { return style_; }

  /// Into the canvas that was begun last. The scenes must be posed. Blended surfaces are sorted by
  /// distance from the eye.
  DrawCount draw(const View& view, std::span<const GpuScene* const> scenes,
                 std::span<const Panel> panels = {}) const;

  /// Flat pictures alone, in the dark: what an eye sees of the wall.
  void draw_panels(const View& view, std::span<const Panel> panels) const;

  /// A picture into the part of the bound framebuffer that the viewport names.
  void present(const Picture& picture, const TileMount& mount) const;

 private:
  void draw_scene(const View& view, const GpuScene& scene, bool blended, DrawCount& count) const;
  void draw_panel(const View& view, const Panel& panel) const;
  void draw_background(const View& view) const;

  Style style_;
  // One program a kind of surface: a CPU that draws runs both sides of every branch.
  std::array<gl::Program, 4> scene_programs_;
  gl::Program background_program_;
  gl::Program panel_program_;
  gl::Program present_program_;
  gl::VertexArray no_vertices_;
};

/// picture = matrix * (x, y, 1) for the display's x, y from -1 to 1.
Mat3 picture_from_display(const TileMount& mount);

}  // namespace vindu
