// vindu check: the expanded wall, its drawing, and all errors of a wall file at once.
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

using CheckCommand = AppTest;

TEST_F(CheckCommand, PrintsEveryTileOfTheWallThatComesWithVindu) {
  const ProcessResult result = vindu({"check"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("28 tiles"), HasSubstr("tile-0-0"), HasSubstr("tile-6-3"),
                                HasSubstr("camera left")));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(CheckCommand, SaysTheSameAsJson) {
  const ProcessResult result = vindu({"check", "--json", "--draw", path("wall.svg")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(
      result.out,
      AllOf(
          ::testing::StartsWith("{\"columns\": 7, "),
          HasSubstr("\"warnings\": [\"a wrong labelling of the 3 LEDs of head fits"),
          HasSubstr(R"({"name": "tile-6-3", "host": "tile-6-3", "monitor": "", "width_px": 1024)"),
          HasSubstr(R"("default_eye_in_wall_m": [0,0.1,2])"),
          HasSubstr(R"({"name": "left", "source": "emulated", "position_in_room_m": )")));
  EXPECT_THAT(files_in(""), ::testing::Contains("wall.svg"));
}

TEST_F(CheckCommand, DrawsTheWall) {
  const ProcessResult result = vindu({"check", "--draw", path("wall.svg")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr(path("wall.svg")));
  const std::string svg = bytes_of(path("wall.svg"));
  EXPECT_THAT(svg, AllOf(::testing::StartsWith("<svg"), HasSubstr("</svg>"), HasSubstr("tile-6-3"),
                         HasSubstr("default eye")));
}

/// A camera's field of view in the drawing: two lines from where it stands.
std::vector<std::array<double, 4>> sight_lines(const std::string& svg) {
  std::vector<std::array<double, 4>> lines;
  for (const std::string& line : lines_of(svg)) {
    std::array<double, 4> ends{};
    if (line.find("#d08a2e") != std::string::npos &&
        std::sscanf(line.c_str(), "<line x1='%lf' y1='%lf' x2='%lf' y2='%lf'", &ends[0], &ends[1],
                    &ends[2], &ends[3]) == 4)
      lines.push_back(ends);
  }
  return lines;
}

TEST_F(CheckCommand, DrawsWhatAVideoCameraSeesToBothSidesAlike) {
  const std::string file = write("wall.toml", R"([wall]
columns = 1
rows = 1
width_m = 2.0
height_m = 0.5
tile_width_px = 40
tile_height_px = 20

[[camera]]
name = "middle"
source = "video"
file = "frames/%04d.png"
width_px = 640
height_px = 480
position_m = [0, 2, 0]
look_at_m = [0, 1.5, 3]
focal_px = 600
centre_px = [320, 240]
)");
  const ProcessResult result = vindu({"check", file, "--draw", path("wall.svg")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 tile, 1 x 1"));
  const auto lines = sight_lines(bytes_of(path("wall.svg")));
  ASSERT_THAT(lines, SizeIs(2));
  for (const auto& [from_x, from_y, to_x, to_y] : lines) EXPECT_EQ(from_x, 0);
  EXPECT_NEAR(lines[0][2], -lines[1][2], 0.01);
  // 320 pixels aside at a focal length of 600, 4.5 m deep, 200 units a metre.
  EXPECT_NEAR(std::abs(lines[0][2]), 200 * 4.5 * 320 / 600, 0.01);
}

TEST_F(CheckCommand, WarnsOfTwoHelmetsThatCannotBeTold) {
  const std::string wall =
      "[wall]\ncolumns = 1\nrows = 1\nwidth_m = 1\nheight_m = 1\n"
      "tile_width_px = 100\ntile_height_px = 100\n";
  const std::string anna =
      "[[head]]\nname = \"anna\"\nleds_m = [[-0.10, 0, -0.05], [0, 0, 0], [0.10, 0, -0.15]]\n";
  const std::string carl =
      "[[head]]\nname = \"carl\"\nleds_m = [[0.10, 0, -0.15], [-0.10, 0, -0.05], [0, 0, 0]]\n";
  const std::string dora =
      "[[head]]\nname = \"dora\"\nleds_m = [[-0.14, 0, -0.05], [0, 0, 0], [0.10, 0.06, -0.15]]\n";
  EXPECT_THAT(vindu({"check", write("equal.toml", wall + anna + carl)}).out,
              HasSubstr("the LEDs of anna fit those of carl to 0.0 mm"));
  const std::string two = "[[head]]\nname = \"two\"\nleds_m = [[-0.10, 0, 0], [0.10, 0, 0]]\n";
  EXPECT_THAT(vindu({"check", write("few.toml", wall + anna + two)}).out,
              HasSubstr("who is who cannot be told. Give each three LEDs or more"));
  EXPECT_THAT(vindu({"check", write("unlike.toml", wall + anna + dora)}).out,
              Not(HasSubstr("fit those of")));
}

/// The wall that comes with Vindu, with other LEDs and that [tracking].
std::string wall_with(const std::string& leds, const std::string& tracking = "", int cameras = 2) {
  std::string text = bytes_of(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  if (cameras == 1) text.erase(text.rfind("[[camera]]"));
  const std::size_t begin = text.find("leds_m = ");
  text.replace(begin, text.find('\n', begin) - begin, "leds_m = " + leds);
  return text + "[tracking]\n" + tracking;
}

TEST_F(CheckCommand, WarnsOfLedsInOneLineAndSaysWhatHelps) {
  const auto said_of = [&](const std::string& leds, const std::string& tracking = "") {
    return vindu({"check", "--json", write("wall.toml", wall_with(leds, tracking))}).out;
  };
  const std::string two = "[[-0.09, 0, 0], [0.09, 0, 0]]";
  EXPECT_THAT(said_of("[[-0.09, 0, 0], [0.09, 0, 0], [0.02, 0.006, 0]]"),
              AllOf(HasSubstr("the 3 LEDs of head lie in one line, to 2.8 mm"),
                    HasSubstr("Move one LED by a few centimetres off the line")));
  EXPECT_THAT(said_of(two), AllOf(HasSubstr("the 2 LEDs of head lie in one line, to 0.0 mm"),
                                  HasSubstr("Add a third LED, a few centimetres off their line"),
                                  Not(HasSubstr("Move one LED"))));
  EXPECT_THAT(said_of(two, "mode = \"position\"\n"), Not(HasSubstr("in one line")));
  EXPECT_THAT(said_of("[[-0.09, 0, 0], [0.09, 0, 0], [0.02, 0.02, 0]]"),
              Not(HasSubstr("in one line")));
}

TEST_F(CheckCommand, WarnsOfAHelmetThatTheTrackingCannotUse) {
  const auto said_of = [&](const std::string& leds, const std::string& tracking) {
    const std::string file = write("wall.toml", wall_with(leds, tracking));
    const ProcessResult result = vindu({"check", file}), json = vindu({"check", file, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find("warning: ") == std::string::npos,
              json.out.find("\"warnings\": []") != std::string::npos);
    return result.out;
  };
  const std::string one = "[[0, 0, 0]]", two = "[[0, 0, 0], [0.1, 0, 0]]";
  EXPECT_THAT(said_of(one, ""), HasSubstr("warning: mode = \"auto\" of [tracking] needs 2 LEDs or "
                                          "more, and leds_m of head has 1"));
  EXPECT_THAT(said_of(two, "mode = \"six-dof\"\n"), HasSubstr("needs 3 LEDs or more"));
  EXPECT_THAT(said_of(two, "method = \"thesis\"\n"),
              HasSubstr("the thesis' method needs three LEDs, not 2"));
  EXPECT_THAT(said_of(one, "mode = \"position\"\n"), Not(HasSubstr("warning")));
}

TEST_F(CheckCommand, SaysWhatOneCameraCannotKnow) {
  const auto said_of = [&](const std::string& leds, const std::string& tracking) {
    return vindu({"check", write("wall.toml", wall_with(leds, tracking, 1))}).out;
  };
  const std::string three = "[[-0.09, 0.03, -0.09], [0, 0, 0], [0.09, -0.02, -0.09]]";
  const std::string four = three.substr(0, three.size() - 1) + ", [0.02, 0.10, -0.03]]";
  EXPECT_THAT(said_of(three, ""), HasSubstr("the one that faces the wall is taken"));
  EXPECT_THAT(said_of(three, "mode = \"six-dof\"\n"),
              HasSubstr("needs 4 LEDs or more with one camera, and leds_m of head has 3"));
  EXPECT_THAT(said_of("[[-0.09, 0, 0], [0.09, 0, 0]]", "mode = \"position\"\n"),
              HasSubstr("needs 3 LEDs or more with one camera"));
  EXPECT_THAT(said_of(four, ""), Not(HasSubstr("faces the wall is taken")));
  EXPECT_THAT(said_of(four, "mode = \"six-dof\"\n"), Not(HasSubstr("warning: mode")));
}

TEST_F(CheckCommand, FailsWhereTheDrawingCannotBeWritten) {
  const ProcessResult result = vindu({"check", "--draw", path("nowhere/wall.svg")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr(path("nowhere/wall.svg")), HasSubstr("--draw")));
}

TEST_F(CheckCommand, TellsAllErrorsAtOnceEachWithFileAndLine) {
  const std::string file = write("wall.toml", R"([wall]
columns = 0
rows = 4
width_m = "wide"
height_m = 2.238
tile_width_px = 1024
tile_height_px = 768
hight_m = 3
)");
  const ProcessResult result = vindu({"check", file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  const auto lines = lines_of(result.err);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_THAT(lines[0], AllOf(HasSubstr(file + ":2"), HasSubstr("columns")));
  EXPECT_THAT(lines[1], AllOf(HasSubstr(file + ":4"), HasSubstr("width_m"), HasSubstr("wide")));
  EXPECT_THAT(lines[2], AllOf(HasSubstr(file + ":8"), HasSubstr("hight_m"), HasSubstr("height_m")));
}

TEST_F(CheckCommand, TellsTheLineOfABrokenFile) {
  const std::string file = write("wall.toml", "[wall]\ncolumns = = 7\n");
  const ProcessResult result = vindu({"check", file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), SizeIs(1));
  EXPECT_THAT(result.err, HasSubstr(file + ":2"));
}

}  // namespace
}  // namespace vindu
