// The one exception, and the suggestion for a word that was misspelt.
#include "core/error.h"

#include <gtest/gtest.h>

#include <vector>

namespace vindu {
namespace {

TEST(Error, ReadsAsWhereWhatRemedy) {
  EXPECT_STREQ(Error(ErrorText{"is missing", "wall.toml:3", "add it"}).what(),
               "wall.toml:3: is missing; add it");
}

TEST(Error, LeavesOutWhatIsNotThere) {
  EXPECT_STREQ(Error(ErrorText{"no display", "", ""}).what(), "no display");
  EXPECT_STREQ(Error(ErrorText{"no display", "tile-0-0", ""}).what(), "tile-0-0: no display");
  EXPECT_STREQ(Error(ErrorText{"no display", "", "start X"}).what(), "no display; start X");
}

const std::vector<std::string> kFields = {"columns", "rows", "width_m", "height_m", "hosts"};

TEST(NearestName, FindsTheFieldThatWasMeant) {
  EXPECT_EQ(nearest_name("colums", kFields), "columns");
  EXPECT_EQ(nearest_name("width", kFields), "width_m");
  EXPECT_EQ(nearest_name("heigth_m", kFields), "height_m");
  EXPECT_EQ(nearest_name("hots", kFields), "hosts");
}

TEST(NearestName, IsEmptyWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("temperature", kFields), "");
  EXPECT_EQ(nearest_name("", kFields), "");
  EXPECT_EQ(nearest_name("rows", {}), "");
}

TEST(NearestName, DoesNotReplaceEveryLetter) {
  const std::vector<std::string> names = {"xy"};
  EXPECT_EQ(nearest_name("ab", names), "");
}

TEST(NearestName, PrefersTheNearerOfTwo) {
  const std::vector<std::string> names = {"bezel_x_mm", "bezel_y_mm"};
  EXPECT_EQ(nearest_name("bezel_ymm", names), "bezel_y_mm");
}

}  // namespace
}  // namespace vindu
