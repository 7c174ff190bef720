// Words on pictures: how wide they are, that they stay inside, and text that is not quite UTF-8.
#include "renderer/text.h"

#include <gmock/gmock.h>

#include <string>

#include "renderer/canvas.h"

namespace vindu {
namespace {

constexpr Rgba8 kDark{10, 20, 30, 255};

struct Ink {
  int left = 1 << 20;
  int right = -1;
  int top = 1 << 20;
  int bottom = -1;
  int pixels = 0;
};

/// Where the image is no longer what it was filled with.
Ink ink_of(const Image& image) {
  Ink ink;
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x)
      if (image.at(x, y) != kDark) {
        ink.left = std::min(ink.left, x);
        ink.right = std::max(ink.right, x);
        ink.top = std::min(ink.top, y);
        ink.bottom = std::max(ink.bottom, y);
        ++ink.pixels;
      }
  return ink;
}

Image written(std::string_view text, int x, int y, SizePx size, const TextStyle& style = {}) {
  Image image = Image::filled(size.width, size.height, kDark);
  draw_text(image, x, y, text, style);
  return image;
}

TEST(Text, IsAsWideAsItsWidthSays) {
  const std::string text = "Head-coupled wall";
  const Ink ink = ink_of(written(text, 20, 10, {400, 60}));
  const int width_px = text_width_px(text, {});
  EXPECT_GE(ink.left, 20);
  EXPECT_LE(ink.left, 24);
  EXPECT_NEAR(ink.right, 20 + width_px, 4);
}

TEST(Text, IsAsHighAsItsStyleSays) {
  const Ink ink = ink_of(written("Ågjp|", 20, 10, {400, 80}, {.height_px = 40}));
  EXPECT_GE(ink.top, 10);
  EXPECT_LE(ink.bottom, 10 + 40);
  EXPECT_GT(ink.bottom - ink.top, 25);
}

TEST(Text, GrowsWithItsHeightAndWithBold) {
  EXPECT_NEAR(text_width_px("wall", {.height_px = 60}),
              3 * text_width_px("wall", {.height_px = 20}), 3);
  EXPECT_GT(text_width_px("wall", {.bold = true}), text_width_px("wall", {}));
}

TEST(Text, HasNoWidthAndNoInkWhenEmpty) {
  EXPECT_EQ(text_width_px("", {}), 0);
  EXPECT_EQ(ink_of(written("", 5, 5, {50, 50})).pixels, 0);
}

TEST(Text, TakesItsColour) {
  const Image image = written("I", 5, 5, {60, 60}, {.height_px = 48, .colour = {200, 0, 100, 255}});
  EXPECT_THAT(image.pixels, ::testing::Contains(Rgba8{200, 0, 100, 255}));
}

TEST(Text, IsCutAtEveryBorder) {
  const Image whole = written("WWWW", 100, 100, {300, 300}, {.height_px = 40});
  for (const auto& [x, y] :
       {std::pair{-20, 5}, {20, -20}, {60, 5}, {5, 60}, {-500, 5}, {500, 500}}) {
    const Image cut = written("WWWW", x, y, {80, 80}, {.height_px = 40});
    for (int row = 0; row < 80; ++row)
      for (int column = 0; column < 80; ++column) {
        const int from_x = column - x + 100, from_y = row - y + 100;
        const bool inside = from_x >= 0 && from_y >= 0 && from_x < 300 && from_y < 300;
        const Rgba8 wanted = inside ? whole.at(from_x, from_y) : kDark;
        ASSERT_EQ(cut.at(column, row), wanted) << "text at " << x << ", " << y;
      }
  }
}

TEST(Text, CountsACharacterOfSeveralBytesOnce) {
  EXPECT_EQ(text_width_px("ø", {}), text_width_px("o", {}));
  EXPECT_LT(text_width_px("Tromsø", {}), text_width_px("Tromsoe", {}));
}

struct BrokenText {
  std::string text;
  std::string shown;  ///< with U+FFFD for what is broken
};

class BrokenUtf8 : public ::testing::TestWithParam<BrokenText> {};

TEST_P(BrokenUtf8, ShowsReplacementCharactersAndEverythingElse) {
  const auto& [text, shown] = GetParam();
  EXPECT_EQ(written(text, 5, 5, {200, 40}), written(shown, 5, 5, {200, 40}));
  EXPECT_EQ(text_width_px(text, {}), text_width_px(shown, {}));
}

INSTANTIATE_TEST_SUITE_P(Text, BrokenUtf8,
                         ::testing::Values(BrokenText{"a\xff"
                                                      "b",
                                                      "a\ufffdb"},
                                           BrokenText{"a\x80"
                                                      "b",
                                                      "a\ufffdb"},
                                           BrokenText{"ab\xc3", "ab\ufffd"},
                                           BrokenText{"a\xc3"
                                                      "bc",
                                                      "a\ufffdbc"},
                                           BrokenText{"\xe2\x82", "\ufffd\ufffd"},
                                           BrokenText{"\xf0\x9f", "\ufffd\ufffd"}));

}  // namespace
}  // namespace vindu
