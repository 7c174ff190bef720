// The figures of one process' tiles, over their pictures where the frame asks for them: each tile's
// own in its upper left corner, and the wall's on the lower left tile.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/statistics.h"
#include "cluster/bus.h"
#include "core/site.h"
#include "renderer/overlay.h"
#include "renderer/wall_renderer.h"

namespace vindu::app {

/// Bound to the render thread; made and destroyed while its context is current.
class TileStatistics {
 public:
  /// `part`: the wall with this process' tiles alone.
  TileStatistics(const Site& site, Wall part);

  /// Whether one of these tiles shows the wall's figures: the bus must hear Topic::report then.
  static bool hears(const Site& site, const Wall& part);
  void hear(Bus& bus);

  /// `gpu`: by the GPU's own timer, where it is known.
  void drew(const WallFrame& frame, Duration draw, std::optional<Duration> gpu);
  void showed(Time now, const std::optional<FrameParts>& parts);
  const DrawFigures& figures() const { return statistics_.figures(); }

  /// Into the pictures that were drawn.
  void draw_over(WallRenderer& wall);

 private:
  struct Panels {
    OverlayPanel tile, wall;
  };

  std::string name_;  // of the wall
  std::size_t wall_tiles_;
  Wall part_;
  std::string below_;
  std::optional<std::size_t> shows_wall_;  // which of these tiles
  FrameStatistics statistics_;
  std::vector<DrawCount> counts_;  // by tile
  std::optional<ReportMessage> wall_;
  std::vector<Panels> panels_;
};

}  // namespace vindu::app
