// A small picture of the wall in a window, whose pointer plays the hand before it.
#pragma once

#include <memory>
#include <optional>

#include "app/tuio.h"
#include "core/wall.h"
#include "renderer/scene_renderer.h"
#include "renderer/surface.h"

namespace vindu::app {

/// Bound to the thread that made it. Throws Error where no window can be opened.
class TouchPad {
 public:
  /// The wall must outlive this.
  explicit TouchPad(const Wall& wall);

  /// Draws tiles and hand, and handles the window's events; false when it was closed.
  bool show();
  /// Where the pointer has moved since the last call, as a touch.
  std::optional<TuioChange> take_change();

 private:
  Image drawn(SizePx size) const;

  const Wall& wall_;
  std::unique_ptr<Window> window_;
  SceneRenderer renderer_;
  std::optional<Vec2> hand_;  // 0 to 1, from the upper left; empty: not over the wall yet
};

}  // namespace vindu::app
