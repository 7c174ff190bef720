// The page of figures: what fits is shown, the more important first, and a new frame changes its
// bar as drawing the whole page anew would.
#include "renderer/overlay_page.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

using std::chrono::microseconds;

FrameParts parts_of_frame(std::size_t frame) {
  FrameParts parts;
  parts[Part::solve] = microseconds(500);
  parts[Part::draw] = microseconds(5000 + 700 * (frame * 7 % 11));
  parts[Part::barrier] = microseconds(900 * (frame * 5 % 7));
  parts[Part::display] = microseconds(8000);
  return parts;
}

OverlayPage page_with(std::size_t frames) {
  OverlayPage page{
      .title = "tile-3-0",
      .aside = "59.9 fps",
      .below = "tile-3-0, llvmpipe",
      .timeline = FrameTimeline{.full_ms = 30, .mean_ms = {8, 0.5, 0.2, 0, 8, 3, 0.1, 8}},
      .rows = {{"", {"p50", "p99", "max"}},
               {"motion to photon, ms", {"31.2", "40.1", "51.0"}},
               {"GPU", {"5.8 ms"}},
               {"memory", {"182 MB"}}}};
  for (std::size_t frame = 0; frame < frames; ++frame) page.timeline->add(parts_of_frame(frame));
  return page;
}

constexpr SizePx kTile{1000, 750};

TEST(OverlayPage, HasEverythingOnATileOfUsualSize) {
  const OverlayLayout layout = layout_of(page_with(10), kTile);
  EXPECT_EQ(layout.bars, 120);
  EXPECT_GT(layout.legend_y_px, 0);
  EXPECT_GT(layout.below_y_px, 0);
  EXPECT_EQ(layout.rows.size(), 4u);
  EXPECT_LT(layout.size.width, kTile.width / 2);
  EXPECT_LT(layout.size.height, kTile.height / 2 + 100);
}

TEST(OverlayPage, KeepsWithinEveryTileAndLeavesOutWhatDoesNotFit) {
  for (const SizePx room :
       {SizePx{100, 75}, {40, 24}, {60, 400}, {700, 40}, {300, 225}, {1900, 1000}}) {
    const OverlayPage page = page_with(300);
    const OverlayLayout layout = layout_of(page, room);
    EXPECT_LE(layout.size.width, room.width);
    EXPECT_LE(layout.size.height, room.height);
    const Image picture = draw_page(page, layout);
    EXPECT_EQ(picture.width_px, layout.size.width);
    EXPECT_EQ(picture.height_px, layout.size.height);
  }
  const OverlayLayout small = layout_of(page_with(10), {100, 75});
  EXPECT_GT(small.plot_height_px, 10);
  EXPECT_EQ(small.legend_y_px, 0);
  EXPECT_EQ(small.rows, (std::vector<std::size_t>{2}));  // three columns do not fit
}

TEST(OverlayPage, ShowsANewFrameAsDrawingAllOfItAnewDoes) {
  for (const std::size_t frames : {1u, 60u, 119u, 120u, 121u, 240u, 335u}) {
    const OverlayLayout layout = layout_of(page_with(0), kTile);
    Image picture = draw_page(page_with(frames - 1), layout);
    const OverlayPage page = page_with(frames);
    const Image before = picture;
    const ColumnsPx changed = draw_bar(*page.timeline, frames - 1, layout, picture);
    EXPECT_EQ(picture, draw_page(page, layout)) << frames;
    for (int x = 0; x < picture.width_px; ++x)
      for (int y = 0; y < picture.height_px; ++y)
        if (x < changed.x || x >= changed.x + changed.width) {
          ASSERT_EQ(picture.at(x, y), before.at(x, y));
        }
  }
}

TEST(OverlayPage, DrawsBarsAsLongAsTheirParts) {
  OverlayPage page = page_with(0);
  FrameParts parts;
  parts[Part::draw] = microseconds(15000);
  page.timeline->add(parts);
  const OverlayLayout layout = layout_of(page, kTile);
  const Image picture = draw_page(page, layout);
  int green = 0;
  for (int y = 0; y < picture.height_px; ++y)
    green += picture.at(layout.pad_px, y) == Rgba8{0, 158, 115, 255};
  EXPECT_NEAR(green, 0.5 * layout.plot_height_px, 1);
}

TEST(OverlayPage, HasARoundScaleAboveTheLongestFrame) {
  EXPECT_EQ(full_scale_ms(0), 10);
  EXPECT_EQ(full_scale_ms(17), 20);
  EXPECT_EQ(full_scale_ms(19), 30);
  EXPECT_EQ(full_scale_ms(1e9), 3000);
}

}  // namespace
}  // namespace vindu
