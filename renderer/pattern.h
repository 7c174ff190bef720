// What tiles show of a frame that shows no model: a test pattern, points to be touched, or nothing.
// Drawn into parts of a picture, upright as the viewer sees it; how the display hangs is the
// surface's affair.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/frame_state.h"
#include "core/wall.h"
#include "renderer/pattern_bar.h"

namespace vindu {

/// A tile's picture of the touch page, or of the patterns that are drawn by the CPU; empty for the
/// others.
std::optional<Image> draw_pattern(const FrameState& state, const Wall& whole, const Tile& tile,
                                  SizePx size);

/// Bound to the render thread.
class PatternPainter {
 public:
  /// `whole`: the wall with all its tiles, whoever draws them.
  PatternPainter(const Wall& whole, Style style) : whole_(whole), style_(style) {}

  /// Throws Error when the GPU cannot hold it.
  void draw(const FrameState& state, const Tile& tile, const RectPx& place, Picture& picture);
  /// The frame's number, where the state asks for it: over everything else.
  static void draw_number(const FrameState& state, const RectPx& place, Picture& picture);

 private:
  struct Page {
    std::string tile;
    SizePx size{};
    TileCorners corners{};
    Pattern pattern = Pattern::none;
    std::optional<TouchPage> touch_page{};
    Vec3 eye_in_wall = Vec3::Zero();
    std::optional<Picture> picture{};
  };
  const Picture& page(const FrameState& state, const Tile& tile, SizePx size);

  Wall whole_;
  Style style_;
  std::vector<Page> pages_;  // by tile: what does not change is drawn once
  std::optional<BarPainter> bar_;
};

}  // namespace vindu
