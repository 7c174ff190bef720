// The pattern bar: an upright bar that moves to the right over the whole wall and a level one that
// moves up, at constant speed by the frame's photon time. A late tile's is behind its neighbours',
// a torn picture's is broken. Drawn by the GPU, anew for each frame.
#pragma once

#include "core/clock.h"
#include "core/wall.h"
#include "renderer/canvas.h"
#include "renderer/gl/program.h"
#include "renderer/tile_surface.h"

namespace vindu {

/// From one end of the wall to the other; then it begins anew.
constexpr double kBarCrossing_s = 4;

/// Where the middle of a bar is on its way from one end to the other; metres, as the ends.
double bar_at_m(Time photon_time, const Vec2& ends_m);

/// Bound to the render thread.
class BarPainter {
 public:
  explicit BarPainter(const Wall& whole);

  /// Into a part of the picture.
  void draw(Time photon_time, const Tile& tile, const RectPx& place, const Picture& picture) const;

 private:
  Vec2 ends_m_[3];  // of the wall, along its axes
  double half_width_m_;
  gl::Program program_;
  gl::VertexArray no_vertices_;
};

}  // namespace vindu
