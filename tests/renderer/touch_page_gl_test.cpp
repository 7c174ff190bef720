// The page on displays that hang mirrored or turned: seen from the front, its mark stands where the
// wall's geometry has the point.
#include "renderer/touch_page.h"

#include "tests/renderer/gl_test.h"

namespace vindu {
namespace {

using namespace testing;

class TouchPageGl : public GlTest, public ::testing::WithParamInterface<TileMount> {};

/// Where on the display's own pixels, x right and y down, a place of the picture comes to lie, by
/// the words of TileMount: first mirrored, then turned clockwise.
Vec2 on_display(Vec2 place_px, SizePx size, const TileMount& mount) {
  if (mount.mirror) place_px.x() = size.width - place_px.x();
  for (int turn = 0; turn < mount.rotate_deg / 90; ++turn) {
    place_px = Vec2(size.height - place_px.y(), place_px.x());
    std::swap(size.width, size.height);
  }
  return place_px;
}

TEST_P(TouchPageGl, MarksThePointOnTheDisplayAsItIsMounted) {
  const SizePx size{400, 300};
  const Tile tile = single_screen(0.4, 0.3, size.width, size.height).tiles.front();
  const TouchPage page{.points = {{{-0.08, 0.05, 0}, ""}}, .remark = {}, .ring_m = 0.05};
  Picture picture(size, Style::unlit);
  picture.write(draw_touch_page(page, tile, size));
  picture.make_mipmaps();
  const bool upright = GetParam().rotate_deg % 180 == 90;
  Picture display(upright ? SizePx{size.height, size.width} : size, Style::unlit);
  glBindFramebuffer(GL_FRAMEBUFFER, display.framebuffer());
  glViewport(0, 0, display.size().width, display.size().height);
  SceneRenderer(Style::unlit).present(picture, GetParam());

  const Image seen = display.read();
  Vec2 sum_px = Vec2::Zero();
  int count = 0;
  for (int y = 0; y < seen.height_px; ++y)
    for (int x = 0; x < seen.width_px; ++x)
      if (seen.at(x, y) == Rgba8{240, 228, 66, 255}) {
        sum_px += Vec2(x + 0.5, y + 0.5);
        ++count;
      }
  ASSERT_GT(count, 100);
  const Vec2 wanted_px = on_display({120, 100}, size, GetParam());
  EXPECT_LT((sum_px / count - wanted_px).norm(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Mounts, TouchPageGl,
                         ::testing::Values(TileMount{false, 0}, TileMount{true, 0},
                                           TileMount{false, 90}, TileMount{true, 270}));

}  // namespace
}  // namespace vindu
