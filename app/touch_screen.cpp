#include "app/touch_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/common.h"
#include "renderer/surface.h"
#include "renderer/text.h"
#include "renderer/wall_renderer.h"

namespace vindu::app {
namespace {

constexpr SizePx kOverview{1600, 1000};
constexpr Rgba8 kBezel{0, 0, 0, 255};

constexpr int kFoot_px = 48;

std::string caption_of(const TouchPage& page) {
  if (page.done >= page.points.size()) return "All points are touched";
  const std::string request = fmt::format("Point {} of {}, on {}", page.done + 1,
                                          page.points.size(), page.points[page.done].tile);
  return page.remark.empty() ? request : request + ": " + page.remark;
}

/// Scaled so that it fits.
WallLayout layout_within(const Wall& wall, SizePx largest) {
  const SizePx full = layout_of(wall, 1).size;
  return layout_of(
      wall, std::min({1.0, 1.0 * largest.width / full.width, 1.0 * largest.height / full.height}));
}

SizePx overview_size(const Wall& wall) {
  const SizePx tiles = layout_within(wall, {1280, 900}).size;
  return {tiles.width, tiles.height + kFoot_px};
}

class PageWindow {
 public:
  explicit PageWindow(const Wall& wall)
      : wall_(wall),
        window_(make_window({.size = overview_size(wall),
                             .title = "Vindu: the wall's points",
                             .fullscreen = wall.tiles.size() == 1})),
        renderer_(Style::unlit) {}

  bool show(const TouchPage& page) {
    const SizePx size = window_->size();
    if (size.width > 0 && size.height > 0) draw(page, size);
    window_->present();
    return !window_->close_wanted();
  }

 private:
  void draw(const TouchPage& page, SizePx size) {
    const bool whole_screen = wall_.tiles.size() == 1;
    const TileMount mount = whole_screen ? wall_.tiles.front().mount : TileMount{};
    const Image image = whole_screen ? tile_page(page, size) : joined_pages(page, wall_, size);
    Picture picture({image.width_px, image.height_px}, Style::unlit);
    picture.write(image);
    picture.make_mipmaps();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.width, size.height);
    renderer_.present(picture, mount);
  }
  /// The tile's file may say other pixels than the screen has.
  Image tile_page(const TouchPage& page, SizePx size) const {
    Tile tile = wall_.tiles.front();
    const SizePx screen = window_->screen().size;
    if (screen.width > 0 && screen.height > 0) {
      tile.width_px = screen.width;
      tile.height_px = screen.height;
    }
    tile.corners = content_corners(tile, *window_);
    if (tile.mount.rotate_deg % 180 == 90) std::swap(size.width, size.height);
    return draw_touch_page(page, tile, size);
  }

  Wall wall_;
  std::unique_ptr<Window> window_;
  SceneRenderer renderer_;
};

class PageFolder {
 public:
  PageFolder(const Wall& wall, std::string folder) : wall_(wall), folder_(std::move(folder)) {
    make_folder(folder_);
  }

  void show(const TouchPage& page) {
    const bool new_remark = last_ && page.remark != last_->remark && !page.remark.empty();
    const bool new_point = !last_ || page.done != last_->done;
    if (last_ && new_point) write(*last_);
    if (new_point || new_remark) write(page);
    last_ = page;
  }

 private:
  void write(const TouchPage& page) const {
    const bool all = page.done == page.points.size();
    const std::string name = all ? "done" : std::to_string(page.done + 1);
    save(joined_pages(page, wall_, kOverview), "wall-" + name);
    const Tile* tile = all ? nullptr : wall_.find(page.points[page.done].tile);
    if (!tile) return;
    save(draw_touch_page(page, *tile, {tile->width_px, tile->height_px}), "touch-" + name);
  }
  void save(const Image& image, const std::string& name) const {
    write_png(image, fmt::format("{}/{}.png", folder_, name));
  }

  Wall wall_;
  std::string folder_;
  std::optional<TouchPage> last_;
};

}  // namespace

ShowPage page_window(const Wall& wall) {
  return [window = std::make_shared<PageWindow>(wall)](const TouchPage& page) {
    return window->show(page);
  };
}

ShowPage page_folder(const Wall& wall, const std::string& folder) {
  return [pages = std::make_shared<PageFolder>(wall, folder)](const TouchPage& page) {
    pages->show(page);
    return true;
  };
}

Image joined_pages(const TouchPage& page, const Wall& wall, SizePx largest) {
  const WallLayout layout =
      layout_within(wall, {largest.width, std::max(1, largest.height - kFoot_px)});
  const SizePx size = layout.size;
  Image joined = Image::filled(size.width, size.height + kFoot_px, kBezel);
  for (std::size_t i = 0; i < wall.tiles.size(); ++i) {
    const RectPx& place = layout.tiles[i];
    paste(draw_touch_page(page, wall.tiles[i], place.size), place.x,
          size.height - place.y - place.size.height, joined);
  }
  draw_text(joined, kFoot_px / 4, size.height + kFoot_px / 4, caption_of(page), {0.5 * kFoot_px});
  return joined;
}

}  // namespace vindu::app
