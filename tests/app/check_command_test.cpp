// vindu check: the expanded wall, its drawing, and all errors of a wall file at once.
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
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
          ::testing::StartsWith("{\"columns\": 7, "), ::testing::EndsWith("]}\n"),
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
