// vindu plan: figures, picture, and proposals that the other commands take.
#include <utility>

#include "renderer/image.h"
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using PlanCommand = AppTest;

TEST_F(PlanCommand, SaysHowMuchOfTheAreaTheThesisCamerasCover) {
  const ProcessResult result = vindu({"plan", "--out", path("plan.png")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("Walking area"), HasSubstr("2 cameras of the wall file"),
                                HasSubstr("six-dof"), HasSubstr("bearing"), HasSubstr("lost"),
                                HasSubstr(path("plan.png"))));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(PlanCommand, DrawsLevelsAndErrors) {
  ASSERT_EQ(vindu({"plan", "--out", path("plan.png")}).exit_code, 0);
  const Image picture = read_png(path("plan.png"));
  EXPECT_GT(picture.width_px, 1000);
  const auto count = [&](Rgba8 colour) { return std::ranges::count(picture.pixels, colour); };
  EXPECT_GT(count({0, 114, 178, 255}), 20000);    // six-dof
  EXPECT_GT(count({240, 228, 66, 255}), 5000);    // bearing
  EXPECT_GT(count({53, 69, 108, 255}), 5000);     // 2 to 4 mm
  EXPECT_GT(count({226, 226, 226, 255}), 20000);  // lost
}

TEST_F(PlanCommand, FourProposedCamerasCoverTwiceTheArea) {
  const ProcessResult result =
      vindu({"plan", "--propose", "4", "--json", "--out", path("plan.png")});
  EXPECT_EQ(result.exit_code, 0);
  const std::size_t proposal = result.out.find("\"proposal\"");
  ASSERT_NE(proposal, std::string::npos);
  const double now = number_after(result.out, "covered_share");
  EXPECT_GT(now, 0.2);
  EXPECT_LT(now, 0.45);
  EXPECT_GT(number_after(result.out, "covered_share", proposal), 2 * now);
  EXPECT_GT(number_after(result.out, "eye_median_mm", proposal), 1);
  EXPECT_LT(number_after(result.out, "eye_median_mm", proposal), 6);
}

std::string wall_text() {
  const std::string tromso = bytes_of(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  return tromso.substr(0, tromso.find("[[camera]]"));
}

TEST_F(PlanCommand, TheProposalIsReadyForTheWallFileAndTheSameAgain) {
  const std::string wall = write("wall.toml", wall_text());
  const ProcessResult proposed =
      vindu({"plan", wall, "--propose", "2", "--json", "--out", path("plan.png")});
  const ProcessResult text = vindu({"plan", wall, "--propose", "2", "--out", path("plan.png")});
  ASSERT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.err, HasSubstr("2 cameras proposed: six-dof within"));
  const std::string ready = write("ready.toml", wall_text() + text.out);
  const ProcessResult checked = vindu({"plan", ready, "--json", "--out", path("plan.png")});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("plan-2"));
  const std::size_t proposal = proposed.out.find("\"proposal\"");
  EXPECT_NEAR(number_after(checked.out, "covered_share"),
              number_after(proposed.out, "covered_share", proposal), 0.02);
}

TEST_F(PlanCommand, TakesAreaHeightsAndRoom) {
  const ProcessResult result =
      vindu({"plan", "--area", "-0.5,1,0.5,2", "--height", "1.6,1.7", "--room", "-2,0,2,4.5",
             "--propose", "2", "--json", "--out", path("new/plan.png")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("\"area_m\":[-0.5,1,0.5,2]"),
                                HasSubstr("\"eye_heights_m\":[1.6,1.7]")));
  EXPECT_GT(number_after(result.out, "covered_share", result.out.find("\"proposal\"")), 0.97);
}

TEST_F(PlanCommand, WrongNumbersAreCalledWrong) {
  for (const std::string area : {"1,2,3", "1,2,0,4", "a,b,c,d", "1,2,3,4,5", "nan,0,1,1"}) {
    const ProcessResult result = vindu({"plan", "--area", area, "--out", path("plan.png")});
    EXPECT_EQ(result.exit_code, 2) << area;
    EXPECT_THAT(result.err, HasSubstr("--area"));
  }
  EXPECT_EQ(vindu({"plan", "--propose", "17"}).exit_code, 2);
}

TEST_F(PlanCommand, AnAreaBehindTheWallIsRefused) {
  const ProcessResult result = vindu({"plan", "--area", "-1,-3,1,-1", "--out", path("plan.png")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("--area: -1,-3,1,-1 lies behind the wall; z grows from the wall"));
  EXPECT_FALSE(std::filesystem::exists(path("plan.png")));
}

TEST_F(PlanCommand, WhereToPutCamerasIsForAProposalAlone) {
  for (const auto& [option, value] : {std::pair("--room", "-2,0,2,4"), std::pair("--ceiling", "3"),
                                      std::pair("--rail-height", "2")}) {
    const ProcessResult result = vindu({"plan", option, value, "--out", path("plan.png")});
    EXPECT_EQ(result.exit_code, 2) << option;
    EXPECT_THAT(result.err, HasSubstr(option + std::string(" requires --propose")));
  }
}

TEST_F(PlanCommand, AWallWithoutCamerasSaysWhatToDo) {
  const ProcessResult result =
      vindu({"plan", write("wall.toml", wall_text()), "--out", path("plan.png")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("[[camera]]"), HasSubstr("--propose")));
}

}  // namespace
}  // namespace vindu
