// Pictures onto displays that hang mirrored or turned: pixels must arrive unchanged, at their
// place.
#include <random>

#include "tests/renderer/gl_test.h"

namespace vindu {
namespace {

using namespace testing;

class PresentGl : public GlTest {};

/// Neighbours differ much, so that the least blur shows.
Image noise(SizePx size) {
  std::mt19937 random(3);
  Image image = Image::filled(size.width, size.height, kBlack);
  for (Rgba8& pixel : image.pixels)
    for (int part = 0; part < 3; ++part) pixel[part] = static_cast<std::uint8_t>(random());
  return image;
}

void upload(const Image& image, Picture& picture) {
  for (int y = 0; y < image.height_px; ++y)
    glTextureSubImage2D(picture.texture(), 0, 0, image.height_px - 1 - y, image.width_px, 1,
                        GL_RGBA, GL_UNSIGNED_BYTE, &image.at(0, y));
  picture.make_mipmaps();
}

/// The display's pixels as its own electronics count them, for a display that hangs so.
Image presented(const Image& image, const TileMount& mount, Style style) {
  const SizePx size{image.width_px, image.height_px};
  const SizePx display_size = mount.rotate_deg % 180 == 90 ? SizePx{size.height, size.width} : size;
  Picture picture(size, style), display(display_size, style);
  upload(image, picture);
  glBindFramebuffer(GL_FRAMEBUFFER, display.framebuffer());
  glViewport(0, 0, display_size.width, display_size.height);
  SceneRenderer(style).present(picture, mount);
  return display.read();
}

Image mirrored(const Image& image) {
  Image result = image;
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) result.at(x, y) = image.at(image.width_px - 1 - x, y);
  return result;
}

Image turned_clockwise(const Image& image) {
  Image result = Image::filled(image.height_px, image.width_px, kBlack);
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) result.at(image.height_px - 1 - y, x) = image.at(x, y);
  return result;
}

class Mounts : public PresentGl, public ::testing::WithParamInterface<TileMount> {};

TEST_P(Mounts, MovePixelsAndChangeNone) {
  const Image image = noise({180, 120});
  Image wanted = GetParam().mirror ? mirrored(image) : image;
  for (int turns = 0; turns < GetParam().rotate_deg / 90; ++turns)
    wanted = turned_clockwise(wanted);
  for (const Style style : {Style::lit, Style::unlit}) {
    const Image display = presented(image, GetParam(), style);
    ASSERT_EQ(display.width_px, wanted.width_px);
    for (int y = 0; y < wanted.height_px; ++y)
      for (int x = 0; x < wanted.width_px; ++x)
        ASSERT_THAT(display.at(x, y), IsNearColour(wanted.at(x, y), style == Style::lit ? 1 : 0))
            << x << ", " << y;
  }
}

TEST_P(Mounts, TakeAPartOfThePictureOfSeveralTiles) {
  const Image left = noise({90, 120}), right = mirrored(noise({90, 120}));
  Image both = Image::filled(180, 120, kBlack);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 90; ++x) {
      both.at(x, y) = left.at(x, y);
      both.at(90 + x, y) = right.at(x, y);
    }
  Image wanted = GetParam().mirror ? mirrored(right) : right;
  for (int turns = 0; turns < GetParam().rotate_deg / 90; ++turns)
    wanted = turned_clockwise(wanted);
  const SizePx size{wanted.width_px, wanted.height_px};
  Picture picture({180, 120}, Style::unlit), display(size, Style::unlit);
  upload(both, picture);
  glBindFramebuffer(GL_FRAMEBUFFER, display.framebuffer());
  glViewport(0, 0, size.width, size.height);
  SceneRenderer(Style::unlit).present(picture, GetParam(), {90, 0, {90, 120}});
  EXPECT_EQ(display.read().pixels, wanted.pixels);
}

INSTANTIATE_TEST_SUITE_P(PresentGl, Mounts,
                         ::testing::Values(TileMount{false, 0}, TileMount{true, 0},
                                           TileMount{false, 90}, TileMount{true, 90},
                                           TileMount{false, 180}, TileMount{true, 180},
                                           TileMount{false, 270}, TileMount{true, 270}),
                         [](const auto& tested) {
                           return (tested.param.mirror ? "Mirrored" : "Plain") +
                                  std::to_string(tested.param.rotate_deg);
                         });

}  // namespace
}  // namespace vindu
