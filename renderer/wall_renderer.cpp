#include "renderer/wall_renderer.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

int scaled_px(double px, double scale) {
  return std::max(1, static_cast<int>(std::lround(px * scale)));
}

int gap_px(double bezel_mm, double pitch_m, double scale) {
  return static_cast<int>(std::lround(1e-3 * bezel_mm / pitch_m * scale));
}

}  // namespace

WallLayout layout_of(const Wall& wall, double scale) {
  const WallGrid& grid = wall.grid;
  const double pitch_x_m = (grid.width_m - 1e-3 * grid.bezel_x_mm * (grid.columns - 1)) /
                           (grid.columns * grid.tile_width_px);
  const double pitch_y_m = (grid.height_m - 1e-3 * grid.bezel_y_mm * (grid.rows - 1)) /
                           (grid.rows * grid.tile_height_px);
  const int step_x =
      scaled_px(grid.tile_width_px, scale) + gap_px(grid.bezel_x_mm, pitch_x_m, scale);
  const int step_y =
      scaled_px(grid.tile_height_px, scale) + gap_px(grid.bezel_y_mm, pitch_y_m, scale);
  WallLayout layout;
  for (const Tile& tile : wall.tiles) {
    const SizePx size{scaled_px(tile.width_px, scale), scaled_px(tile.height_px, scale)};
    layout.tiles.push_back({tile.column * step_x, tile.row * step_y, size});
    layout.size.width = std::max(layout.size.width, tile.column * step_x + size.width);
    layout.size.height = std::max(layout.size.height, tile.row * step_y + size.height);
  }
  return layout;
}

WallRenderer::WallRenderer(const Wall& wall, double scale, const Look& look)
    : wall_(wall),
      look_(look),
      layout_(layout_of(wall, scale)),
      renderer_(look.style),
      picture_(std::make_unique<Picture>(layout_.size, look.style)) {
  picture_->clear({0, 0, 0, 255});
}

void WallRenderer::show(const Scene& scene) {
  scene_ = std::make_unique<GpuScene>(scene, renderer_.style());
}

Canvas& WallRenderer::canvas_of(SizePx size) {
  const auto found =
      std::ranges::find_if(canvases_, [&](const auto& canvas) { return canvas->size() == size; });
  if (found != canvases_.end()) return **found;
  return *canvases_.emplace_back(std::make_unique<Canvas>(size, look_));
}

WallFrame WallRenderer::draw(const FrameState& state, const Tile* only) {
  const Navigation& navigation = state.navigation;
  if (scene_)
    scene_->pose(matrix_of(navigation.wall_from_scene, navigation.scale), state.animation_time_s);
  const std::vector<const GpuScene*> scenes =
      scene_ ? std::vector<const GpuScene*>{scene_.get()} : std::vector<const GpuScene*>{};
  WallFrame frame;
  for (std::size_t index = 0; index < wall_.tiles.size(); ++index) {
    const Tile& tile = wall_.tiles[index];
    if (only && only->name != tile.name) continue;
    const TilePlace& place = layout_.tiles[index];
    Canvas& canvas = canvas_of(place.size);
    if (const auto view = tile_view(tile.corners, state.eye_in_wall)) {
      const DrawCount count = renderer_.draw(*view, scenes, {}, canvas);
      frame.count.draws += count.draws;
      frame.count.culled += count.culled;
    } else {
      canvas.begin();
      frame.black_tiles.push_back(tile.name);
    }
    canvas.resolve(*picture_, place.x, place.y);
  }
  return frame;
}

Image WallRenderer::read_tile(std::size_t index) const {
  const TilePlace& place = layout_.tiles[index];
  return picture_->read(place.x, place.y, place.size);
}

std::vector<Panel> WallRenderer::panels(const Rigid3& world_from_wall) const {
  std::vector<Panel> panels;
  const Vec2 whole(layout_.size.width, layout_.size.height);
  for (std::size_t index = 0; index < wall_.tiles.size(); ++index) {
    const TileCorners& corners = wall_.tiles[index].corners;
    const TilePlace& place = layout_.tiles[index];
    panels.push_back(
        {.corners_in_world = {world_from_wall * corners.lower_left_in_wall,
                              world_from_wall * corners.lower_right_in_wall,
                              world_from_wall * corners.upper_left_in_wall},
         .picture = picture_.get(),
         .uv_low = Vec2(place.x, place.y).cwiseQuotient(whole),
         .uv_high =
             Vec2(place.x + place.size.width, place.y + place.size.height).cwiseQuotient(whole)});
  }
  return panels;
}

}  // namespace vindu
