#include "renderer/pattern.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/frame_counter.h"
#include "renderer/pattern_lines.h"
#include "renderer/pattern_pages.h"
#include "renderer/text.h"
#include "renderer/touch_page.h"

namespace vindu {
namespace {

bool same(const TileCorners& a, const TileCorners& b) {
  return a.lower_left_in_wall == b.lower_left_in_wall &&
         a.lower_right_in_wall == b.lower_right_in_wall &&
         a.upper_left_in_wall == b.upper_left_in_wall;
}

/// In the upper right, for people.
void draw_time(const FrameState& state, const RectPx& place, Picture& picture) {
  const std::string words =
      fmt::format("photon {:.3f} s", seconds(state.photon_time.time_since_epoch()));
  const TextStyle style{.height_px = std::min(place.size.height / 12.0, place.size.width / 24.0)};
  if (style.height_px < 7) return;
  Image image = Image::filled(std::min(text_width_px(words, style), place.size.width),
                              static_cast<int>(1.2 * style.height_px), {0, 0, 0, 255});
  draw_text(image, 0, 0, words, style);
  picture.write(image, place.x + place.size.width - image.width_px,
                place.y + place.size.height - image.height_px);
}

}  // namespace

std::optional<Image> draw_pattern(const FrameState& state, const Wall& whole, const Tile& tile,
                                  SizePx size) {
  if (state.touch_page) return draw_touch_page(*state.touch_page, tile, size);
  switch (state.pattern) {
    case Pattern::grid:
      return draw_grid(whole, tile, size);
    case Pattern::names:
      return draw_names(tile, size);
    case Pattern::seams:
      return draw_seams(whole, tile, size);
    case Pattern::ramps:
      return draw_ramps(size);
    case Pattern::eye:
      return draw_eye(state, whole, tile, size);
    case Pattern::none:
    case Pattern::counter:
    case Pattern::bar:
      break;
  }
  return std::nullopt;
}

void PatternPainter::draw(const FrameState& state, const Tile& tile, const RectPx& place,
                          Picture& picture) {
  if (state.blank) return picture.clear({0, 0, 0, 255}, place);
  if (state.pattern == Pattern::bar && !state.touch_page) {
    if (!bar_) bar_.emplace(whole_);
    bar_->draw(state.photon_time, tile, place, picture);
    draw_time(state, place, picture);
  } else {
    picture.copy(page(state, tile, place.size), place.x, place.y);
  }
}

void PatternPainter::draw_number(const FrameState& state, const RectPx& place, Picture& picture) {
  if (shows_number(state)) draw_frame_counter(state.number, place, picture);
}

const Picture& PatternPainter::page(const FrameState& state, const Tile& tile, SizePx size) {
  auto found = std::ranges::find(pages_, tile.name, &Page::tile);
  if (found == pages_.end()) found = pages_.insert(found, {.tile = tile.name});
  Page& page = *found;
  const bool moves =
      !state.touch_page && state.pattern == Pattern::eye && state.eye_in_wall != page.eye_in_wall;
  if (page.picture && page.pattern == state.pattern && page.touch_page == state.touch_page &&
      page.size == size && same(page.corners, tile.corners) && !moves)
    return *page.picture;
  if (!page.picture || page.size != size) page.picture.emplace(size, style_);
  if (const auto image = draw_pattern(state, whole_, tile, size)) page.picture->write(*image);
  page.size = size;
  page.corners = tile.corners;
  page.pattern = state.pattern;
  page.touch_page = state.touch_page;
  page.eye_in_wall = state.eye_in_wall;
  return *page.picture;
}

}  // namespace vindu
