#include "app/tile_statistics.h"

#include <algorithm>

#include "app/common.h"
#include "renderer/surface.h"

namespace vindu::app {
namespace {

/// The tile of the wall's figures, among these.
std::optional<std::size_t> lower_left(const Site& site, const Wall& part) {
  const auto place = [](const Tile& tile) { return std::pair(tile.row, tile.column); };
  const std::string& name = std::ranges::min_element(site.wall.tiles, {}, place)->name;
  const auto found = std::ranges::find(part.tiles, name, &Tile::name);
  if (found == part.tiles.end()) return std::nullopt;
  return static_cast<std::size_t>(found - part.tiles.begin());
}

/// GL_RENDERER, without what stands in brackets.
std::string short_renderer() {
  const std::string whole = gl_description();
  return whole.substr(0, whole.find_first_of("(,/"));
}

}  // namespace

TileStatistics::TileStatistics(const Site& site, Wall part)
    : name_(site.cluster.name),
      wall_tiles_(site.wall.tiles.size()),
      part_(std::move(part)),
      below_(host_name() + ", " + short_renderer()),
      shows_wall_(lower_left(site, part_)),
      statistics_(site.rate_hz),
      counts_(part_.tiles.size()),
      panels_(part_.tiles.size()) {}

bool TileStatistics::hears(const Site& site, const Wall& part) {
  return lower_left(site, part).has_value();
}

void TileStatistics::hear(Bus& bus) {
  if (!shows_wall_) return;
  for (ReportMessage& report : bus.take<ReportMessage>())
    if (report.tile.empty() && (!wall_ || report.epoch >= wall_->epoch)) wall_ = std::move(report);
}

void TileStatistics::drew(const WallFrame& frame, Duration draw, std::optional<Duration> gpu) {
  statistics_.drew(frame.count, draw, gpu);
  counts_ = frame.tile_counts;
  counts_.resize(part_.tiles.size());
}

void TileStatistics::showed(Time now, const std::optional<FrameParts>& parts) {
  if (parts) statistics_.showed(now, *parts);
}

void TileStatistics::draw_over(WallRenderer& wall) {
  glBindFramebuffer(GL_FRAMEBUFFER, wall.picture().framebuffer());
  for (std::size_t i = 0; i < part_.tiles.size(); ++i) {
    RectPx place = wall.layout().tiles[i];
    const int margin = place.size.width / 64;
    place.x += margin;
    place.size.width -= 2 * margin;
    place.y += margin;
    place.size.height -= 2 * margin;
    const double text_px = text_px_for(place.size.width);
    const OverlayPage page = statistics_.page(part_.tiles[i].name, below_, counts_[i]);
    const int taken = panels_[i].tile.draw(page, place, wall.renderer()) + margin;
    if (i != shows_wall_ || !wall_) continue;
    place.x += taken;
    place.size.width -= taken;
    OverlayPage whole = wall_page(*wall_, name_, wall_tiles_);
    whole.text_px = text_px;
    panels_[i].wall.draw(whole, place, wall.renderer());
  }
}

}  // namespace vindu::app
