// Where tiles' pixels lie in the joined picture, and how pictures are turned for their displays.
#include <gmock/gmock.h>

#include <string>

#include "renderer/wall_renderer.h"
#include "tests/core/matchers.h"

namespace vindu {
namespace {

using testing::IsNearPoint;

WallGrid tromso_grid() {
  return {.columns = 7,
          .rows = 4,
          .width_m = 5.185,
          .height_m = 2.238,
          .tile_width_px = 1024,
          .tile_height_px = 768,
          .mount = {}};
}

WallLayout layout(const WallGrid& grid, double scale) {
  return layout_of(expand_wall(grid, {}, {}), scale);
}

bool overlap(const RectPx& a, const RectPx& b) {
  return a.x < b.x + b.size.width && b.x < a.x + a.size.width && a.y < b.y + b.size.height &&
         b.y < a.y + a.size.height;
}

TEST(Layout, JoinsTilesWithoutBezelsToTheWholeWallsPixels) {
  const WallLayout full = layout(tromso_grid(), 1);
  EXPECT_EQ(full.size, (SizePx{7168, 3072}));
  EXPECT_EQ(full.tiles.size(), 28u);
}

TEST(Layout, CountsFromTheLowerLeft) {
  const WallLayout full = layout(tromso_grid(), 1);
  EXPECT_EQ(full.tiles.front().x, 0);
  EXPECT_EQ(full.tiles.front().y, 0);
  EXPECT_EQ(full.tiles.back().x, 6 * 1024);
  EXPECT_EQ(full.tiles.back().y, 3 * 768);
  EXPECT_EQ(full.tiles[1].x, 1024);
  EXPECT_EQ(full.tiles[1].y, 0);
}

TEST(Layout, LeavesBezelsAsGapsOfTheirWidthInPixels) {
  WallGrid grid{.columns = 3, .rows = 2, .width_m = 3.04, .height_m = 1.01, .mount = {}};
  grid.tile_width_px = 1000;
  grid.tile_height_px = 500;
  grid.bezel_x_mm = 20;
  grid.bezel_y_mm = 10;
  const WallLayout full = layout(grid, 1);
  EXPECT_EQ(full.tiles[1].x, 1020);
  EXPECT_EQ(full.tiles[3].y, 510);
  EXPECT_EQ(full.size, (SizePx{3040, 1010}));
}

TEST(Layout, ScalesTilesAndBezels) {
  WallGrid grid{.columns = 2, .rows = 1, .width_m = 2.02, .height_m = 0.5, .mount = {}};
  grid.tile_width_px = 1000;
  grid.tile_height_px = 500;
  grid.bezel_x_mm = 20;
  const WallLayout half = layout(grid, 0.5);
  EXPECT_EQ(half.tiles[1].size, (SizePx{500, 250}));
  EXPECT_EQ(half.tiles[1].x, 510);
}

TEST(Layout, NeverOverlapsAndNeverVanishesWhateverTheScale) {
  WallGrid grid = tromso_grid();
  grid.bezel_x_mm = 3;
  for (const double scale : {0.0001, 0.005, 0.01, 0.0333, 0.1, 0.123, 0.5, 0.999, 1.7}) {
    const WallLayout all = layout(grid, scale);
    for (std::size_t a = 0; a < all.tiles.size(); ++a) {
      EXPECT_GE(all.tiles[a].size.width, 1);
      EXPECT_GE(all.tiles[a].size.height, 1);
      EXPECT_LE(all.tiles[a].x + all.tiles[a].size.width, all.size.width);
      EXPECT_LE(all.tiles[a].y + all.tiles[a].size.height, all.size.height);
      for (std::size_t b = a + 1; b < all.tiles.size(); ++b)
        EXPECT_FALSE(overlap(all.tiles[a], all.tiles[b])) << "scale " << scale;
    }
  }
}

TEST(Layout, HoldsTilesOfOtherPixelSizes) {
  Wall wall = expand_wall(tromso_grid(), {}, {});
  wall.tiles.back().width_px = 2000;
  wall.tiles.back().height_px = 100;
  const WallLayout mixed = layout_of(wall, 0.5);
  EXPECT_EQ(mixed.tiles.back().size, (SizePx{1000, 50}));
  EXPECT_EQ(mixed.tiles.back().x, 6 * 512);
  EXPECT_EQ(mixed.size.width, 6 * 512 + 1000);
  EXPECT_EQ(mixed.size.height, 4 * 384);
}

/// Where a point of the picture comes out on the display, both from -1 to 1, y up.
Vec3 on_display(const TileMount& mount, double x, double y) {
  return picture_from_display(mount).inverse() * Vec3(x, y, 1);
}

TEST(PictureFromDisplay, IsNothingForADisplayThatHangsUpright) {
  EXPECT_THAT(on_display({}, 0.3, 0.7), IsNearPoint(Vec3(0.3, 0.7, 1), 1e-12));
}

TEST(PictureFromDisplay, MirrorsLeftAndRightForAProjectorBehindTheScreen) {
  EXPECT_THAT(on_display({.mirror = true}, 0.3, 0.7), IsNearPoint(Vec3(-0.3, 0.7, 1), 1e-12));
}

// Clockwise: the picture's upper edge goes to the display's right, bottom, left.
TEST(PictureFromDisplay, TurnsClockwise) {
  const auto top = [](int rotate_deg) { return on_display({.rotate_deg = rotate_deg}, 0, 1); };
  EXPECT_THAT(top(90), IsNearPoint(Vec3(1, 0, 1), 1e-12));
  EXPECT_THAT(top(180), IsNearPoint(Vec3(0, -1, 1), 1e-12));
  EXPECT_THAT(top(270), IsNearPoint(Vec3(-1, 0, 1), 1e-12));
}

TEST(PictureFromDisplay, MirrorsFirstAndTurnsThen) {
  const TileMount mount{.mirror = true, .rotate_deg = 90};
  // The picture's right edge: mirrored to the left, then turned clockwise to the top.
  EXPECT_THAT(on_display(mount, 1, 0), IsNearPoint(Vec3(0, 1, 1), 1e-12));
  EXPECT_THAT(on_display(mount, 0, 1), IsNearPoint(Vec3(1, 0, 1), 1e-12));
}

}  // namespace
}  // namespace vindu
