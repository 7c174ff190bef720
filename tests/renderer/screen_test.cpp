// Which sizes that screens report are believed.
#include <gmock/gmock.h>

#include "renderer/surface.h"

namespace vindu {
namespace {

using ::testing::HasSubstr;

ScreenReport screen(SizePx size, int width_mm, int height_mm) {
  return {.name = "screen", .size = size, .width_mm = width_mm, .height_mm = height_mm};
}

struct RealScreen {
  const char* what;
  ScreenReport report;
};

class RealScreens : public ::testing::TestWithParam<RealScreen> {};

TEST_P(RealScreens, AreBelieved) { EXPECT_EQ(doubt_about(GetParam().report), ""); }

INSTANTIATE_TEST_SUITE_P(
    DoubtAbout, RealScreens,
    ::testing::Values(RealScreen{"23 inches, 1920x1080", screen({1920, 1080}, 509, 286)},
                      RealScreen{"24 inches, 1920x1200", screen({1920, 1200}, 518, 324)},
                      RealScreen{"27 inches, 3840x2160", screen({3840, 2160}, 597, 336)},
                      RealScreen{"13 inches, 2560x1600", screen({2560, 1600}, 286, 179)},
                      RealScreen{"55 inches, 1920x1080", screen({1920, 1080}, 1210, 680)},
                      RealScreen{"upright, 1080x1920", screen({1080, 1920}, 299, 531)}),
    [](const auto& tested) { return "Screen" + std::to_string(tested.index); });

// Xvfb works its size out of 96 dpi (or of what -dpi says), rounded.
TEST(DoubtAbout, NamesTheSizeThatXvfbInvents) {
  EXPECT_THAT(doubt_about(screen({1280, 1024}, 339, 271)), HasSubstr("invent"));
  EXPECT_THAT(doubt_about(screen({1920, 1080}, 508, 286)), HasSubstr("invent"));
}

TEST(DoubtAbout, NamesAScreenWithoutASize) {
  EXPECT_THAT(doubt_about(screen({1920, 1080}, 0, 0)), HasSubstr("no size"));
  EXPECT_THAT(doubt_about(screen({1920, 1080}, 520, 0)), HasSubstr("no size"));
  EXPECT_THAT(doubt_about(screen({1920, 1080}, -5, 300)), HasSubstr("no size"));
  EXPECT_THAT(doubt_about({}), HasSubstr("no size"));
}

// A projector that says 16 x 9 mm, and a television that says 1.6 x 0.9 m for a small panel.
TEST(DoubtAbout, NamesTheDotsPerInchThatCannotBe) {
  EXPECT_THAT(doubt_about(screen({1920, 1080}, 16, 9)), HasSubstr("dpi"));
  EXPECT_THAT(doubt_about(screen({1024, 768}, 4000, 3000)), HasSubstr("dpi"));
}

TEST(DoubtAbout, NamesPixelsThatWouldNotBeSquare) {
  EXPECT_THAT(doubt_about(screen({1920, 1080}, 531, 531)), HasSubstr("not square"));
}

}  // namespace
}  // namespace vindu
