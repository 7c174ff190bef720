// vindu simulate under the manual clock: two runs of one seed are bit-equal, and another seed is
// another walk.
#include <cstring>
#include <utility>

#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// The picture goes to the tracked eye slowly at first; the error counts from then on.
constexpr const char* kSettled_s = "2.5";

class SimulateCommand : public AppTest {
 protected:
  /// Two tiles where the Tromsø wall has 28: drawing is most of the time.
  static std::string two_tiles() {
    std::string text = bytes_of(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
    for (const auto& [many, few] :
         {std::pair("columns = 7", "columns = 2"), std::pair("rows = 4", "rows = 1")})
      text.replace(text.find(many), std::strlen(many), few);
    return text;
  }
  ProcessResult simulate(const std::string& out, const std::string& seconds,
                         std::vector<std::string> more) const {
    std::vector<std::string> words = {"simulate", "--clock", "manual", "--scale", "0.03"};
    words.insert(words.end(), {"--wall", write("two.toml", two_tiles()), "--headless", "--json"});
    words.insert(words.end(), {"--seconds", seconds, "--out", path(out)});
    words.insert(words.end(), more.begin(), more.end());
    return vindu(words);
  }
  void expect_equal_pictures(const std::string& a, const std::string& b) const {
    ASSERT_THAT(files_in(a), ::testing::Contains("contact-sheet.png"));
    ASSERT_EQ(files_in(a), files_in(b));
    for (const std::string& name : files_in(a))
      EXPECT_EQ(bytes_of(path(a + "/" + name)) == bytes_of(path(b + "/" + name)), true) << name;
  }
};

/// What the JSON says of one row, as text.
std::string figures_of(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\"");
  return at == std::string::npos ? "" : json.substr(at, json.find('}', at) - at);
}

TEST_F(SimulateCommand, IsBitEqualOnAPath) {
  const ProcessResult once = simulate("a", "0.5", {"--mode", "loop"});
  const ProcessResult again = simulate("b", "0.5", {"--mode", "loop"});
  ASSERT_EQ(once.exit_code, 0) << once.err;
  EXPECT_THAT(once.out, ContainsRegex("\"frames\": (29|30),"));
  EXPECT_EQ(lines_of(once.out).back(), lines_of(again.out).back());
  expect_equal_pictures("a", "b");
}

TEST_F(SimulateCommand, IsBitEqualWhenTrackedWithOneSeedAndDiffersWithAnother) {
  const ProcessResult once = simulate("a", kSettled_s, {"--mode", "track", "--seed", "5"});
  const ProcessResult again = simulate("b", kSettled_s, {"--mode", "track", "--seed", "5"});
  const ProcessResult other = simulate("c", kSettled_s, {"--mode", "track", "--seed", "6"});
  ASSERT_EQ(once.exit_code, 0) << once.err;
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_EQ(lines_of(once.out).back(), lines_of(again.out).back());
  expect_equal_pictures("a", "b");
  ASSERT_THAT(figures_of(once.out, "eye_error_mm"), HasSubstr("mean"));
  EXPECT_NE(figures_of(once.out, "eye_error_mm"), figures_of(other.out, "eye_error_mm"));
}

TEST_F(SimulateCommand, ShowsWhatABadLinkCosts) {
  const ProcessResult good = simulate("a", kSettled_s, {"--mode", "track"});
  const ProcessResult bad = simulate("b", kSettled_s, {"--mode", "track", "--link", "bad"});
  ASSERT_EQ(good.exit_code, 0) << good.err;
  ASSERT_EQ(bad.exit_code, 0) << bad.err;
  const auto mean_error_mm = [](const ProcessResult& result) {
    return number_after(figures_of(result.out, "eye_error_mm"), "mean");
  };
  EXPECT_GT(mean_error_mm(good), 0);
  EXPECT_GT(mean_error_mm(bad), 3 * mean_error_mm(good));  // 13.9 and 1.5 mm
  EXPECT_GT(number_after(bad.out, "frames_lost"), number_after(good.out, "frames_lost"));
}

TEST_F(SimulateCommand, WritesALineForEachFrame) {
  const ProcessResult result =
      simulate("a", "0.5", {"--mode", "loop", "--csv", path("frames.csv")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = lines_of(bytes_of(path("frames.csv")));
  EXPECT_THAT(result.out, HasSubstr("\"frames\": " + std::to_string(lines.size() - 1) + ","));
  EXPECT_THAT(lines[0], HasSubstr("frame,time_s,"));
  EXPECT_THAT(lines[2], ContainsRegex("^2,0.016667,2,,,,0.0000,"));
  EXPECT_EQ(simulate("a", "0.1", {"--csv", "/no/such/frames.csv"}).exit_code, 1);
}

TEST_F(SimulateCommand, EndsWithATable) {
  const ProcessResult result = vindu({"simulate", "--clock", "manual", "--seconds", kSettled_s,
                                      "--scale", "0.03", "--out", path("out")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* row : {"frames in", "capture age", "draw all tiles", "report to photon",
                          "eye error when the light leaves", "head found"})
    EXPECT_THAT(result.out, HasSubstr(row));
}

TEST_F(SimulateCommand, IsWhatVinduDoesWithoutACommand) {
  // It ends when nobody reads on; without a display nothing else would end it soon.
  const ProcessResult result =
      run({"sh", "-c", "cd $0 && $1 2>&1 | grep --max-count=1 simulate", path("."), VINDU_PROGRAM});
  EXPECT_THAT(result.out, HasSubstr("info simulate: "));
  EXPECT_THAT(vindu({"--help"}).out, HasSubstr("Without a sub-command: vindu simulate"));
}

// It would run for 15 seconds, and print their table.
TEST_F(SimulateCommand, SaysAtOnceThatItsFolderCannotBeMade) {
  const std::string file = write("file", "");
  const ProcessResult result =
      vindu({"simulate", "--headless", "--scale", "0.03", "--out", file + "/out"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(file + "/out"));
  EXPECT_THAT(result.out, ::testing::IsEmpty());
}

TEST_F(SimulateCommand, RefusesToTrackWithoutCameras) {
  const std::string wall = write("wall.toml", R"([wall]
columns = 1
rows = 1
width_m = 2.0
height_m = 0.5
tile_width_px = 40
tile_height_px = 20
)");
  const ProcessResult result = vindu({"simulate", "--wall", wall, "--out", path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("[[camera]]"));
  EXPECT_THAT(result.err, HasSubstr(wall));
}

}  // namespace
}  // namespace vindu
