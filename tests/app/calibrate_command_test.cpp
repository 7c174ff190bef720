// vindu calibrate: with emulated cameras that stand elsewhere than the wall file says, each
// calibration finds them, writes what it found, and says how good that is.
#include <unistd.h>

#include "renderer/image.h"
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CalibrateCommand : public AppTest {
 protected:
  CalibrateCommand()
      : wall_(write("wall.toml", bytes_of(VINDU_SOURCE_DIR "/assets/walls/tromso.toml") +
                                     "[cluster]\nname = \"calibrate-" + std::to_string(getpid()) +
                                     "\"\n")) {}
  const std::string wall_;
};

/// That is drawn in this colour.
bool has_colour(const std::string& png, const Rgba8& colour) {
  return std::ranges::count(read_png(png).pixels, colour) > 20;
}

TEST_F(CalibrateCommand, ByAWandWritesWhatCheckThenShows) {
  const ProcessResult result =
      vindu({"calibrate", "wand", "--wall", wall_, "--picture", path("seen.png")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("left"), HasSubstr("right"), HasSubstr("the truth")));
  EXPECT_THAT(bytes_of(path("calibration/cameras.toml")), HasSubstr("method = \"wand\""));
  EXPECT_THAT(bytes_of(path("seen.png")), HasSubstr("PNG"));
  EXPECT_THAT(vindu({"check", wall_}).out, HasSubstr("calibrated by wand"));
}

TEST_F(CalibrateCommand, ByAWandThenByTheWallFitsTheWall) {
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  const ProcessResult result = vindu({"calibrate", "wall", "--wall", wall_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("corner of tile-"), HasSubstr("rms")));
  EXPECT_THAT(bytes_of(path("calibration/cameras.toml")), HasSubstr("wand + wall"));
  // The first camera, which a wand takes as it is, is where the wall is as sure as touches are.
  const auto placed = [&](const std::string& file) {
    const auto lines = lines_of(bytes_of(path("calibration/" + file)));
    return std::ranges::count_if(
        lines, [](const std::string& line) { return line.starts_with("position_sigma_mm = "); });
  };
  EXPECT_EQ(placed("cameras.previous.toml"), 1);
  EXPECT_EQ(placed("cameras.toml"), 2);
}

TEST_F(CalibrateCommand, OfALensThatWasKnownBetterSaysSo) {
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  const ProcessResult result =
      vindu({"calibrate", "intrinsics", "--wall", wall_, "--camera", "right"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("right: its focal length was known better"),
                                HasSubstr("right: stands where it was found with another lens")));
  EXPECT_THAT(result.err, HasSubstr("what it said is kept as cameras.previous.toml"));
}

TEST_F(CalibrateCommand, OfALensInADryRunKeepsNothingAndSaysSoNowhere) {
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  const ProcessResult result =
      vindu({"calibrate", "intrinsics", "--wall", wall_, "--json", "--dry-run"});
  EXPECT_THAT(result.out, HasSubstr(R"("warnings":["left: its focal length was known better)"));
  EXPECT_THAT(result.out + result.err, ::testing::Not(HasSubstr("previous")));
  EXPECT_THAT(files_in("calibration"), ::testing::ElementsAre("cameras.toml"));
}

TEST_F(CalibrateCommand, WarnsOnceOfACalibrationOfACameraThatIsNoMore) {
  std::filesystem::create_directories(path("calibration"));
  write("calibration/cameras.toml", "[[calibrated_camera]]\nname = \"gone\"\nlag_ms = 1\n");
  for (const char* kind : {"intrinsics", "extrinsics", "background"}) {
    const ProcessResult result = vindu({"calibrate", kind, "--wall", wall_, "--dry-run"});
    EXPECT_THAT(lines_of(result.err), ::testing::ElementsAre(HasSubstr("\"gone\""))) << kind;
  }
}

TEST_F(CalibrateCommand, ByLiveCamerasThatFailsNamesItsRecordingAndHowToGoOn) {
  const std::string wall = write(
      "live.toml",
      bytes_of(wall_) +
          "\n[[camera]]\nname = \"ghost\"\nsource = \"wiimote\"\naddress = \"00:11:22:33:44:55\"\n"
          "position_m = [0, 2.3, 5]\nlook_at_m = [0, 1.65, 2]\n");
  const ProcessResult result = vindu({"calibrate", "wand", "--wall", wall, "--seconds", "1"});
  EXPECT_EQ(result.exit_code, 1);
  ASSERT_THAT(files_in("calibration"), ::testing::SizeIs(1));
  const std::string recording = path("calibration/" + files_in("calibration")[0]);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("camera ghost: sent nothing"), HasSubstr("--from " + recording)));
  const ProcessResult again = vindu({"calibrate", "wand", "--wall", wall, "--from", recording});
  EXPECT_THAT(again.err,
              AllOf(HasSubstr("camera ghost: sent nothing"), ::testing::Not(HasSubstr("--from"))));
}

TEST_F(CalibrateCommand, ByLiveCamerasThatAreNotThereKeepsNoRecording) {
  std::string wall = bytes_of(wall_);
  for (std::size_t at = 0; (at = wall.find("\"emulated\"", at)) != std::string::npos;)
    wall.replace(at, 10, "\"wiimote\"");
  const ProcessResult result =
      vindu({"calibrate", "wand", "--wall", write("dead.toml", wall), "--seconds", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("cameras: none of them sent anything"));
  EXPECT_THAT(files_in("calibration"), IsEmpty());
}

TEST_F(CalibrateCommand, AsJsonHasWhatIsTrueBesideWhatWasFound) {
  const std::string wand = vindu({"calibrate", "wand", "--wall", wall_, "--json"}).out;
  const std::size_t truth = wand.find("\"truth\"");
  ASSERT_NE(truth, std::string::npos) << wand;
  const std::size_t found_right = wand.find("\"right\""),
                    true_right = wand.find("\"right\"", truth);
  EXPECT_GT(std::abs(number_after(wand, "lag_ms", true_right) - 6), 0.1);
  EXPECT_NEAR(number_after(wand, "lag_ms", found_right), number_after(wand, "lag_ms", true_right),
              1);
  EXPECT_LT(number_after(wand, "position_off_mm", true_right), 15);
  for (const char* kind : {"wall", "head", "intrinsics", "extrinsics", "background"}) {
    const ProcessResult result = vindu({"calibrate", kind, "--wall", wall_, "--json", "--dry-run"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const std::string& line : lines_of(result.out))
      EXPECT_THAT(line, AllOf(HasSubstr("\"warnings\":["), HasSubstr("\"truth\":"))) << kind;
  }
}

TEST_F(CalibrateCommand, DrawsWhatItSaw) {
  const Rgba8 mark{240, 228, 66, 255}, never{70, 28, 28, 255};
  for (const char* kind : {"extrinsics", "head", "background"}) {
    const std::string picture = path(std::string(kind) + ".png");
    const ProcessResult result =
        vindu({"calibrate", kind, "--wall", wall_, "--picture", picture, "--dry-run"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(has_colour(picture, never)) << kind;
    EXPECT_EQ(has_colour(picture, mark), std::string(kind) != "head") << kind;
  }
}

TEST_F(CalibrateCommand, OfTheWallDrawsWhatItShowsPointByPoint) {
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  const ProcessResult result = vindu({"calibrate", "wall", "--wall", wall_, "--targets", "3",
                                      "--draw", path("pages"), "--dry-run"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_in("pages"),
              ::testing::ElementsAre("touch-1.png", "touch-2.png", "touch-3.png", "wall-1.png",
                                     "wall-2.png", "wall-3.png", "wall-done.png"));
  const Image tile = read_png(path("pages/touch-1.png"));
  EXPECT_EQ((SizePx{tile.width_px, tile.height_px}), (SizePx{1024, 768}));
}

TEST_F(CalibrateCommand, OfTheWallSaysWhereItHasFewerPointsThanAskedFor) {
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  const ProcessResult result =
      vindu({"calibrate", "wall", "--wall", wall_, "--targets", "20", "--dry-run"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("warning: two cameras see 12 tile corners together, not 20"));
}

TEST_F(CalibrateCommand, OfTheWallInAWindowRunsToItsEnd) {
  const VirtualDisplay display;
  ASSERT_NE(display.name(), "") << "Xvfb does not start";
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  const ProcessResult result =
      vindu({"calibrate", "wall", "--wall", wall_, "--targets", "3"}, display.environment());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("the window shows"));
  EXPECT_THAT(bytes_of(path("calibration/cameras.toml")), HasSubstr("wand + wall"));
}

TEST_F(CalibrateCommand, OfTheWallWithoutPlacedCamerasIsRefused) {
  const ProcessResult result = vindu({"calibrate", "wall", "--wall", wall_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("wand"));
}

TEST_F(CalibrateCommand, OfAHeadWritesItsLedsAndWarnsOfSymmetry) {
  const ProcessResult result = vindu({"calibrate", "head", "--wall", wall_, "--eye-at", "0,0.1,2"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("leds_m = [["), HasSubstr("warning")));
  EXPECT_THAT(bytes_of(path("calibration/heads.toml")), HasSubstr("[[calibrated_head]]"));
}

// The result has its origin there; the wall file's helmet has not.
TEST_F(CalibrateCommand, OfAHeadComparesItWithTheTruthFromItsRearmostLed) {
  std::string wall = bytes_of(wall_);
  const std::size_t from = wall.find("leds_m = [");
  wall.replace(from, wall.find('\n', from) - from,
               "leds_m = [[-0.12, 0, -0.05], [0, 0.06, 0.02], [0.07, 0, -0.09]]");
  const ProcessResult result = vindu({"calibrate", "head", "--wall", write("up.toml", wall)});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              ::testing::ContainsRegex("LEDs at most [0-4]\\.. mm off, eye [0-4]\\.. mm"));
}

TEST_F(CalibrateCommand, OfAHeadRefusesAnotherNumberOfLedsThanEmulatedCamerasSee) {
  const ProcessResult result = vindu({"calibrate", "head", "--wall", wall_, "--leds", "4"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("--leds: is 4, and emulated cameras see the 3 LEDs of head"));
}

TEST_F(CalibrateCommand, OfAHeadOfManyLedsIsRefusedWithWhatToDo) {
  std::string wall = bytes_of(wall_);
  const std::string three = "leds_m = [";
  wall.replace(wall.find(three), three.size(),
               "leds_m = [[0.05, 0.06, -0.03], [-0.05, 0.06, -0.02], ");
  const ProcessResult result = vindu({"calibrate", "head", "--wall", write("five.toml", wall)});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("head: has 5 LEDs, and no two cameras tell of more than 4 dots"),
                    HasSubstr("leds_m")));
}

TEST_F(CalibrateCommand, OfAHeadRefusesTooManyLedsBeforeAnybodyLooks) {
  const ProcessResult result = vindu(
      {"calibrate", "head", "--wall", wall_, "--leds", "6", "--from", path("not-there.vrec")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("head: has 6 LEDs, and no two cameras tell of more than 4 dots"));
}

TEST_F(CalibrateCommand, OfAHeadRefusesAnEyeThatNoHeadHas) {
  const ProcessResult result =
      vindu({"calibrate", "head", "--wall", wall_, "--eye-at", "0,1.65,2"});  // in room
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("--eye-at: lies 1.4"));
  EXPECT_FALSE(std::filesystem::exists(path("calibration/heads.toml")));
}

TEST_F(CalibrateCommand, OfTheBackgroundMasksLampsAndRefusesAHelmetThatWalksAbout) {
  const ProcessResult lamps = vindu({"calibrate", "background", "--wall", wall_});
  EXPECT_EQ(lamps.exit_code, 0) << lamps.err;
  EXPECT_THAT(lamps.out,
              AllOf(HasSubstr("left: 1 masked"), HasSubstr("the truth: 1 lamp in view")));
  const std::string json = vindu({"calibrate", "background", "--wall", wall_, "--json"}).out;
  EXPECT_EQ(number_after(json, "missed"), 0);
  EXPECT_EQ(number_after(json, "needless"), 0);
  EXPECT_LT(number_after(json, "off_px"), 1.5);
  ASSERT_EQ(
      vindu({"record", "--out", path("walk.vrec"), "--wall", wall_, "--seconds", "8"}).exit_code,
      0);
  const ProcessResult walk =
      vindu({"calibrate", "background", "--wall", wall_, "--from", path("walk.vrec")});
  EXPECT_EQ(walk.exit_code, 1);
  EXPECT_THAT(walk.err, AllOf(HasSubstr("of its dots move"), HasSubstr("hide the helmet")));
}

TEST_F(CalibrateCommand, ByMoreLedsThanACameraSeesIsRefusedAtOnce) {
  for (const char* kind : {"intrinsics", "extrinsics"}) {
    const ProcessResult result = vindu({"calibrate", kind, "--wall", wall_, "--grid", "4,3"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("--grid: has 12 LEDs, and camera left sees 4 at once"));
  }
}

TEST_F(CalibrateCommand, OfAPlaceIsNoSurerThanTheFocalLength) {
  const auto sigma_mm = [&] {
    const std::string out =
        vindu({"calibrate", "extrinsics", "--wall", wall_, "--camera", "left", "--json"}).out;
    return std::stod(out.substr(out.find("\"position_sigma_mm\":") + 20));
  };
  EXPECT_GT(sigma_mm(), 120);  // 50 of 1335 px, at 3.5 m
  ASSERT_EQ(vindu({"calibrate", "wand", "--wall", wall_}).exit_code, 0);
  EXPECT_LT(sigma_mm(), 60);
}

TEST_F(CalibrateCommand, OfAPlaceFarFromWhereTheCameraWasSaysSo) {
  std::filesystem::create_directories(path("calibration"));
  write("calibration/cameras.toml",
        "[[calibrated_camera]]\nname = \"left\"\nposition_m = [6, 2.3, 5]\n"
        "rotation_xyzw = [0, 0, 0, 1]\n");
  const ProcessResult result =
      vindu({"calibrate", "extrinsics", "--wall", wall_, "--spacing-mm", "250", "--dry-run"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("left: was found 7.0 m from where its calibration has it, turned by"),
                    HasSubstr("--rig-at")));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("right: was found")));
}

TEST_F(CalibrateCommand, ByARecordingOfCamerasThatWereOffIsRefused) {
  const std::string nothing = write("off.txt", "# vindu recording\n");
  const ProcessResult result = vindu({"calibrate", "wand", "--wall", wall_, "--from", nothing});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("off.txt"), HasSubstr("holds no reports")));
}

TEST_F(CalibrateCommand, ByARigPrintsOneLineOfJsonAndWritesNothingInADryRun) {
  for (const char* kind : {"intrinsics", "extrinsics"}) {
    const ProcessResult result =
        vindu({"calibrate", kind, "--wall", wall_, "--camera", "right", "--spacing-mm", "250",
               "--rig-at", "0,1.65,2", "--json", "--dry-run"});
    if (std::string(kind) == "extrinsics") {
      EXPECT_EQ(result.exit_code, 0);
      EXPECT_THAT(lines_of(result.out), ::testing::SizeIs(1));
    } else {
      EXPECT_EQ(result.exit_code, 2);  // a lens needs no place
    }
  }
  const ProcessResult lens =
      vindu({"calibrate", "intrinsics", "--wall", wall_, "--json", "--dry-run"});
  EXPECT_EQ(lens.exit_code, 0);
  EXPECT_THAT(lens.out, HasSubstr("\"focal_px\""));
  EXPECT_THAT(files_in("."), ::testing::ElementsAre("wall.toml"));
}

TEST_F(CalibrateCommand, WithoutAWallFileWritesNothingAndSaysSo) {
  const ProcessResult result = vindu({"calibrate", "wand", "--seconds", "30"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("--wall"));
}

TEST_F(CalibrateCommand, ThatIsTooShortIsRefused) {
  const ProcessResult result = vindu({"calibrate", "wand", "--wall", wall_, "--seconds", "2"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), ::testing::SizeIs(1));
  EXPECT_THAT(result.out, IsEmpty());
}

}  // namespace
}  // namespace vindu
