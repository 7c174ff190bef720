// A scene's animations by name or number, and what is said where there is none of that name.
#include "renderer/clips.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<std::string> kClips = {"Walk", "Run", "", "2", "Run"};

std::string complaint_about(const std::vector<std::string>& clips, const std::string& wish) {
  try {
    find_clip(clips, wish, "beast.x");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Clips, AreFoundByNameThenByNumber) {
  EXPECT_EQ(find_clip(kClips, "Run", ""), 1);
  EXPECT_EQ(find_clip(kClips, "1", ""), 0);
  EXPECT_EQ(find_clip(kClips, "3", ""), 2);
  EXPECT_EQ(find_clip(kClips, "2", ""), 3);  // which is called that
}

TEST(Clips, MayBeLeftToTheFirstOrRest) {
  EXPECT_EQ(find_clip(kClips, "", ""), 0);
  EXPECT_EQ(find_clip({}, "", ""), 0);
  EXPECT_EQ(find_clip(kClips, "rest", ""), kAtRest);
  EXPECT_EQ(find_clip({}, "rest", ""), kAtRest);
  EXPECT_EQ(find_clip({"wild", "rest"}, "rest", ""), 1);
}

TEST(Clips, ThatAreNotThereAreRefusedWithAListOfThoseThatAre) {
  for (const char* wish : {"walk", "0", "6", "-1", "1.5", "1 ", "99999999999999999999"})
    EXPECT_THAT(complaint_about(kClips, wish),
                AllOf(HasSubstr("beast.x"), HasSubstr(wish),
                      HasSubstr("1 Walk, 2 Run, 3 (no name), 4 2, 5 Run")))
        << wish;
  EXPECT_THAT(complaint_about({}, "Walk"), HasSubstr("has no clips"));
}

}  // namespace
}  // namespace vindu
