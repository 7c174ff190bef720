// vindu track: the tracking server without a picture, on emulated cameras.
#include <regex>

#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;

using TrackCommand = AppTest;

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
  std::vector<std::string> lines = lines_of(text);
  std::erase_if(lines,
                [&](const std::string& line) { return line.find(part) == std::string::npos; });
  return lines;
}

std::int64_t time_ns(const std::string& line) {
  static const std::regex number(R"re("t_ns":(-?\d+))re");
  std::smatch match;
  return std::regex_search(line, match, number) ? std::stoll(match[1]) : 0;
}

TEST_F(TrackCommand, PrintsPosesAndWhatItLearnsOfTheCamerasAsJson) {
  const ProcessResult result = vindu({"track", "--json", "--seconds", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto poses = lines_with(result.out, "eye_in_wall_m");
  ASSERT_GT(poses.size(), 10u);
  EXPECT_THAT(poses.back(), ContainsRegex(R"("object":0,"level":"six-dof","eye_in_wall_m":\[)"));
  EXPECT_THAT(poses.back(), ContainsRegex(R"("sigma_m":0\.00.*,"followed":true})"));
  for (std::size_t i = 1; i < poses.size(); ++i)
    EXPECT_GT(time_ns(poses[i]), time_ns(poses[i - 1]));
  EXPECT_THAT(
      lines_of(result.out),
      Contains(HasSubstr(R"("camera":"left","heard":true,"moved":false,"device_time":true)")));
}

TEST_F(TrackCommand, HasALineForACameraThatIsNotThere) {
  const std::string file =
      write("ghost.toml", bytes_of(VINDU_SOURCE_DIR "/assets/walls/tromso.toml") +
                              "\n[[camera]]\nname = \"ghost\"\nsource = \"wiimote\"\n"
                              "address = \"00:1f:c5:99:99:99\"\n"
                              "position_m = [0, 2.3, 5]\nlook_at_m = [0, 1.65, 2]\n");
  const ProcessResult result = vindu({"track", "--json", "--seconds", "2", "--wall", file});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(lines_with(result.out, R"("camera":"ghost")"),
              ElementsAre(HasSubstr(R"("camera":"ghost","heard":false)")));
  EXPECT_THAT(result.out, HasSubstr(R"("camera":"left","heard":true)"));
}

TEST_F(TrackCommand, SaysWhichOfTwoHeadsIsFollowed) {
  std::string wall = bytes_of(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  const std::size_t head = wall.find("[head]"), leds = wall.find("leds_m", head);
  const std::size_t eye = wall.find('\n', wall.find("eye_m", leds));
  wall.replace(
      head, eye - head,
      "[[head]]\nname = \"anna\"\nleds_m = [[-0.09, 0, -0.09], [0, 0, 0], [0.09, 0, -0.09]]\n"
      "[[head]]\nname = \"carl\"\nleds_m = [[0.1, 0, 0], [0, 0.1, 0], [-0.2, 0, 0.05]]");
  const std::string file = write("two.toml", wall + "[tracking]\nfollow = \"carl\"\n");
  const ProcessResult result = vindu({"track", "--json", "--seconds", "3", "--wall", file});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto poses = lines_with(result.out, R"("object":0,"level":"six-dof")");
  ASSERT_FALSE(poses.empty()) << result.out;
  EXPECT_THAT(poses, Each(HasSubstr(R"("followed":false)")));
}

TEST_F(TrackCommand, EndsWithATableWhenNotAskedForJson) {
  const ProcessResult result = vindu({"track", "--seconds", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("six-dof"));
  EXPECT_THAT(result.out, HasSubstr("times by its own clock"));
  EXPECT_THAT(result.out, HasSubstr("gaps: none"));
}

TEST_F(TrackCommand, TracksByTheThesisMethodToo) {
  const ProcessResult result =
      vindu({"track", "--json", "--seconds", "2", "--method", "thesis", "--link", "busy"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(lines_with(result.out, "six-dof"), Contains(HasSubstr(R"("sigma_m":null)")));
}

TEST_F(TrackCommand, InPositionModeFacesTheWall) {
  const ProcessResult result = vindu({"track", "--json", "--seconds", "2", "--mode", "position"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto poses = lines_with(result.out, R"("level":"position")");
  ASSERT_FALSE(poses.empty());
  EXPECT_THAT(poses, Each(HasSubstr(R"("quaternion_xyzw":[0,0,0,1])")));
}

TEST_F(TrackCommand, PredictsFromARecordingAsFarAsItIsAskedTo) {
  ASSERT_EQ(vindu({"record", "--seconds", "3", "--out", path("a.vrec")}).exit_code, 0);
  const auto poses = [&](const std::string& ms) {
    const ProcessResult result = vindu({"replay", path("a.vrec"), "--track", "--predict-ms", ms});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return lines_with(result.out, "six-dof");
  };
  const auto now = poses("0"), later = poses("40");
  ASSERT_GT(now.size(), 30u);
  EXPECT_EQ(time_ns(later.back()) - time_ns(now.back()), 40'000'000);
  const auto eye_on = [](const std::string& line) { return line.substr(line.find("eye_in")); };
  EXPECT_NE(eye_on(now.back()), eye_on(later.back()));
}

TEST_F(TrackCommand, TellsPressesOfButtonsFromARecordingAsFromTheDevice) {
  ASSERT_EQ(vindu({"record", "--seconds", "2", "--press", "up@0.5", "--press", "home@1", "--out",
                   path("a.vrec")})
                .exit_code,
            0);
  const ProcessResult result = vindu({"replay", path("a.vrec"), "--track"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto told = lines_with(result.out, "\"button\"");
  ASSERT_EQ(told.size(), 4u) << result.out;
  EXPECT_THAT(told[0], HasSubstr(R"("camera":"left","button":"Up","pressed":true)"));
  EXPECT_THAT(told[1], HasSubstr(R"("camera":"left","button":"Up","pressed":false)"));
  EXPECT_THAT(told[2], HasSubstr(R"("camera":"left","button":"Home","pressed":true)"));
  EXPECT_THAT(time_ns(told[1]) - time_ns(told[0]), AllOf(Ge(280'000'000), Le(320'000'000)));
}

TEST_F(TrackCommand, RefusesWhatItCannotDo) {
  const ProcessResult press = vindu({"track", "--press", "fire@1"});
  EXPECT_EQ(press.exit_code, 2);
  EXPECT_THAT(press.err, HasSubstr("buttons are left, right"));
  const ProcessResult target = vindu({"track", "--target", "globe,1,2"});
  EXPECT_EQ(target.exit_code, 2);
  EXPECT_THAT(target.err, HasSubstr("NAME,x,y,z,radius"));
  const ProcessResult follow = vindu({"track", "--follow", "nobody"});
  EXPECT_EQ(follow.exit_code, 1);
  EXPECT_THAT(follow.err, HasSubstr("nobody"));
  const std::string wall = write("wall.toml", R"([wall]
columns = 1
rows = 1
width_m = 1
height_m = 1
tile_width_px = 64
tile_height_px = 64
)");
  const ProcessResult blind = vindu({"track", "--wall", wall});
  EXPECT_EQ(blind.exit_code, 1);
  EXPECT_THAT(blind.err, HasSubstr("[[camera]]"));
}

}  // namespace
}  // namespace vindu
