// Windows, on an X server without a screen: they open, draw for a while and end by themselves; and
// what happens where there is no display.
#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>
#include <utility>

#include "renderer/diagram.h"
#include "tests/app/process.h"
#include "tests/app/x_client.h"
#include "tests/wall/children.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr Rgba8 kBlack{0, 0, 0, 255};

class Windows : public AppTest {
 protected:
  void SetUp() override { ASSERT_NE(display_.name(), "") << "Xvfb does not start"; }
  /// A window beside the test; what it says goes to a file.
  Child open(std::vector<std::string> words) const {
    words.insert(words.begin(), {VINDU_PROGRAM, "view"});
    return {words, path("said"), [this] {
              setenv("DISPLAY", display_.name().c_str(), 1);
              setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
            }};
  }
  std::string said() const { return bytes_of(path("said")); }
  /// Of the pixels of two pictures: how many are not alike.
  static double changed(const Image& a, const Image& b) {
    std::size_t others = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) others += a.pixels[i] != b.pixels[i];
    return static_cast<double>(others) / static_cast<double>(a.pixels.size());
  }
  /// Neither black nor a page of words: the scene, which is drawn at once, stands before it.
  static bool is_of_the_room(const Rgba8& colour) { return colour != kBlack && colour != kNight; }
  static bool eventually(const std::function<bool()>& condition) {
    for (int i = 0; i < 600; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  VirtualDisplay display_;
};

class ViewEyes : public Windows, public ::testing::WithParamInterface<std::vector<std::string>> {};

TEST_P(ViewEyes, MoveInAWindowThatEndsByItself) {
  std::vector<std::string> words = {"view", small_model(), "--seconds", "1"};
  words.insert(words.end(), GetParam().begin(), GetParam().end());
  const ProcessResult result = vindu(words, display_.environment());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("frames in"), HasSubstr("1280x720"), HasSubstr("draw all tiles")));
  EXPECT_THAT(result.out, Not(HasSubstr("\n0 frames")));
}

INSTANTIATE_TEST_SUITE_P(Windows, ViewEyes,
                         ::testing::Values(std::vector<std::string>{},
                                           std::vector<std::string>{"--mouse"},
                                           std::vector<std::string>{"--eye", "-0.2,0.1,0.6"},
                                           std::vector<std::string>{"--path", VINDU_SOURCE_DIR
                                                                    "/assets/paths/sweep.toml"}));

TEST_F(Windows, CoverTheScreenWhenAskedTo) {
  const ProcessResult result =
      vindu({"view", small_model(), "--seconds", "1", "--fullscreen"}, display_.environment());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1600x1000"));
}

TEST_F(Windows, DoubtASizeThatWasInventedAndSayHowToGiveIt) {
  const ProcessResult doubted =
      vindu({"view", small_model(), "--seconds", "0.2"}, display_.environment());
  EXPECT_THAT(doubted.err, HasSubstr("--screen-mm"));
  const ProcessResult typed =
      vindu({"view", small_model(), "--seconds", "0.2", "--screen-mm", "527", "329"},
            display_.environment());
  EXPECT_EQ(typed.exit_code, 0);
  EXPECT_THAT(typed.err, Not(HasSubstr("--screen-mm")));
}

TEST_F(Windows, ShowWhatIsDroppedOnThemAndKeepTheirSceneForWhatIsNoModel) {
  Child view = open({small_model(), "--eye", "0,0.1,0.6"});
  XClient x(display_.name());
  ASSERT_TRUE(eventually([&] { return is_of_the_room(x.picture().at(20, 20)); }));
  const Image before = x.picture();
  x.drop("/usr/share/assimp/models/PLY/Wuson.ply");
  EXPECT_TRUE(eventually([&] { return said().find("info Wuson: fitted") != std::string::npos; }));
  EXPECT_TRUE(eventually([&] { return changed(before, x.picture()) > 0.02; }));
  EXPECT_EQ(x.picture().at(20, 20), before.at(20, 20));  // the same room around it
  x.drop(write("broken.glb", "no model"));
  EXPECT_TRUE(
      eventually([&] { return said().find("scene before it stays") != std::string::npos; }));
  x.close_window();
  EXPECT_EQ(view.end(), 0) << said();
}

TEST_F(Windows, SaveAPictureAtF12AndSayWhere) {
  const Child view = open({small_model(), "--eye", "0,0.1,0.6", "--out", path("pictures")});
  XClient x(display_.name());
  ASSERT_TRUE(eventually([&] { return is_of_the_room(x.picture().at(20, 20)); }));
  const std::string name = std::filesystem::path(small_model()).stem().string();
  for (const char* number : {"-1.png", "-2.png"}) {
    x.press("F12");
    const std::string file = path("pictures/" + name + number);
    ASSERT_TRUE(eventually([&] { return said().find("saved " + file) != std::string::npos; }))
        << said();
    const Image picture = read_png(file);
    EXPECT_EQ(picture.width_px, 1280);
    EXPECT_EQ(picture.height_px, 720);
    EXPECT_EQ(picture.at(20, 20), x.picture().at(20, 20));
    EXPECT_TRUE(eventually([&] { return x.picture().at(20, 700) == kDarkPaper; }));  // words
    EXPECT_NE(picture.at(20, 700), kDarkPaper);  // which the picture lacks
  }
}

TEST_F(Windows, RestWhileNothingMoves) {
  const ProcessResult result = vindu(
      {"view", small_model(), "--eye", "0,0.1,0.6", "--seconds", "2"}, display_.environment());
  EXPECT_THAT(result.out, HasSubstr(" at rest"));
  EXPECT_LT(std::stoi(result.out), 5) << result.out;
  const ProcessResult plays = vindu(
      {"view", "/usr/share/assimp/models/X/Testwuson.X", "--eye", "0,0.1,0.6", "--seconds", "2"},
      display_.environment());
  EXPECT_THAT(plays.out, AllOf(HasSubstr("frames in"), Not(HasSubstr(" at rest")))) << plays.err;
}

TEST_F(Windows, CanBeClosedWhileAModelIsRead) {
  std::ofstream stream(path("large.obj"));
  for (int i = 0; i < 1'500'000; ++i) stream << "v " << i << " 0 1\nv 0 " << i << " 1\nf -1 -2 1\n";
  stream.close();
  Child view = open({path("large.obj")});
  XClient x(display_.name());
  ASSERT_TRUE(eventually([&] { return said().find("is packed, once") != std::string::npos; }));
  x.close_window();
  EXPECT_EQ(view.end(), 0);
  EXPECT_THAT(said(), Not(HasSubstr("frames in")));
  for (const std::string& file : files_in("cache/vindu/scenes"))
    EXPECT_THAT(file, ::testing::EndsWith(".lock"));
}

TEST_F(Windows, ShowTheWholeChain) {
  const ProcessResult result =
      vindu({"simulate", "--seconds", "2", "--scale", "0.03", "--out", path("out")},
            display_.environment());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("frames in"), HasSubstr("head found")));
  EXPECT_THAT(files_in("out"), ::testing::Contains("contact-sheet.png"));
}

TEST_F(Windows, TrackWithTheCamerasOfAWallFile) {
  const std::string wall = write("desk.toml", R"([wall]
columns = 1
rows = 1
width_m = 0.6
height_m = 0.34
tile_width_px = 1600
tile_height_px = 1000
centre_height_m = 1.2

[[camera]]
name = "left"
source = "emulated"
position_m = [-0.6, 2.0, 3.0]
look_at_m = [0, 1.3, 0.8]
focal_px = 1335
centre_px = [512, 384]

[[camera]]
name = "right"
source = "emulated"
position_m = [0.6, 2.0, 3.0]
look_at_m = [0, 1.3, 0.8]
focal_px = 1335
centre_px = [512, 384]
)");
  const ProcessResult result =
      vindu({"view", small_model(), "--track", "--wall", wall, "--seconds", "1", "--json"},
            display_.environment());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr(R"("frames_by_level": {"six-dof": )"),
                                HasSubstr(R"("cameras": [{"name": "left", )")));
  const ProcessResult without =
      vindu({"view", small_model(), "--track", "--seconds", "1"}, display_.environment());
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.err, AllOf(HasSubstr("--track"), HasSubstr("--wall")));
}

TEST_F(Windows, RefuseAnEyeBehindTheScreen) {
  const ProcessResult result =
      vindu({"view", small_model(), "--eye", "0,0,-1", "--seconds", "1"}, display_.environment());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("--eye: 0.000,0.000,-1.000 is at or behind"));
}

constexpr const char* kTwoMonitors = R"([wall]
columns = 2
rows = 1
width_m = 2
height_m = 0.75
tile_width_px = 1024
tile_height_px = 768
hosts = "localhost"
[[tile]]
name = "tile-0-0"
monitor = "screen"
[[tile]]
name = "tile-1-0"
monitor = "HDMI-1"
)";

TEST_F(Windows, CoverTheMonitorThatTheirTileNames) {
  const std::string wall = write("wall.toml", kTwoMonitors);
  const Child tile({VINDU_PROGRAM, "tile", "tile-0-0", "--wall", wall}, path("said"),
                   [this] { setenv("DISPLAY", display_.name().c_str(), 1); });
  XClient x(display_.name());
  const auto covered = [&] {
    const Image screen = x.picture();
    return screen.at(2, 2) == kNight && screen.at(1597, 997) == kNight;
  };
  EXPECT_TRUE(eventually(covered)) << said();
}

TEST_F(Windows, NameTheMonitorsThatAreThereWhereATilesOwnIsNot) {
  const std::string wall = write("wall.toml", kTwoMonitors);
  const auto tile = [&](std::vector<std::string> names) {
    names.insert(names.begin(), "tile");
    names.insert(names.end(), {"--wall", wall});
    return vindu(names, display_.environment());
  };
  const ProcessResult missing = tile({"tile-1-0"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("no monitor \"HDMI-1\"; name one that is connected here: "
                                     "screen"));
}

using NoDisplay = AppTest;

TEST_F(NoDisplay, LetsViewDrawAPictureInstead) {
  const ProcessResult result =
      vindu({"view", small_model(), "--eye", "0.1,0.1,0.5", "--out", path("out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_in("out"), ElementsAre("view.png"));
  EXPECT_EQ(read_png(path("out/view.png")).width_px, 1280);
  EXPECT_THAT(result.err, HasSubstr("no display"));
}

TEST_F(NoDisplay, IsSaidForOneThatDoesNotAnswer) {
  const ProcessResult result =
      vindu({"view", small_model(), "--seconds", "1"}, {{"DISPLAY", ":9999"}});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), SizeIs(1));
  EXPECT_THAT(result.err, HasSubstr("display"));
}

TEST_F(NoDisplay, SaysWhichOptionsOnlyAWindowKeepsTo) {
  const ProcessResult result =
      vindu({"view", small_model(), "--seconds", "1", "--mouse", "--out", path("out")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--seconds"), HasSubstr("--mouse")));
  const ProcessResult blind = vindu({"view", small_model(), "--track", "--out", path("out")});
  EXPECT_EQ(blind.exit_code, 1);
  EXPECT_THAT(blind.err, AllOf(HasSubstr("--track"), HasSubstr("--wall")));
}

// A screen that leans back beside the middle, as a tile of a wall would stand.
TEST_F(NoDisplay, ShowsAScreenOfAWallFileWhereItStands) {
  const std::string wall = write("leaning.toml", R"([wall]
columns = 1
rows = 1
width_m = 0.5
height_m = 0.3
tile_width_px = 1280
tile_height_px = 720
tilt_deg = -20

[[tile]]
name = "tile-0-0"
lower_left_m = [0.2, -0.2, 0]
lower_right_m = [1.0, -0.2, 0]
upper_left_m = [0.2, 0.22, -0.15]
)");
  const std::vector<std::string> what = {small_model(), "--wall",      wall,    "--place",  "as-is",
                                         "--eye",       "0.3,0.2,0.9", "--out", path("out")};
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), what.begin(), what.end());
    const ProcessResult result = vindu(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  run({"view"});
  run({"render", "--tile", "tile-0-0"});
  const Image viewed = read_png(path("out/view.png")), tile = read_png(path("out/tile-0-0.png"));
  EXPECT_EQ(viewed.pixels, tile.pixels);
}

TEST_F(NoDisplay, RefusesAnEyeBehindTheScreen) {
  const ProcessResult result =
      vindu({"view", small_model(), "--eye", "0,0,-1", "--out", path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("--eye"));
}

}  // namespace
}  // namespace vindu
