// A wall's frame: from a FrameState and a scene to the pictures of any number of tiles, with one
// context and one copy of the scene, joined to one picture of the wall. Bound to the render thread.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/frame_state.h"
#include "core/wall.h"
#include "renderer/pattern.h"
#include "renderer/scene_renderer.h"

namespace vindu {

/// Where the tiles' pixels lie in the picture of the whole wall; bezels are gaps.
struct WallLayout {
  SizePx size;
  std::vector<RectPx> tiles;  ///< in the order of Wall::tiles
};

/// Tiles in their places of the grid, from the leftmost and lowest on, each side scaled and rounded
/// to at least one pixel.
WallLayout layout_of(const Wall& wall, double scale);

struct WallFrame {
  DrawCount count{};                     ///< of all tiles
  std::vector<DrawCount> tile_counts{};  ///< in the order of Wall::tiles; those not drawn: 0
  std::vector<std::string> black_tiles;  ///< the eye is at or behind their plane
};

class WallRenderer {
 public:
  /// Throws Error when the picture is too large for this GPU.
  WallRenderer(const Wall& wall, double scale, const Look& look)
      : WallRenderer(wall, scale, look, wall) {}
  /// Of some tiles of a whole wall, over all of which patterns reach.
  WallRenderer(const Wall& wall, double scale, const Look& look, const Wall& whole);

  /// Replaces the scene; when that throws, the old one stays.
  void show(const PackedScene& packed);
  /// The same in two steps: draws it once unseen, so that drivers have done what they do at first,
  /// which takes as long as a frame or longer; then changes to it at once.
  void prepare(GpuScene scene);
  void show_prepared();

  /// Draws all tiles, or only one, into picture().
  WallFrame draw(const FrameState& state, const Tile* only = nullptr);
  /// The frame's number once more, over what came over the tiles' pictures since.
  void draw_numbers(const FrameState& state);

  /// Waits until the GPU has drawn everything.
  void finish() const { glFinish(); }

  const Wall& wall() const { return wall_; }
  const WallLayout& layout() const { return layout_; }
  const SceneRenderer& renderer() const { return renderer_; }
  Picture& picture() { return *picture_; }
  Image read_tile(std::size_t index) const;

  /// The tiles as they hang in the room or, with identity, in wall's own frame.
  std::vector<Panel> panels(const Rigid3& world_from_wall) const;

 private:
  void update_shadow(const FrameState& state, std::span<const std::size_t> tiles);
  void draw_scene(const FrameState& state, std::span<const std::size_t> tiles, WallFrame& frame);
  void draw_together(const FrameState& state, std::span<const std::size_t> tiles, WallFrame& frame);

  Wall wall_;
  double scale_;
  WallLayout layout_;
  SceneRenderer renderer_;
  PatternPainter patterns_;
  std::unique_ptr<Picture> picture_;
  // Tiles are drawn beside each other and copied together, so that a GPU need not wait for one to
  // be drawn before the next.
  SizePx cell_;  // as large as the largest tile
  int cells_x_ = 1;
  int cells_y_ = 1;
  std::unique_ptr<Canvas> canvas_;
  std::unique_ptr<GpuScene> scene_, prepared_;
  std::unique_ptr<ShadowMap> shadow_;  // of scene_; none where no light is drawn
};

}  // namespace vindu
