// The comparison itself: what it lets pass and what not.
#include "tests/golden/compare.h"

#include <gmock/gmock.h>

namespace vindu::testing {
namespace {

Image grey(std::uint8_t level) { return Image::filled(10, 10, {level, level, level, 255}); }

TEST(Compare, FindsNoDifferenceInOnePicture) {
  const auto difference = difference_of(grey(100), grey(100));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->largest_levels, 0);
  EXPECT_EQ(difference->mean_levels, 0);
}

TEST(Compare, TellsTheLargestAndTheMeanOfTheLargestChannel) {
  Image changed = grey(100);
  changed.at(3, 3) = {90, 105, 100, 255};
  changed.at(4, 4) = {100, 100, 130, 255};
  const auto difference = difference_of(changed, grey(100));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->largest_levels, 30);
  EXPECT_DOUBLE_EQ(difference->mean_levels, 0.4);
}

TEST(Compare, IgnoresAlpha) {
  Image changed = grey(100);
  changed.at(3, 3)[3] = 0;
  EXPECT_EQ(difference_of(changed, grey(100))->largest_levels, 0);
}

TEST(Compare, HasNoAnswerForOtherSizesAndForNothing) {
  EXPECT_FALSE(difference_of(grey(1), Image::filled(10, 9, {})));
  EXPECT_FALSE(difference_of({}, {}));
}

TEST(Compare, ShowsWhereTheDifferencesAre) {
  Image changed = grey(100);
  changed.at(2, 7) = {101, 100, 90, 255};
  const Image picture = difference_picture(changed, grey(100));
  EXPECT_EQ(picture.at(2, 7), (Rgba8{80, 64, 224, 255}));
  EXPECT_EQ(picture.at(7, 2), (Rgba8{64, 64, 64, 255}));
}

}  // namespace
}  // namespace vindu::testing
