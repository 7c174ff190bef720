#include "renderer/wall_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vindu {
namespace {

int scaled_px(double px, double scale) {
  return std::max(1, static_cast<int>(std::lround(px * scale)));
}

int gap_px(double bezel_mm, double pitch_m, double scale) {
  return static_cast<int>(std::lround(1e-3 * bezel_mm / pitch_m * scale));
}

/// Of the canvas on which tiles are drawn together: 128 MiB of colour and depth.
constexpr int kCanvasSamples = 1 << 24;
constexpr int kCanvasSide_px = 8192;

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
  const int left = std::ranges::min(wall.tiles, {}, &Tile::column).column,
            bottom = std::ranges::min(wall.tiles, {}, &Tile::row).row;
  for (const Tile& tile : wall.tiles) {
    const SizePx size{scaled_px(tile.width_px, scale), scaled_px(tile.height_px, scale)};
    const RectPx place{(tile.column - left) * step_x, (tile.row - bottom) * step_y, size};
    layout.tiles.push_back(place);
    layout.size.width = std::max(layout.size.width, place.x + size.width);
    layout.size.height = std::max(layout.size.height, place.y + size.height);
  }
  return layout;
}

WallRenderer::WallRenderer(const Wall& wall, double scale, const Look& look, const Wall& whole)
    : wall_(wall),
      scale_(scale),
      layout_(layout_of(wall, scale)),
      renderer_(look),
      patterns_(whole, look.style),
      picture_(std::make_unique<Picture>(layout_.size, look.style)) {
  picture_->clear({0, 0, 0, 255});
  for (const RectPx& tile : layout_.tiles) {
    cell_.width = std::max(cell_.width, tile.size.width);
    cell_.height = std::max(cell_.height, tile.size.height);
  }
  const int samples = look.style == Style::lit ? std::max(look.samples, 1) : 1;
  const int count = static_cast<int>(layout_.tiles.size());
  const int together =
      std::clamp(kCanvasSamples / (cell_.width * cell_.height * samples), 1, count);
  cells_x_ = std::clamp(kCanvasSide_px / cell_.width, 1, together);
  cells_y_ = std::clamp(kCanvasSide_px / cell_.height, 1, (together + cells_x_ - 1) / cells_x_);
  canvas_ = std::make_unique<Canvas>(SizePx{cells_x_ * cell_.width, cells_y_ * cell_.height}, look);
  if (look.style == Style::lit && look.shadows != Shadows::none)
    shadow_ = std::make_unique<ShadowMap>(look);
}

void WallRenderer::show(const PackedScene& packed) {
  prepare(uploaded(packed, renderer_.look()));
  show_prepared();
}

void WallRenderer::prepare(GpuScene scene) {
  prepared_ = std::make_unique<GpuScene>(std::move(scene));
  prepared_->pose(Mat4::Identity(), 0);
  const auto view = tile_view(wall_.tiles.front().corners, Vec3(0, 0, 2));
  const GpuScene* const drawn = prepared_.get();
  if (shadow_) shadow_->update(std::span(&drawn, 1), shadow_region(wall_));
  renderer_.prepare(*prepared_, shadow_.get());
  canvas_->begin();
  canvas_->draw_into({0, 0, cell_});
  if (view) renderer_.draw(*view, std::span(&drawn, 1), {}, shadow_.get());
  glFinish();
}

void WallRenderer::show_prepared() {
  if (prepared_) scene_ = std::move(prepared_);
}

WallFrame WallRenderer::draw(const FrameState& state, const Tile* only) {
  std::vector<std::size_t> wanted;
  for (std::size_t index = 0; index < wall_.tiles.size(); ++index)
    if (!only || only->name == wall_.tiles[index].name) wanted.push_back(index);
  WallFrame frame;
  frame.tile_counts.resize(wall_.tiles.size());
  if (shows_model(state))
    draw_scene(state, wanted, frame);
  else
    for (const std::size_t index : wanted)
      patterns_.draw(state, wall_.tiles[index], layout_.tiles[index], *picture_);
  for (const std::size_t index : wanted)
    PatternPainter::draw_number(state, layout_.tiles[index], *picture_);
  return frame;
}

void WallRenderer::draw_numbers(const FrameState& state) {
  for (const RectPx& place : layout_.tiles) PatternPainter::draw_number(state, place, *picture_);
}

void WallRenderer::draw_scene(const FrameState& state, std::span<const std::size_t> tiles,
                              WallFrame& frame) {
  const Navigation& navigation = state.navigation;
  if (scene_)
    scene_->pose(matrix_of(navigation.wall_from_scene, navigation.scale), state.animation_time_s,
                 state.clip);
  update_shadow(state, tiles);
  const std::size_t together = static_cast<std::size_t>(cells_x_) * cells_y_;
  for (std::size_t first = 0; first < tiles.size(); first += together)
    draw_together(state, tiles.subspan(first, std::min(together, tiles.size() - first)), frame);
}

/// Only where one of the tiles shows something that is lit: most tiles of a wall may not.
void WallRenderer::update_shadow(const FrameState& state, std::span<const std::size_t> tiles) {
  if (!scene_ || !shadow_) return;
  const GpuScene* const scene = scene_.get();
  const bool needed = std::ranges::any_of(tiles, [&](std::size_t tile) {
    const auto view = tile_view(wall_.tiles[tile].corners, state.eye_in_wall);
    return view && sees_lit(*view, *scene);
  });
  if (needed) shadow_->update(std::span(&scene, 1), shadow_region(wall_));
}

void WallRenderer::draw_together(const FrameState& state, std::span<const std::size_t> tiles,
                                 WallFrame& frame) {
  const auto cell = [&](std::size_t order) {
    const int x = static_cast<int>(order) % cells_x_, y = static_cast<int>(order) / cells_x_;
    return RectPx{x * cell_.width, y * cell_.height, layout_.tiles[tiles[order]].size};
  };
  const GpuScene* const scene = scene_.get();
  const std::span scenes(&scene, scene ? 1 : 0);
  const DetailNeed need = detail_need(wall_, state.eye_in_wall, scale_);
  canvas_->begin();
  for (std::size_t order = 0; order < tiles.size(); ++order) {
    const Tile& tile = wall_.tiles[tiles[order]];
    auto view = tile_view(tile.corners, state.eye_in_wall);
    if (!view) {
      frame.black_tiles.push_back(tile.name);
      continue;
    }
    view->detail = need;
    canvas_->draw_into(cell(order));
    const DrawCount count = renderer_.draw(*view, scenes, {}, shadow_.get());
    frame.count += count;
    frame.tile_counts[tiles[order]] = count;
  }
  for (std::size_t order = 0; order < tiles.size(); ++order) {
    const RectPx& place = layout_.tiles[tiles[order]];
    canvas_->resolve(cell(order), *picture_, place.x, place.y);
  }
}

Image WallRenderer::read_tile(std::size_t index) const {
  return picture_->read(layout_.tiles[index]);
}

std::vector<Panel> WallRenderer::panels(const Rigid3& world_from_wall) const {
  std::vector<Panel> panels;
  const Vec2 whole(layout_.size.width, layout_.size.height);
  for (std::size_t index = 0; index < wall_.tiles.size(); ++index) {
    const TileCorners& corners = wall_.tiles[index].corners;
    const RectPx& place = layout_.tiles[index];
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
