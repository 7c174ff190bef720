// Canvases and pictures: which way up they are, what clearing and resolving do to their bytes, and
// sizes that no GPU has.
#include "renderer/canvas.h"

#include "core/error.h"
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Each;
using ::testing::HasSubstr;

class CanvasGl : public GlTest {};

TEST_F(CanvasGl, ClearsAPictureToTheBytesAsTheyAre) {
  for (const Style style : {Style::lit, Style::unlit}) {
    Picture picture({5, 3}, style);
    picture.clear({1, 100, 254, 255});
    EXPECT_THAT(picture.read().pixels, Each(Rgba8{1, 100, 254, 255}));
  }
}

TEST_F(CanvasGl, BeginsBlackAndOpaque) {
  for (const Style style : {Style::lit, Style::unlit}) {
    Canvas canvas({7, 4}, Look{style});
    Picture picture({7, 4}, style);
    picture.clear(kWhite);
    canvas.begin();
    canvas.resolve(picture);
    EXPECT_THAT(picture.read().pixels, Each(kBlack));
  }
}

/// A canvas cleared to one colour by scissors, without any shader of ours.
void fill_part(Canvas& canvas, int x, int y, SizePx size, float level) {
  canvas.begin();
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, size.width, size.height);
  glClearColor(level, level, level, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

TEST_F(CanvasGl, ReadsTheUpperLeftAsUpperLeft) {
  Canvas canvas({8, 6}, Look{Style::unlit});
  Picture picture({8, 6}, Style::unlit);
  fill_part(canvas, 0, 4, {3, 2}, 1);  // OpenGL counts from below
  canvas.resolve(picture);
  const Image image = picture.read();
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(image.at(x, y), x < 3 && y < 2 ? kWhite : kBlack) << x << ", " << y;
}

TEST_F(CanvasGl, ResolvesToAPlaceCountedFromTheLowerLeftAndReadsItBackThere) {
  Canvas canvas({2, 3}, Look{Style::unlit});
  Picture picture({9, 7}, Style::unlit);
  picture.clear(kBlue);
  fill_part(canvas, 0, 2, {2, 1}, 1);  // its upper row
  canvas.resolve({0, 0, canvas.size()}, picture, 4, 1);
  const Image part = picture.read({4, 1, {2, 3}});
  EXPECT_EQ(part.at(0, 0), kWhite);
  EXPECT_EQ(part.at(1, 1), kBlack);
  const Image whole = picture.read();
  EXPECT_EQ(whole.at(4, 7 - 1 - 3), kWhite);
  EXPECT_EQ(whole.at(3, 3), kBlue);
  EXPECT_EQ(whole.at(6, 3), kBlue);
}

// The same edge cuts every pixel of a column in halves: 2 of 4 samples are white. Half the light of
// white is 188 in sRGB; the mean of the bytes would be 128.
TEST_F(CanvasGl, AveragesLightAndNotBytesAtEdges) {
  const float middle_of_pixel = 0.5f / 32;  // of column 32
  const Scene scene =
      square_scene(plain(1, 1, 1), moved_by(1 + middle_of_pixel, 0, 0) * scaled_by(1, 2, 1));
  Scene behind = scene;
  add_square(behind, plain(0, 0, 0), moved_by(0, 0, -0.01f) * scaled_by(3, 3, 1));
  const Image image = draw_on_stage(behind, Style::lit);
  EXPECT_THAT(image.at(20, 30), IsNearColour(kBlack, 0));
  EXPECT_THAT(image.at(32, 30), IsNearColour(Rgba8{188, 188, 188, 255}, 1));
  EXPECT_THAT(image.at(40, 30), IsNearColour(kWhite, 0));
}

TEST_F(CanvasGl, HasAsManySamplesAsAreAskedFor) {
  for (const int samples : {1, 4}) {
    Canvas canvas({4, 4}, Look{.samples = samples});
    canvas.begin();
    GLint found = 0;
    glGetIntegerv(GL_SAMPLES, &found);
    EXPECT_EQ(std::max(found, 1), samples);
  }
}

TEST_F(CanvasGl, HasNoMultisamplingWhereItIsForMeasuring) {
  Eigen::Matrix4f tilted = Eigen::Matrix4f::Identity();
  tilted.topLeftCorner<3, 3>() =
      Eigen::AngleAxisf(0.3f, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  const Image image =
      draw_on_stage(square_scene(plain(1, 1, 1), tilted * scaled_by(.5, .5, 1)), Style::unlit);
  for (const Rgba8& pixel : image.pixels)
    EXPECT_TRUE(pixel == kBlack || pixel == kWhite) << int{pixel[0]};
}

TEST_F(CanvasGl, RefusesSizesThatTheGpuCannotMakeAndSaysWhatItCan) {
  const auto complaint = [](auto make) -> std::string {
    try {
      make();
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  for (const SizePx size : {SizePx{1 << 20, 4}, SizePx{4, 1 << 20}}) {
    const std::string shown = std::to_string(size.width) + "x" + std::to_string(size.height);
    for (const std::string& text : {complaint([&] { Picture(size, Style::lit); }),
                                    complaint([&] { Canvas(size, Look{Style::lit}); })}) {
      EXPECT_THAT(text, HasSubstr(shown));
      EXPECT_THAT(text, HasSubstr("--scale"));
      EXPECT_THAT(text, HasSubstr("largest side"));
    }
  }
}

}  // namespace
}  // namespace vindu
