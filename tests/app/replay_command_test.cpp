// vindu record and vindu replay: a recording says what the cameras said, whole or cut off, and
// gives the same poses every time, and the same as were tracked live.
#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <thread>
#include <utility>

#include "core/camera_path.h"
#include "simulator/emulated_room.h"
#include "tests/app/process.h"
#include "tests/wall/children.h"
#include "tracker/recording_devices.h"
#include "tracker/tracker.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

const std::string kWall = VINDU_SOURCE_DIR "/assets/walls/tromso.toml";

/// What a line of poses says of the eye.
std::string eye_text(const Vec3& eye) {
  return fmt::format(R"("eye_in_wall_m":[{},{},{}])", eye.x(), eye.y(), eye.z());
}

class ReplayCommand : public AppTest {
 protected:
  /// Records five seconds of the emulated room under a manual clock, and tracks meanwhile as replay
  /// does: at multiples of the wall's period, one line for what is new.
  std::vector<std::string> record_and_track_live(const std::string& file) const {
    const Site site = read_site(kWall);
    ManualClock clock;
    const EmulatedRoom room(site, clock);
    RecordingInfo info;
    info.program = "vindu test";
    info.wall_file = kWall;
    info.wall_text = bytes_of(kWall);
    for (const CameraConfig& camera : site.cameras)
      info.devices.push_back({static_cast<int>(info.devices.size()), camera.name});
    RecordingWriter writer(path(file), info);
    std::vector<WiimoteReader> readers;
    for (int i = 0; i < static_cast<int>(site.cameras.size()); ++i)
      readers.emplace_back(std::make_unique<RecordingHidDevice>(room.connect(i), writer, i), i);
    Tracker tracker(site.cameras, site.heads, site.wall.room_from_wall);
    std::vector<std::string> eyes;
    std::optional<PoseSample> said;
    for (int tick = 0; tick <= 5 * site.rate_hz; ++tick) {
      const Time now{from_seconds(tick / site.rate_hz)};
      for (WiimoteReader& reader : readers)
        while (const auto seen = reader.next(now)) tracker.absorb(*seen);
      const auto pose = tracker.track(now, now);
      if (pose && (!said || pose->capture_time != said->capture_time || pose->level != said->level))
        eyes.push_back(eye_text(tracker.eye_in_wall(*pose)));
      said = pose;
    }
    return eyes;
  }
  std::string cut(const std::string& file, std::size_t bytes) const {
    const std::string whole = bytes_of(path(file));
    return write("cut.vrec", whole.substr(0, whole.size() - bytes));
  }
};

TEST_F(ReplayCommand, TellsThePartsOfMotionToPhotonThatARecordingKnows) {
  record_and_track_live("a.vrec");
  const ProcessResult result = vindu({"replay", path("a.vrec"), "--parts"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ContainsRegex("capture age +[0-9]+\\.[0-9]+ "));
  EXPECT_THAT(result.out, ContainsRegex("solve +[0-9]+\\.[0-9]+ "));
  EXPECT_THAT(result.out, HasSubstr("display are not in a recording"));
  EXPECT_THAT(result.out, Not(HasSubstr("eye_in_wall_m")));
}

TEST_F(ReplayCommand, TracksTheSamePosesAsWereTrackedLive) {
  const auto eyes = record_and_track_live("a.vrec");
  const ProcessResult result = vindu({"replay", path("a.vrec"), "--track"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto lines = lines_of(result.out);
  std::erase_if(lines, [](const std::string& line) {
    return line.find("eye_in_wall_m") == std::string::npos;
  });
  ASSERT_GT(eyes.size(), 50u);
  ASSERT_EQ(lines.size(), eyes.size());
  for (std::size_t i = 0; i < lines.size(); ++i) ASSERT_THAT(lines[i], HasSubstr(eyes[i])) << i;
}

TEST_F(ReplayCommand, TracksWithACameraThatWasBumpedAndSaysWhatDoesNotFit) {
  record_and_track_live("a.vrec");
  std::string wall = bytes_of(kWall);
  const std::size_t right = wall.find("look_at_m", wall.find("name = \"right\""));
  wall.replace(wall.find("1.65", right), 4, "1.67");  // 0.36 degrees higher
  const ProcessResult result =
      vindu({"replay", path("a.vrec"), "--track", "--wall", write("bumped.toml", wall)});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr(R"("level":"six-dof")"));
  EXPECT_THAT(result.out, ContainsRegex("\"disagreement_px\":[3-9],"));
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("left and right contradict each other by"), HasSubstr("calibrate")));
}

TEST_F(ReplayCommand, WritesTheEyeAsAPathThatAFilmFollows) {
  record_and_track_live("a.vrec");
  const ProcessResult result =
      vindu({"replay", path("a.vrec"), "--track", "--path", path("walk.toml")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const CameraPath walk = read_camera_path(path("walk.toml"));
  EXPECT_GT(walk.period_s(), 1.5);
  double way_m = 0;
  for (double t_s = 0.1; t_s < walk.period_s() - 1; t_s += 0.1)
    way_m += (walk.eye_at(t_s) - walk.eye_at(t_s - 0.1)).norm();
  EXPECT_GT(way_m, 0.1) << "the person walks";
  EXPECT_EQ(vindu({"replay", path("a.vrec"), "--path", "/no/such/folder/a.toml"}).exit_code, 1);
}

TEST_F(ReplayCommand, IsBitEqualEachTimeAtBothSpeedsAndThroughTheTextForm) {
  record_and_track_live("a.vrec");
  const std::string once = vindu({"replay", path("a.vrec"), "--track"}).out;
  ASSERT_THAT(lines_of(once), Not(SizeIs(0)));
  EXPECT_EQ(vindu({"replay", path("a.vrec"), "--track"}).out, once);
  EXPECT_EQ(vindu({"replay", path("a.vrec"), "--track", "--speed", "real"}).out, once);
  const std::string text = write("a.txt", vindu({"replay", path("a.vrec"), "--text"}).out);
  EXPECT_EQ(vindu({"replay", text, "--track", "--wall", kWall}).out, once);
  const std::string json = vindu({"replay", path("a.vrec"), "--json"}).out;
  EXPECT_EQ(vindu({"replay", text, "--json"}).out, json);
}

TEST_F(ReplayCommand, PrintsFiguresOfWhatARecordingHolds) {
  record_and_track_live("a.vrec");
  const ProcessResult result = vindu({"replay", path("a.vrec")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"vindu test", "left", "right", "gaps, ms", "0x33: ", "no problems"})
    EXPECT_THAT(result.out, HasSubstr(part));
}

TEST_F(ReplayCommand, KeepsItsColumnsApartHoweverLargeTheFigures) {
  const std::string name = "a-camera-of-a-long-name";
  const std::string text = write("a.txt", name + " 1000 22000016\n" + name + " 1005 22000016\n");
  const ProcessResult result = vindu({"replay", text});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ContainsRegex("\n  " + name + " +2 +0\\.000 +200000000\\.00 +0 "));
  EXPECT_THAT(result.out, ContainsRegex("\n  " + name + " +1( +0)+\n"));
}

TEST_F(ReplayCommand, PrintsALineOfJsonForEachReport) {
  const std::string text = write("a.txt",
                                 "left 1000 33 60 60 80 81 82 2a 10 23 ff ff ff ff ff ff ff ff ff\n"
                                 "left 2000 2200001600\nright 2500 ab\n");
  const auto lines = lines_of(vindu({"replay", text, "--json"}).out);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_EQ(
      lines[0],
      R"({"device":"left","t_ns":1000,"report":"0x33","kind":"data","buttons":0,)"
      R"("acceleration_raw":[515,518,522],"dots":[{"slot":0,"x_px":554,"y_px":16,"size":3}]})");
  EXPECT_THAT(lines[1], HasSubstr(R"("kind":"acknowledgement","buttons":0,"command":"0x16")"));
  EXPECT_EQ(lines[2], R"({"device":"right","t_ns":2500,"report":"0xab","problem":"unknown id"})");
}

TEST_F(ReplayCommand, WarnsOfATornEndAndReadsTheRest) {
  record_and_track_live("a.vrec");
  const ProcessResult result = vindu({"replay", cut("a.vrec", 5)});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, ContainsRegex("cut.vrec: the last [0-9]+ bytes are no whole record"));
  EXPECT_THAT(result.out, ContainsRegex("[0-9]+ bytes lost at the end"));
}

TEST_F(ReplayCommand, RefusesDamageWithItsPlaceAndReadsAroundItWhenAsked) {
  record_and_track_live("a.vrec");
  std::string bytes = bytes_of(path("a.vrec"));
  bytes[bytes.size() - 1000] ^= 1;
  const std::string bad = write("bad.vrec", bytes);
  const ProcessResult refused = vindu({"replay", bad});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("bad.vrec, byte "));
  EXPECT_THAT(refused.err, HasSubstr("--skip-damage"));
  const ProcessResult read = vindu({"replay", bad, "--skip-damage"});
  EXPECT_EQ(read.exit_code, 0);
  EXPECT_THAT(read.out, ContainsRegex("[0-9]+ damaged bytes skipped"));
}

TEST_F(ReplayCommand, SaysWhatIsWrongWithTextAndWhatToDo) {
  const ProcessResult bad = vindu({"replay", write("bad.txt", "left 1 33\nleft 2 3x\n")});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, HasSubstr("bad.txt:2: \"3x\" is not a byte"));
  const ProcessResult none = vindu({"replay", write("none.txt", "# nothing\n")});
  EXPECT_THAT(none.err, HasSubstr("holds no reports"));
  const ProcessResult clocks =
      vindu({"replay", write("clocks.txt", "a 1000 33\nb 1700000000000000000 33\n")});
  EXPECT_THAT(clocks.err, HasSubstr("one clock"));
  EXPECT_THAT(clocks.err, HasSubstr("clocks.txt:2: "));
}

TEST_F(ReplayCommand, NeedsAWallToTrackWithWhereTheRecordingHoldsNone) {
  const std::string text = write("a.txt", "left 1000 33\n");
  const ProcessResult without = vindu({"replay", text, "--track"});
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.err, HasSubstr("--wall FILE"));
  const ProcessResult strange =
      vindu({"replay", write("b.txt", "elsewhere 1000 33\n"), "--track", "--wall", kWall});
  EXPECT_THAT(strange.err, HasSubstr("none of its devices is a camera"));
}

TEST_F(ReplayCommand, IsCalledWrongWithTwoFormsAtOnce) {
  EXPECT_EQ(vindu({"replay", "a.vrec", "--text", "--json"}).exit_code, 2);
  EXPECT_EQ(vindu({"replay"}).exit_code, 2);
}

void await_bytes(const std::string& file, std::uintmax_t bytes) {
  std::error_code not_there;
  while (!std::filesystem::exists(file) || std::filesystem::file_size(file, not_there) < bytes)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST_F(ReplayCommand, ReadsWhatRecordWroteUntilItWasInterrupted) {
  Child recording({VINDU_PROGRAM, "record", "--out", path("a.vrec"), "--rotate-mb", "0.012"},
                  path("said"));
  await_bytes(path("a.1.vrec"), 1000);
  recording.send(SIGINT);
  EXPECT_EQ(recording.end(), 0);
  EXPECT_THAT(bytes_of(path("said")), HasSubstr(path("a.vrec") + ": "));
  EXPECT_THAT(files_in("."), Contains("a.1.vrec"));
  const ProcessResult result = vindu({"replay", path("a.vrec")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr(kWall));
  EXPECT_THAT(result.err, Not(HasSubstr("warning")));
}

TEST_F(ReplayCommand, NamesAPartOfARotatedRecordingThatIsMissing) {
  ASSERT_EQ(vindu({"record", "--seconds", "2", "--rotate-mb", "0.004", "--out", path("a.vrec")})
                .exit_code,
            0);
  ASSERT_THAT(files_in("."), Contains("a.2.vrec"));
  std::filesystem::remove(path("a.1.vrec"));
  const ProcessResult result = vindu({"replay", path("a.vrec")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("Problems\n  " + path("a.1.vrec") + " is missing"));
  EXPECT_THAT(result.err, HasSubstr(path("a.2.vrec") + " belongs to this recording"));
}

TEST_F(ReplayCommand, ReadsEachDotFormatAsTheWallFileHasIt) {
  std::string wall = bytes_of(kWall);
  const std::string source = "source = \"emulated\"", dots = "dot_format = \"full\"\n";
  for (std::size_t at = 0; (at = wall.find(source, at)) != std::string::npos; at += source.size())
    wall.insert(std::exchange(at, at + dots.size()), dots);
  const std::string full = write("full.toml", wall);
  ASSERT_EQ(vindu({"record", "--wall", full, "--seconds", "2", "--out", path("a.vrec")}).exit_code,
            0);
  const ProcessResult figures = vindu({"replay", path("a.vrec")});
  EXPECT_THAT(figures.out, HasSubstr("0x3e: "));
  EXPECT_THAT(figures.out, HasSubstr("no problems"));
  EXPECT_THAT(vindu({"replay", path("a.vrec"), "--track"}).out, HasSubstr("eye_in_wall_m"));
  const std::string text = write("a.txt", vindu({"replay", path("a.vrec"), "--text"}).out);
  EXPECT_THAT(vindu({"replay", text, "--wall", full}).out, HasSubstr("no problems"));
}

TEST_F(ReplayCommand, PrintsFiguresAlsoWhereTheWallFileInItCannotBeRead) {
  {
    RecordingWriter writer(path("a.vrec"), {.program = "vindu test",
                                            .started_utc_ns = 0,
                                            .started = Time{},
                                            .wall_file = "later.toml",
                                            .wall_text = "[a table of a later version]",
                                            .devices = {{0, "left"}}});
    writer.add(0, Time{}, std::vector<std::uint8_t>{0x30, 0, 0});
  }
  const ProcessResult result = vindu({"replay", path("a.vrec")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("0x30: 1"));
  EXPECT_THAT(result.err, HasSubstr("the wall file in it: later.toml"));
}

TEST_F(ReplayCommand, TellsOfARecordingTheMachineAndTheDevicesThatWereConnected) {
  ASSERT_EQ(vindu({"record", "--seconds", "1", "--out", path("a.vrec")}).exit_code, 0);
  const ProcessResult result = vindu({"replay", path("a.vrec")});
  EXPECT_THAT(result.out, ContainsRegex("vindu [0-9.]+ on Linux [0-9].*, hidapi [0-9]"));
  EXPECT_THAT(result.out,
              ContainsRegex("[0-9.]+ s  left: Nintendo RVL-CNT-01 .057e:0306., 00:1f:c5"));
  EXPECT_THAT(result.out, HasSubstr("right: Nintendo RVL-CNT-01"));
}

TEST_F(ReplayCommand, ReadsWhatRecordWroteUntilItWasKilled) {
  Child recording({VINDU_PROGRAM, "record", "--out", path("a.vrec")}, path("said"));
  await_bytes(path("a.vrec"), 3000);
  recording.send(SIGKILL);
  recording.end();
  const ProcessResult result = vindu({"replay", path("a.vrec"), "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(lines_of(result.out).size(), 10u);
}

TEST_F(ReplayCommand, LeavesARecordingAloneThatRecordWouldOverwrite) {
  const std::string file = write("a.vrec", "precious");
  const ProcessResult result = vindu({"record", "--seconds", "1", "--out", file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(file));
  EXPECT_EQ(bytes_of(file), "precious");
}

}  // namespace
}  // namespace vindu
