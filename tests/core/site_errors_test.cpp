// wall.toml: every error names file, line, field, value and what is allowed; all of them at once.
#include "core/site.h"
#include "tests/core/files.h"
#include "tests/core/matchers.h"

namespace vindu {
namespace {

using testing::complaint_about;
using ::testing::HasSubstr;
using ::testing::Not;

/// The smallest good file, with `more` behind it: its first line is line 8.
std::string complaint(const std::string& more) {
  return complaint_about(
      "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 2\nheight_m = 1\n"
      "tile_width_px = 100\ntile_height_px = 50\n" +
          more,
      read_site);
}

TEST(SiteErrors, AGoodFileHasNone) { EXPECT_EQ(complaint(""), ""); }

struct Case {
  std::string name;
  std::string text;
  std::string complaint;
};
std::ostream& operator<<(std::ostream& out, const Case& wrong) { return out << wrong.name; }

class SiteErrors : public ::testing::TestWithParam<Case> {};

TEST_P(SiteErrors, NameFileLineFieldValueAndWhatIsAllowed) {
  EXPECT_EQ(complaint(GetParam().text), GetParam().complaint);
}

const std::string kCamera = "[[camera]]\nname = \"a\"\nsource = \"emulated\"\n";
const std::string kVideo =
    "[[camera]]\nname = \"a\"\nsource = \"video\"\nposition_m = [0, 1, 2]\npitch_deg = 90\n";

INSTANTIATE_TEST_SUITE_P(
    Of, SiteErrors,
    ::testing::Values(
        Case{"ANumberOutOfRange", "rate_hz = 0.5\n",
             "FILE:8: wall.rate_hz: is 0.5; from 1 to 1000 is allowed"},
        Case{"AnInfiniteNumber", "rate_hz = inf\n",
             "FILE:8: wall.rate_hz: is inf; from 1 to 1000 is allowed"},
        Case{"NotANumber", "rate_hz = nan\n",
             "FILE:8: wall.rate_hz: is nan; from 1 to 1000 is allowed"},
        Case{"ATextForANumber", "rate_hz = \"fast\"\n",
             "FILE:8: wall.rate_hz: is \"fast\"; a number from 1 to 1000 is allowed"},
        Case{"ATruthForANumber", "rate_hz = true\n",
             "FILE:8: wall.rate_hz: is true; a number from 1 to 1000 is allowed"},
        Case{"ANumberForATruth", "mirror = 1\n",
             "FILE:8: wall.mirror: is 1; true or false is allowed"},
        Case{"AnAngleBetween", "rotate_deg = 45\n",
             "FILE:8: wall.rotate_deg: is 45; 0, 90, 180 or 270 is allowed"},
        Case{"AFractionForAWholeNumber", "rotate_deg = 0.5\n",
             "FILE:8: wall.rotate_deg: is 0.5; a whole number from 0 to 270 is allowed"},
        Case{"ANumberForAText", "hosts = 7\n",
             "FILE:8: wall.hosts: is 7; a text in quotes, not empty, is allowed"},
        Case{"AnEmptyText", "hosts = \"\"\n",
             "FILE:8: wall.hosts: is \"\"; a text in quotes, not empty, is allowed"},
        Case{"AFieldInAnotherUnit", "width_mm = 3\n",
             "FILE:8: wall.width_mm: is not known; did you mean \"width_m\"?"},
        Case{"AColumnTurnedTooFar", "curve_deg = 100\n",
             "FILE:8: wall.curve_deg: is 100; from 0 to 90 is allowed for 2 columns, 90 degrees "
             "from "
             "each to the next"},
        Case{"AnUnknownField", "bezel_mm = 3\n",
             "FILE:8: wall.bezel_mm: is not known; did you mean \"bezel_x_mm\"?"},
        Case{"AnUnknownTable", "[veiwer]\n",
             "FILE:8: veiwer: is not known; did you mean \"viewer\"?"},
        Case{"AnUnknownFieldLikeNoOther", "[viewer]\ncolour = 3\n",
             "FILE:9: viewer.colour: is not known; known here: default_eye_m, display_latency_ms"},
        Case{"TooFewCoordinates", "[viewer]\ndefault_eye_m = [1, 2]\n",
             "FILE:9: viewer.default_eye_m: is [1, 2]; 3 numbers from -1000 to 1000 in brackets "
             "are allowed"},
        Case{"ACoordinateOutOfRange", "[head]\neye_m = [0, 0, 20]\n",
             "FILE:9: head.eye_m: is [0, 0, 20]; 3 numbers from -1 to 1 in brackets are allowed"},
        Case{"NoLeds", "[head]\nleds_m = []\n",
             "FILE:9: head.leds_m: is []; 1 to 16 points [x, y, z], each number from -10 to 10, in "
             "brackets are allowed"},
        Case{"AnLedFarAway", "[head]\nleds_m = [[0, 0, 100]]\n",
             "FILE:9: head.leds_m: is [[0, 0, 100]]; 1 to 16 points [x, y, z], each number "
             "from -10 to 10, in brackets are allowed"},
        Case{"LedsThatAreOne", "[head]\nleds_m = [[0, 0, 0], [0.1, 0, 0], [0.1, 0.002, 0]]\n",
             "FILE:9: head.leds_m: has two LEDs 2.0 mm apart; at least 5 mm is allowed; measure "
             "them again, in metres"},
        Case{"LedsOfNoHead", "[head]\nleds_m = [[-4.5, 0, 0], [0, 0, 0], [4.5, 0, 0]]\n",
             "FILE:9: head.leds_m: has two LEDs 9.00 m apart; at most 2 m is allowed on one head; "
             "measure them again, in metres"},
        Case{"AFocalLengthInMillimetres",
             kCamera + "focal_px = 10\nposition_m = [0, 1, 2]\npitch_deg = 90\n",
             "FILE:11: camera[0].focal_px: is 10: a picture of 1024 pixels across would show 178 "
             "degrees; at least 138 px, for 150 degrees, is allowed; it is in pixels, not mm"},
        Case{"AWordThatIsNotAllowed", "[scene]\nplace = \"fill\"\n",
             "FILE:9: scene.place: is \"fill\" (did you mean \"fit\"?); allowed: fit, life-size, "
             "as-is"},
        Case{"ALockThatIsNone", "[cluster]\nlock = \"fre\"\n",
             "FILE:9: cluster.lock: is \"fre\" (did you mean \"free\"?); allowed: barrier, timed, "
             "free"},
        Case{"AWallNameOfTwoWords", "[cluster]\nname = \"my wall\"\n",
             "FILE:9: cluster.name: is \"my wall\"; up to 255 letters, digits and - _ . : are "
             "allowed"},
        Case{"LoopbackToAnotherHost", "[cluster]\nmaster = \"node0\"\ninterface = \"lo\"\n",
             "FILE:10: cluster.interface: is \"lo\", which no other host reaches; name the one to "
             "node0, or leave it out"},
        Case{"ADomainWithoutPorts", "[cluster]\ndomain = 231\n",
             "FILE:9: cluster.domain: is 231; from 0 to 230 is allowed"},
        Case{"TablesThatAreOne", "[camera]\nname = \"a\"\n",
             "FILE:8: camera: is a table; tables [[camera]] are allowed"},
        Case{"ATileThatIsNot", "[[tile]]\nname = \"tile-2-0\"\n",
             "FILE:9: tile[0].name: is \"tile-2-0\" (did you mean \"tile-0-0\"?); allowed: "
             "tile-0-0, tile-1-0"},
        Case{"ATileWithoutItsName", "[[tile]]\nhost = \"a\"\n[[tile]]\nhost = \"b\"\n",
             "FILE:8: tile[0].name: is missing; for example name = \"tile-0-0\"\n"
             "FILE:10: tile[1].name: is missing; for example name = \"tile-0-0\""},
        Case{"ATileTwice", "[[tile]]\nname = \"tile-0-0\"\n[[tile]]\nname = \"tile-0-0\"\n",
             "FILE:11: tile[1].name: \"tile-0-0\" is described twice; put its fields into one "
             "[[tile]]"},
        Case{"ATileWithOneCorner", "[[tile]]\nname = \"tile-0-0\"\nupper_left_m = [0, 0, 0]\n",
             "FILE:8: tile[0].lower_left_m: a tile's own place needs lower_left_m, lower_right_m "
             "and upper_left_m together"},
        Case{
            "ATileWithoutArea",
            "[[tile]]\nname = \"tile-0-0\"\nlower_left_m = [0, 0, 0]\n"
            "lower_right_m = [0, 0, 0]\nupper_left_m = [0, 1, 0]\n",
            "FILE:10: tile[0].lower_left_m: the edges are 0.0000 and 1.0000 m long; at least 0.001 "
            "m is allowed; measure the corners again"},
        Case{"ATileThatIsSkewed",
             "[[tile]]\nname = \"tile-0-0\"\nlower_left_m = [0, 0, 0]\n"
             "lower_right_m = [1, 0, 0]\nupper_left_m = [0.04, 1, 0]\n",
             "FILE:10: tile[0].lower_left_m: the edges meet at 87.7 degrees; from 88 to 92 is "
             "allowed; measure the corners again"},
        Case{"ACameraWithoutADirection", kCamera + "position_m = [0, 1, 2]\n",
             "FILE:8: camera[0].look_at_m: is missing; write look_at_m = [0, 1.65, 2.0], or "
             "heading_deg, pitch_deg, roll_deg"},
        Case{"ACameraWithTwoDirections",
             kCamera + "position_m = [0, 1, 2]\nlook_at_m = [0, 0, 0]\npitch_deg = 90\n",
             "FILE:12: camera[0].look_at_m: stands beside heading_deg, pitch_deg or roll_deg; give "
             "one of both"},
        Case{"ACameraThatLooksAtItself",
             kCamera + "position_m = [0, 1, 2]\nlook_at_m = [0, 1, 2]\n",
             "FILE:12: camera[0].look_at_m: is 0.0000 m from position_m; at least 0.001 m is "
             "allowed"},
        Case{"TwoCamerasOfOneName",
             kCamera + "position_m = [0, 1, 2]\nlook_at_m = [0, 0, 0]\n" + kCamera +
                 "position_m = [0, 1, 2]\nlook_at_m = [0, 0, 0]\n",
             "FILE:14: camera[1].name: \"a\" stands twice; give every camera its own name"},
        Case{"TwoCamerasOfOneWiimote",
             "[[camera]]\nname = \"a\"\nsource = \"wiimote\"\naddress = \"00:1f:32:00:00:0A\"\n"
             "position_m = [0, 1, 2]\npitch_deg = 90\n"
             "[[camera]]\nname = \"b\"\nsource = \"wiimote\"\naddress = \"00:1F:32:00:00:0a\"\n"
             "position_m = [0, 1, 2]\npitch_deg = 90\n",
             "FILE:17: camera[1].address: \"00:1F:32:00:00:0a\" is that of \"a\", too; give every "
             "camera its own device"},
        Case{"ACameraOfAnotherKind",
             "[[camera]]\nname = \"a\"\nsource = \"wimote\"\nposition_m = [0, 1, 2]\n"
             "look_at_m = [0, 0, 0]\n",
             "FILE:10: camera[0].source: is \"wimote\" (did you mean \"wiimote\"?); allowed: "
             "emulated, wiimote, video"},
        Case{"ASensitivityThatIsNone",
             kCamera + "sensitivity = \"wii-6\"\nposition_m = [0, 1, 2]\npitch_deg = 90\n",
             "FILE:11: camera[0].sensitivity: is \"wii-6\"; allowed: wii-1, wii-2, wii-3, wii-4, "
             "wii-5, marcan, inio, maximum, or 22 hexadecimal digits (blocks 1 and 2)"},
        Case{"ASensitivityOfTooFewDigits",
             kCamera + "sensitivity = \"0200\"\nposition_m = [0, 1, 2]\npitch_deg = 90\n",
             "FILE:11: camera[0].sensitivity: is \"0200\"; allowed: wii-1, wii-2, wii-3, wii-4, "
             "wii-5, marcan, inio, maximum, or 22 hexadecimal digits (blocks 1 and 2)"},
        Case{"ADotFormatThatIsNone",
             kCamera + "dot_format = \"ful\"\nposition_m = [0, 1, 2]\npitch_deg = 90\n",
             "FILE:11: camera[0].dot_format: is \"ful\" (did you mean \"full\"?); allowed: basic, "
             "extended, full"},
        Case{"AVideoCameraWithoutADevice", kVideo,
             "FILE:8: camera[0].device: is missing; write device = \"/dev/video0\", or file for a "
             "video"},
        Case{"AVideoCameraWithDeviceAndFile",
             kVideo + "file = \"a.avi\"\ndevice = \"/dev/video0\"\n",
             "FILE:14: camera[0].device: stands beside file; give one of both"},
        Case{"AThresholdThatNothingExceeds", kVideo + "file = \"a.avi\"\nthreshold = 255\n",
             "FILE:14: camera[0].threshold: is 255; from 1 to 254 is allowed"},
        Case{"MoreDotsThanAnObservationHolds", kVideo + "file = \"a.avi\"\nmax_dots = 17\n",
             "FILE:14: camera[0].max_dots: is 17; from 1 to 16 is allowed"},
        Case{"AreasThatNoBlobHas", kVideo + "file = \"a.avi\"\nmax_area_px = 2\nmin_area_px = 4\n",
             "FILE:15: camera[0].min_area_px: leaves no dots: it is more than max_area_px, which "
             "is 2"},
        Case{"ANearlyKnownFieldOfAVideoCamera", kVideo + "file = \"a.avi\"\ntreshold = 9\n",
             "FILE:14: camera[0].treshold: is not known; did you mean \"threshold\"?"},
        Case{"AVideoCamerasFieldOfAWiimote",
             "[[camera]]\nname = \"a\"\nsource = \"wiimote\"\nexposure = 3\n"
             "position_m = [0, 1, 2]\npitch_deg = 90\n",
             "FILE:11: camera[0].exposure: is not known; known here: name, source, address, "
             "sensitivity, dot_format, lag_ms, focal_px, focal_aspect, centre_px, distortion, "
             "position_m, look_at_m, heading_deg, pitch_deg, roll_deg, "
             "calibration"}),
    [](const auto& wrong) { return wrong.param.name; });

TEST(SiteErrors, NameEveryFieldThatIsMissing) {
  const std::string all = complaint_about("[wall]\n", read_site);
  for (const char* field :
       {"columns", "rows", "width_m", "height_m", "tile_width_px", "tile_height_px"})
    EXPECT_THAT(all, HasSubstr("FILE:1: wall." + std::string(field) + ": is missing; for example"));
}

TEST(SiteErrors, NameAWallThatIsMissing) {
  EXPECT_THAT(complaint_about("", read_site), HasSubstr("FILE:1: wall: is missing; for example"));
  EXPECT_THAT(complaint_about("[viewer]\n", read_site), HasSubstr("wall: is missing"));
}

TEST(SiteErrors, NameATableThatIsANumber) {
  EXPECT_THAT(complaint_about("viewer = 3\n", read_site),
              HasSubstr("FILE:1: viewer: is 3; a table [viewer] is allowed"));
}

TEST(SiteErrors, LeaveAPictureBetweenTheBezels) {
  const std::string wrong = complaint_about(
      "[wall]\ncolumns = 3\nrows = 3\nwidth_m = 2\nheight_m = 1\n"
      "tile_width_px = 100\ntile_height_px = 50\nbezel_x_mm = 1000\nbezel_y_mm = 500\n",
      read_site);
  EXPECT_EQ(wrong,
            "FILE:8: wall.bezel_x_mm: is 1000; less than 1000.0 is allowed, 2000 mm for 2 bezels\n"
            "FILE:9: wall.bezel_y_mm: is 500; less than 500.0 is allowed, 1000 mm for 2 bezels");
}

TEST(SiteErrors, ComeAllAtOnceInTheOrderOfTheLines) {
  EXPECT_EQ(complaint("mirror = 1\nrate_hz = 0\n[viewer]\ndefault_eye_m = 3\nlatency = 3\n"),
            "FILE:8: wall.mirror: is 1; true or false is allowed\n"
            "FILE:9: wall.rate_hz: is 0; from 1 to 1000 is allowed\n"
            "FILE:11: viewer.default_eye_m: is 3; 3 numbers from -1000 to 1000 in brackets are "
            "allowed\n"
            "FILE:12: viewer.latency: is not known; known here: default_eye_m, display_latency_ms");
}

TEST(SiteErrors, CutLongValuesAndStayOnOneLine) {
  const std::string wrong = complaint("rate_hz = \"\"\"" + std::string(500, 'x') + "\ny\"\"\"\n");
  EXPECT_LT(wrong.size(), 200u);
  EXPECT_THAT(wrong, Not(HasSubstr("\n")));
}

TEST(SiteErrors, OfSyntaxNameTheLine) {
  EXPECT_THAT(complaint("rate_hz = = 3\n"), HasSubstr("FILE:8: is not valid TOML: "));
  EXPECT_THAT(complaint("columns = 3\n"), HasSubstr("FILE:8: is not valid TOML: "));
}

TEST(SiteErrors, OfAFileThatIsNotThereSayWhatToDo) {
  for (const char* file : {"/nowhere/wall.toml", "/"}) try {
      read_site(file);
      ADD_FAILURE() << file << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(),
                std::string(file) + ": cannot be read; give the path of an existing TOML file");
    }
}

}  // namespace
}  // namespace vindu
