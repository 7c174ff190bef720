// vindu render: exactly the files that it promises, and one clear line for what cannot be done.
#include "renderer/image.h"
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class RenderCommand : public AppTest {
 protected:
  /// A small picture of a box, with more words.
  ProcessResult render(std::vector<std::string> more) const {
    std::vector<std::string> words = {"render", small_model(), "--scale", "0.02"};
    words.insert(words.end(), more.begin(), more.end());
    if (std::ranges::find(more, "--out") == more.end())
      words.insert(words.end(), {"--out", path("out")});
    return vindu(words);
  }
};

std::vector<std::string> all_files() {
  std::vector<std::string> names = {"eye.png", "wall.png"};
  for (int column = 0; column < 7; ++column)
    for (int row = 0; row < 4; ++row)
      names.push_back("tile-" + std::to_string(column) + "-" + std::to_string(row) + ".png");
  std::ranges::sort(names);
  return names;
}

TEST_F(RenderCommand, WritesEveryTileTheWallAndTheViewFromTheEye) {
  const ProcessResult result = render({"--all"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(files_in("out"), all_files());
  EXPECT_THAT(lines_of(result.out), SizeIs(30));
  for (const std::string& line : lines_of(result.out)) EXPECT_FALSE(read_png(line).empty());
}

TEST_F(RenderCommand, WritesAllWithoutBeingAskedTo) {
  EXPECT_EQ(render({}).exit_code, 0);
  EXPECT_EQ(files_in("out"), all_files());
}

constexpr const char* kWalk =
    "closing_s = 1\n[[key]]\nt_s = 0\neye_m = [-1, 0, 2]\n[[key]]\nt_s = 1\neye_m = [1, 0, 2]\n";

TEST_F(RenderCommand, MakesTheFramesOfAFilmBitEqualEachTime) {
  const std::vector<std::string> film = {
      "--path", write("path.toml", kWalk), "--fps", "4", "--seconds", "1.5"};
  std::vector<std::string> once = film, again = film;
  once.insert(once.end(), {"--out", path("once")});
  again.insert(again.end(), {"--out", path("again")});
  ASSERT_EQ(render(once).exit_code, 0);
  ASSERT_EQ(render(again).exit_code, 0);
  ASSERT_THAT(files_in("once"), SizeIs(6));
  EXPECT_EQ(files_in("once").front(), "frame-00001.png");
  for (const std::string& frame : files_in("once"))
    EXPECT_EQ(bytes_of(path("once/" + frame)), bytes_of(path("again/" + frame))) << frame;
  // The path's key at 1 s is the fifth frame.
  ASSERT_EQ(render({"--eye", "1,0,2", "--time", "1"}).exit_code, 0);
  EXPECT_EQ(read_png(path("once/frame-00005.png")), read_png(path("out/wall.png")));
  EXPECT_NE(read_png(path("once/frame-00001.png")), read_png(path("out/wall.png")));
}

TEST_F(RenderCommand, WritesAFilmsPixelsToTheOutputStream) {
  const std::string file = write("path.toml", kWalk);
  const std::vector<std::string> film = {"--path", file, "--fps", "2", "--seconds", "1"};
  std::vector<std::string> pictures = film, stream = film;
  pictures.insert(pictures.end(), {"--tile", "tile-3-1"});
  stream.insert(stream.end(), {"--tile", "tile-3-1", "--out", "-"});
  ASSERT_EQ(render(pictures).exit_code, 0);
  const ProcessResult result = render(stream);
  EXPECT_EQ(result.exit_code, 0);
  std::string bytes;
  for (const std::string& frame : files_in("out"))
    for (const Rgba8& pixel : read_png(path("out/" + frame)).pixels)
      bytes.append(pixel.begin(), pixel.begin() + 3);
  EXPECT_EQ(result.out, bytes);
  EXPECT_THAT(result.err, HasSubstr("rgb24, 20x15, 2 frames a second"));
  EXPECT_EQ(render({"--out", "-"}).exit_code, 1);
}

TEST_F(RenderCommand, DrawsTheClipAndTheTimeThatAreAskedFor) {
  const auto picture = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render",  "/usr/share/assimp/models/X/Testwuson.X",
                                      "--scale", "0.05",
                                      "--tile",  "tile-3-1",
                                      "--out",   path("out")};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult result = vindu(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return bytes_of(path("out/tile-3-1.png"));
  };
  const std::string run = picture({"--time", "0.3"});
  EXPECT_EQ(picture({"--time", "0.3", "--clip", "Wuson_Run"}), run);
  EXPECT_EQ(picture({"--time", "0.3", "--clip", "1"}), run);
  EXPECT_NE(picture({"--time", "0.6"}), run);
  EXPECT_NE(picture({"--time", "0.3", "--clip", "2"}), run);
  const std::string rest = picture({"--time", "0.3", "--clip", "rest"});
  EXPECT_NE(rest, run);
  EXPECT_EQ(picture({"--time", "0.6", "--clip", "rest"}), rest);
}

TEST_F(RenderCommand, SaysWhichClipsThereAre) {
  const ProcessResult result = vindu(
      {"render", "/usr/share/assimp/models/X/Testwuson.X", "--clip", "fly", "--out", path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("has no clip \"fly\"; choose 1 Wuson_Run, 2 Wuson_Walk, or rest"));
  EXPECT_THAT(render({"--clip", "fly"}).err, HasSubstr("has no clips"));
}

TEST_F(RenderCommand, JoinsTheTilesInTheWallsPicture) {
  ASSERT_EQ(render({"--eye", "-0.5,0.3,1.2"}).exit_code, 0);
  const Image wall = read_png(path("out/wall.png"));
  Image joined = Image::filled(wall.width_px, wall.height_px, {});
  for (int column = 0; column < 7; ++column)
    for (int row = 0; row < 4; ++row) {
      const Image tile =
          read_png(path("out/tile-" + std::to_string(column) + "-" + std::to_string(row) + ".png"));
      paste(tile, column * tile.width_px, (3 - row) * tile.height_px, joined);
    }
  EXPECT_EQ(joined, wall);
}

TEST_F(RenderCommand, WritesOneTileAsItIsInTheWholeWall) {
  const ProcessResult one = render({"--tile", "tile-3-1", "--out", path("one")});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_THAT(files_in("one"), ElementsAre("tile-3-1.png"));
  render({"--all"});
  EXPECT_EQ(bytes_of(path("one/tile-3-1.png")), bytes_of(path("out/tile-3-1.png")));
}

TEST_F(RenderCommand, NamesTheTilesThereAreForOneThatIsNot) {
  const ProcessResult result = render({"--tile", "tile-7-0"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), SizeIs(1));
  EXPECT_THAT(result.err, AllOf(HasSubstr("tile-7-0"), HasSubstr("tile-0-0 to tile-6-3")));
  EXPECT_THAT(files_in("out"), IsEmpty());
}

/// The middle column of what is not black.
double middle_px(const Image& picture) {
  double sum = 0, count = 0;
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      if (picture.at(x, y) != Rgba8{0, 0, 0, 255}) {
        sum += x;
        ++count;
      }
  return sum / count;
}

TEST_F(RenderCommand, ShowsTheBoxBehindTheWallOnTheSideOfTheEye) {
  const auto seen = [&](const std::string& eye) {
    EXPECT_EQ(render({"--unlit", eye}).exit_code, 0);
    return read_png(path("out/wall.png"));
  };
  const Image from_left = seen("--eye=-1,0,2"), from_right = seen("--eye=1,0,2");
  const double middle = 0.5 * (from_left.width_px - 1);
  EXPECT_LT(middle_px(from_left), middle - 0.5);
  EXPECT_NEAR(middle_px(from_right), 2 * middle - middle_px(from_left), 0.01);
}

TEST_F(RenderCommand, TakesAnEyeToTheLeftAsAWordOfItsOwn) {
  EXPECT_EQ(render({"--eye", "-1,0,2", "--out", path("a")}).exit_code, 0);
  EXPECT_EQ(render({"--eye=-1,0,2", "--out", path("b")}).exit_code, 0);
  EXPECT_EQ(bytes_of(path("a/wall.png")), bytes_of(path("b/wall.png")));
}

TEST_F(RenderCommand, IsBlackForAnEyeBehindTheWallAndSaysSo) {
  const ProcessResult result = render({"--eye", "0,0,-1"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("tile-0-0"), HasSubstr("tile-6-3"), HasSubstr("black")));
  const Image wall = read_png(path("out/wall.png"));
  EXPECT_THAT(wall.pixels, ::testing::Each(Rgba8{0, 0, 0, 255}));
}

TEST_F(RenderCommand, DrawsForAnEyeInTheMiddleOfTheWallWithoutFailing) {
  EXPECT_EQ(render({"--eye", "0,0,0"}).exit_code, 0);
  EXPECT_EQ(files_in("out"), all_files());
}

TEST_F(RenderCommand, SaysHowAModelWithoutAUnitIsPlaced) {
  EXPECT_THAT(render({"--place", "life-size"}).err, HasSubstr("does not state its unit"));
}

TEST_F(RenderCommand, SaysNothingButErrorsWhenQuiet) {
  const ProcessResult result = render({"--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(RenderCommand, RefusesAFolderThatCannotBeMade) {
  const std::string file = write("file", "not a folder");
  for (const std::string& out : {file, file + "/below", std::string("/proc/vindu")}) {
    const ProcessResult result = render({"--out", out});
    EXPECT_EQ(result.exit_code, 1) << out;
    EXPECT_THAT(result.err, AllOf(HasSubstr("vindu: " + out + ": "), HasSubstr("--out")));
    EXPECT_THAT(result.err, ::testing::Not(HasSubstr("Success")));
  }
}

TEST_F(RenderCommand, RefusesAPictureThatCannotBeWritten) {
  std::filesystem::create_directories(path("out/tile-0-0.png"));
  const ProcessResult result = render({});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(path("out/tile-0-0.png")));
}

TEST_F(RenderCommand, RefusesAWallThatIsTooLargeForTheGpu) {
  const ProcessResult result = vindu({"render", small_model(), "--scale", "4", "--out", path("o")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("28672x12288"), HasSubstr("--scale")));
}

TEST_F(RenderCommand, DrawsOnADeviceByItsIndexAndNamesThoseThereAre) {
  EXPECT_EQ(render({"--device", "0"}).exit_code, 0);
  const ProcessResult result = render({"--device", "99"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("device 99"), HasSubstr("choose 0")));
}

TEST_F(RenderCommand, ShowsItsOwnSceneWhereNoModelIsNamed) {
  const ProcessResult result = vindu({"render", "--scale", "0.02", "--out", path("out")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(files_in("out"), all_files());
}

TEST_F(RenderCommand, TakesTheModelThatTheWallFileNamesFromBesideIt) {
  std::filesystem::copy_file(small_model(), path("mine.obj"));
  const std::string wall = write("wall.toml", R"([wall]
columns = 2
rows = 1
width_m = 2.0
height_m = 0.5
tile_width_px = 40
tile_height_px = 20

[scene]
model = "mine.obj"
)");
  const ProcessResult result = vindu({"render", "--wall", wall, "--out", path("out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("mine"));
  EXPECT_THAT(files_in("out"), ElementsAre("eye.png", "tile-0-0.png", "tile-1-0.png", "wall.png"));
}

}  // namespace
}  // namespace vindu
