// The page of points to be touched: marks stand where the wall's geometry has the points, and show
// how far somebody has come.
#include "renderer/touch_page.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/core/matchers.h"

namespace vindu {
namespace {

constexpr Rgba8 kMark{240, 228, 66, 255};
constexpr Rgba8 kRefused{255, 130, 60, 255};

/// Tiles of 1 x 0.5 m, 1 mm a pixel, with bezels.
Wall wall_with_bezels() {
  return expand_wall({.columns = 3,
                      .rows = 2,
                      .width_m = 3.04,
                      .height_m = 1.01,
                      .tile_width_px = 1000,
                      .tile_height_px = 500,
                      .bezel_x_mm = 20,
                      .bezel_y_mm = 10,
                      .mount = {}},
                     {}, {});
}

Image page_of(const TouchPage& page, const Tile& tile) {
  return draw_touch_page(page, tile, {tile.width_px, tile.height_px});
}

/// The middle of all pixels within a square that have the mark's colour, and how many there are.
struct Marked {
  Vec2 middle_px = Vec2::Zero();
  int count = 0;
};

Marked marked(const Image& image, const Vec2& about_px, double reach_px) {
  Marked found;
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const Vec2 middle(x + 0.5, y + 0.5);
      if ((middle - about_px).lpNorm<Eigen::Infinity>() > reach_px || image.at(x, y) != kMark)
        continue;
      found.middle_px += middle;
      ++found.count;
    }
  if (found.count > 0) found.middle_px /= found.count;
  return found;
}

int count_of(const Image& image, const Rgba8& colour) {
  return static_cast<int>(std::ranges::count(image.pixels, colour));
}

TEST(TouchPage, MarksThePointWhereTheWallHasItBezelsCounted) {
  const Wall wall = wall_with_bezels();
  // Of tile-2-1, whose lower left is (0.52, 0.005): 300 px from its left, 500 - 270 from its top.
  const TouchPage page{.points = {{{0.82, 0.275, 0}, ""}}, .remark = {}, .ring_m = 0.08};
  const Image image = page_of(page, *wall.find("tile-2-1"));
  const Marked mark = marked(image, {300, 230}, 90);
  EXPECT_THAT(image.at(300, 230), ::testing::Eq(kMark));
  EXPECT_NEAR(mark.middle_px.x(), 300, 0.1);
  EXPECT_NEAR(mark.middle_px.y(), 230, 0.1);
  EXPECT_GT(mark.count, 500);
}

TEST(TouchPage, MarksACornerOnItsTileAndTheRestOfTheRingBeyondTheBezel) {
  const Wall wall = wall_with_bezels();
  const Vec3 corner = wall.find("tile-1-0")->corners.lower_right_in_wall;
  const TouchPage page{.points = {{corner, "tile-1-0"}}, .remark = {}, .ring_m = 0.1};
  EXPECT_EQ(page_of(page, *wall.find("tile-1-0")).at(999, 499), kMark);
  const Image beyond = page_of(page, *wall.find("tile-2-0"));  // its edge is 20 px from there
  EXPECT_EQ(beyond.at(79, 499), kMark);
  EXPECT_EQ(marked(beyond, {90, 450}, 6).count, 0);
  EXPECT_EQ(count_of(page_of(page, *wall.find("tile-0-0")), kMark), 0);
}

TEST(TouchPage, OfATileThatHangsCrookedFollowsItsThreeCorners) {
  Tile tile = wall_with_bezels().tiles.front();
  const Vec3 right = Vec3(0.9, 0.3, -0.2), up = Vec3(-0.1, 0.5, 0.3);
  tile.corners = {{1, 2, 3}, Vec3(1, 2, 3) + right, Vec3(1, 2, 3) + up};
  const Vec2 there = pixel_of(tile.corners, Vec3(1, 2, 3) + 0.25 * right + 0.8 * up, {1000, 500});
  EXPECT_NEAR(there.x(), 250, 1e-9);
  EXPECT_NEAR(there.y(), 100, 1e-9);
}

TEST(TouchPage, FillsItsRingWhileTheLedIsHeld) {
  const Tile tile = wall_with_bezels().tiles.front();
  TouchPage page{.points = {{tile.corners.centre_in_wall(), ""}}, .remark = {}};
  int before = 0;
  for (const double held : {0.0, 0.3, 0.6, 1.0}) {
    page.held = held;
    const int now = count_of(page_of(page, tile), kMark);
    EXPECT_GT(now, before);
    before = now;
  }
}

TEST(TouchPage, SaysWhyDotsAreRefusedWhereThePointIsAlone) {
  const Wall wall = wall_with_bezels();
  const Vec3 point = wall.find("tile-1-1")->corners.centre_in_wall();
  const TouchPage page{.points = {{point, "tile-1-1"}}, .remark = "only left sees the LED"};
  EXPECT_GT(count_of(page_of(page, *wall.find("tile-1-1")), kRefused), 50);
  EXPECT_EQ(count_of(page_of(page, *wall.find("tile-0-1")), kRefused), 0);
}

TEST(TouchPage, HasNoMarkToTouchWhenAllAreDone) {
  const Tile tile = wall_with_bezels().tiles.front();
  const TouchPage page{
      .points = {{tile.corners.centre_in_wall(), tile.name}}, .done = 1, .remark = {}};
  EXPECT_EQ(count_of(page_of(page, tile), kMark), 0);
}

TEST(TouchPage, OfAnySizeIsDrawnWithoutHarm) {
  const Wall wall = wall_with_bezels();
  TouchPage page{.remark = std::string(500, 'W')};
  for (const Tile& tile : wall.tiles)
    page.points.push_back({tile.corners.upper_right_in_wall(), tile.name});
  for (const SizePx size : {SizePx{1, 1}, SizePx{3, 400}, SizePx{400, 3}})
    for (const Tile& tile : wall.tiles)
      EXPECT_EQ(draw_touch_page(page, tile, size).width_px, size.width);
}

}  // namespace
}  // namespace vindu
