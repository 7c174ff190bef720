// Figures over a picture: in their corner alone, the same every time; and the GPU's timer.
#include "renderer/overlay.h"

#include "renderer/gpu_timer.h"
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;

class OverlayGl : public GlTest {
 protected:
  static constexpr SizePx kSize{512, 384};
  static constexpr Rgba8 kScene{90, 120, 60, 255};

  static OverlayPage page(std::size_t frames) {
    OverlayPage page{.title = "tile-0-0", .timeline = FrameTimeline{}, .rows = {{"GPU", {"5 ms"}}}};
    for (std::size_t frame = 0; frame < frames; ++frame) {
      FrameParts parts;
      parts[Part::draw] = std::chrono::milliseconds(10 + frame % 9);
      page.timeline->add(parts);
    }
    return page;
  }

  /// What a plain picture looks like with the panel over it.
  Image drawn(OverlayPanel& panel, std::size_t frames) const {
    Picture picture(kSize, Style::lit);
    picture.clear(kScene);
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
    panel.draw(page(frames), {8, 8, {kSize.width - 16, kSize.height - 16}}, renderer_);
    return picture.read();
  }

  SceneRenderer renderer_{Style::lit};
};

TEST_F(OverlayGl, CoversItsCornerAndNothingElse) {
  OverlayPanel panel;
  const Image picture = drawn(panel, 30);
  const OverlayLayout layout = layout_of(page(30), {kSize.width - 16, kSize.height - 16});
  int dark = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const bool inside =
          x >= 8 && x < 8 + layout.size.width && y >= 8 && y < 8 + layout.size.height;
      if (!inside) {
        ASSERT_THAT(picture.at(x, y), IsNearColour(kScene, 0)) << x << ", " << y;
      }
      dark += inside && picture.at(x, y)[1] < 60;
    }
  EXPECT_GT(dark, layout.size.width * layout.size.height / 2);
}

TEST_F(OverlayGl, IsTheSameWhetherKeptOrDrawnAnew) {
  OverlayPanel kept;
  for (std::size_t frames = 1; frames < 260; ++frames) drawn(kept, frames);
  OverlayPanel fresh;
  EXPECT_EQ(drawn(kept, 260), drawn(fresh, 260));
  EXPECT_EQ(drawn(fresh, 260), drawn(fresh, 260));
  EXPECT_NE(drawn(fresh, 261), drawn(kept, 260));
}

TEST_F(OverlayGl, LeavesTheRendererAsItWas) {
  Scene scene;
  add_square(scene, plain(1, 0, 0), scaled_by(.5f, .5f, 1));
  const Image before = draw_on_stage(scene, Style::lit);
  OverlayPanel panel;
  drawn(panel, 3);
  EXPECT_EQ(draw_on_stage(scene, Style::lit), before);
  GLint source = 0;
  glGetIntegerv(GL_BLEND_SRC_RGB, &source);
  EXPECT_EQ(source, GL_SRC_ALPHA);
}

TEST_F(OverlayGl, HasNoPlaceOnATinyTile) {
  OverlayPanel panel;
  EXPECT_EQ(panel.draw(page(3), {0, 0, {30, 20}}, renderer_), 0);
}

TEST_F(OverlayGl, TheTimerKnowsAFrameThatIsDoneAndNeverWaits) {
  GpuTimer timer;
  EXPECT_FALSE(timer.newest());
  Scene scene;
  add_square(scene, plain(1, 0, 0), scaled_by(.5f, .5f, 1));
  for (int frame = 0; frame < 20; ++frame) {
    timer.begin();
    draw_on_stage(scene, Style::unlit);
    timer.end();
  }
  glFinish();
  ASSERT_TRUE(timer.newest());
  EXPECT_GT(*timer.newest(), Duration{});
}

}  // namespace
}  // namespace vindu
