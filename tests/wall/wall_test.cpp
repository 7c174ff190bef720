// A wall of real processes: how its frames agree, and what it does when some of them die.
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/wall/wall_fixture.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kCameras = R"(
[[camera]]
name = "left"
source = "emulated"
position_m = [-1.0, 2.3, 5.0]
look_at_m = [0, 1.65, 2.0]
focal_px = 1335
[[camera]]
name = "right"
source = "emulated"
position_m = [1.0, 2.3, 5.0]
look_at_m = [0, 1.65, 2.0]
focal_px = 1335
)";

/// Between commas; empty ones too.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char letter : line)
    if (letter == ',')
      cells.emplace_back();
    else
      cells.back() += letter;
  return cells;
}

TEST_F(WallTest, ShowsTheSameFramesOnAllTilesAndTheirPixelsSaySo) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master();
  for (const std::string& file : files()) await_swaps(file, 60);
  master.send(SIGINT);
  EXPECT_EQ(master.end(), 0);
  expect_right(files());
  EXPECT_THAT(bytes_of(path("master.log")), HasSubstr("\"frames\":"));
  for (Child& tile : tiles) {
    tile.send(SIGTERM);
    EXPECT_EQ(tile.end(), 0);
  }
}

/// Of these swaps; without two of them none.
double median_gap_s(std::vector<Swap> swaps) {
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < swaps.size(); ++i)
    gaps_s.push_back(1e-9 * static_cast<double>(swaps[i].time_ns - swaps[i - 1].time_ns));
  if (gaps_s.empty()) return 0;
  std::ranges::sort(gaps_s);
  return gaps_s[gaps_s.size() / 2];
}

// Nobody is tracked, so the eye is the default one. A busy machine makes gaps longer, never
// shorter.
TEST_F(WallTest, RestsWhileNothingChangesAndGoesOnWhenSomethingDoes) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master({VINDU_PROGRAM, "master", small_model(), "--wall", wall_file_, "--json"},
               path("master.log"));
  for (const char* tile : {"tile-0-0", "tile-1-0", "tile-0-1", "tile-1-1"})
    await_log(std::string(tile) + ": admitted");
  while (testing::vindu({"status", "--wall", wall_file_}).out.find("nothing changes") ==
         std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));

  const auto next_swaps = [&](std::size_t count) {
    const std::size_t before = swaps_in(path("tile-0-0.csv")).size();
    await_swaps("tile-0-0.csv", count);
    std::vector<Swap> swaps = swaps_in(path("tile-0-0.csv"));
    swaps.erase(swaps.begin(), swaps.begin() + static_cast<std::ptrdiff_t>(before));
    return swaps;
  };
  EXPECT_GT(median_gap_s(next_swaps(5)), 0.3);
  tiles[3].send(SIGKILL);
  tiles[3].end();
  Child again = start_tiles({"tile-1-1"}, "again.csv");  // gets the picture, and the lock
  await_swaps("again.csv", 2);
  const std::uint64_t before = swaps_in(path("tile-0-0.csv")).back().frame;
  EXPECT_EQ(testing::vindu({"goto", "0,0,1", "--wall", wall_file_}).exit_code, 0);
  const std::vector<Swap> glide = next_swaps(10);
  EXPECT_GT(glide.back().frame, before);
  EXPECT_EQ(testing::vindu({"stop", "--wall", wall_file_}).exit_code, 0);
  EXPECT_EQ(master.end(), 0);
  EXPECT_THAT(bytes_of(path("master.log")), ::testing::ContainsRegex("\"undrawn\":[1-9]"));
}

TEST_F(WallTest, GoesOnWithoutATileThatIsKilledAndTakesItInAgain) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master();
  for (const std::string& file : files()) await_swaps(file, 30);
  tiles[2].send(SIGKILL);
  EXPECT_EQ(tiles[2].end(), 128 + SIGKILL);
  for (const char* tile : {"tile-0-0", "tile-1-0", "tile-1-1"})
    await_swaps(std::string(tile) + ".csv", 40);
  Child again = start_tiles({"tile-0-1"}, "again.csv");
  await_log("tile-0-1: restarted");
  await_swaps("again.csv", 30);
  expect_right({"tile-0-0.csv", "tile-1-0.csv", "tile-0-1.csv", "tile-1-1.csv", "again.csv"});
}

TEST_F(WallTest, GoesOnWithoutATileThatHangsUntilItGoesOnItself) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master();
  for (const std::string& file : files()) await_swaps(file, 30);
  tiles[0].send(SIGSTOP);
  await_log("tile-0-0: lost");
  await_swaps("tile-1-1.csv", 40);
  tiles[0].send(SIGCONT);
  await_swaps("tile-0-0.csv", 40);
  expect_right(files());
}

TEST_F(WallTest, FollowsAMasterThatIsKilledAndStartedAgain) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  {
    Child first = start_master();
    for (const std::string& file : files()) await_swaps(file, 30);
    first.send(SIGKILL);
    first.end();
  }
  Child second = start_master();
  for (const std::string& file : files()) await_swaps(file, 30);
  expect_right(files());
  for (const std::string& file : files()) {
    const std::vector<Swap> swaps = swaps_in(path(file));
    EXPECT_NE(swaps.front().epoch, swaps.back().epoch);
  }
}

TEST_F(WallTest, DrawsSeveralTilesInOneProcess) {
  Child tiles = start_tiles(all(), "all.csv");
  Child master = start_master();
  await_swaps("all.csv", 200);
  expect_right({"all.csv"});
  std::map<std::string, std::size_t> swaps;
  for (const Swap& swap : swaps_in(path("all.csv"))) ++swaps[swap.tile];
  EXPECT_EQ(swaps.size(), 4u);
}

// Both see the same emulated person: who is heard shows in the log alone.
TEST_F(WallTest, FollowsTheTrackerElsewhereAndTheNextOneWhenItDies) {
  write("wall.toml", bytes_of(wall_file_) + kCameras);
  const auto start_tracker = [&](const char* strength) {
    return Child({VINDU_PROGRAM, "track", "--wall", wall_file_, "--publish", "--json", "--strength",
                  strength},
                 path("tracker.log"));
  };
  Child tile = start_tile("tile-0-0");
  Child strong = start_tracker("20"), weak = start_tracker("5");
  Child master = start_master({"--tracker-elsewhere"}, "track");
  const auto end_of_name = [](const Child& tracker) { return fmt::format("-{}\n", tracker.id()); };
  await_log("poses come from tracker-");
  await_log(end_of_name(strong));
  strong.send(SIGKILL);
  await_log(end_of_name(weak));
  await_swaps("tile-0-0.csv", 60);
  weak.send(SIGKILL);
  await_log("no tracker is heard any more");
  expect_right({"tile-0-0.csv"});
  std::set<std::string> eyes;
  for (const Swap& swap : swaps_in(path("tile-0-0.csv"))) eyes.insert(swap.eye_x_m);
  EXPECT_GT(eyes.size(), 30u);  // it moved
}

// The emulated person looks there again and again: who listens later hears the next time.
TEST_F(WallTest, TellsWhoListensWhatAHeadKeepsLookingAt) {
  write("wall.toml", bytes_of(wall_file_) + kCameras);
  Child listener({VINDU_PROGRAM, "events", "--wall", wall_file_, "--json"}, path("events.log"));
  Child tracker({VINDU_PROGRAM, "track", "--wall", wall_file_, "--publish", "--json", "--target",
                 "middle,0,0,0,0.5"},
                path("tracker.log"));
  const auto heard = [&] { return bytes_of(path("events.log")); };
  while (heard().find('\n') == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_THAT(heard(), AllOf(HasSubstr(R"("kind":"pick")"), HasSubstr(R"("text":"middle")"),
                             HasSubstr("/track")));
  listener.send(SIGINT);
  EXPECT_EQ(listener.end(), 0);
}

TEST_F(WallTest, TellsWhoListensWhatPeopleDoBeforeTheMastersOwnCameras) {
  write("wall.toml", bytes_of(wall_file_) + kCameras);
  Child listener({VINDU_PROGRAM, "events", "--wall", wall_file_}, path("events.log"));
  std::vector<std::string> more = {"--target", "middle,0,0,0,0.5"};
  for (int second = 1; second < 60; ++second)
    more.insert(more.end(), {"--press", "home@" + std::to_string(second)});
  Child tile = start_tile("tile-0-0");
  Child master = start_master(more, "track");
  const auto hears = [&](const std::string& what) {
    while (bytes_of(path("events.log")).find(what) == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  hears("/left  key Home pressed");
  hears("/left  key Home let go");
  hears("/track  pick of 0: middle");
}

TEST_F(WallTest, WritesALineForEachFrameWhosePartsAddUpThoughItIsKilled) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master({"--csv", path("frames.csv")});
  while (lines_of(bytes_of(path("frames.csv"))).size() < 120)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  master.send(SIGKILL);
  master.end();

  std::vector<std::string> lines = lines_of(bytes_of(path("frames.csv")));
  const std::vector<std::string> names = cells_of(lines.front());
  ASSERT_EQ(names[12], "display_ms");
  std::uint64_t before = 0;
  int shown = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i]);
    ASSERT_EQ(cells.size(), names.size()) << lines[i];
    ASSERT_EQ(std::stoull(cells[0]), before + 1);
    before = std::stoull(cells[0]);
    if (cells[2] == "0") continue;
    ++shown;
    double sum_ms = 0;
    for (std::size_t part = 5; part <= 12; ++part)
      sum_ms += cells[part].empty() ? 0 : std::stod(cells[part]);
    ASSERT_NEAR(sum_ms, std::stod(cells[13]), 1e-3) << lines[i];
    EXPECT_EQ(cells[5], "");  // no capture on a path
  }
  EXPECT_GT(shown, 50);
}

TEST_F(WallTest, ShowsItsFiguresWithoutHidingTheFramesNumber) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master({"--overlay"});
  for (const std::string& file : files()) await_swaps(file, 90);
  expect_right(files());
  const ProcessResult status = vindu({"status", "--json", "--wall", wall_file_});
  EXPECT_THAT(status.out, HasSubstr("\"skew_ms\": {\"p50\": "));
  EXPECT_THAT(status.out, ::testing::Not(HasSubstr("\"report\": null")));
  EXPECT_THAT(status.out, ::testing::Not(HasSubstr("\"triangles\": 0,")));
  EXPECT_EQ(vindu({"overlay", "off", "--wall", wall_file_}).exit_code, 0);
  for (const std::string& file : files()) await_swaps(file, 20);
  expect_right(files());
}

TEST_F(WallTest, TellsSystemdThatATileDrawsAndThatItStillDoes) {
  const std::string socket_file = path("notify");
  const int listener = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  ASSERT_LT(socket_file.size(), sizeof address.sun_path);
  std::ranges::copy(socket_file, address.sun_path);
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  setenv("NOTIFY_SOCKET", socket_file.c_str(), 1);
  Child tile = start_tile("tile-0-0");
  unsetenv("NOTIFY_SOCKET");
  std::vector<std::string> heard;
  while (heard.size() < 3) {
    std::array<char, 64> text{};
    const auto length = recv(listener, text.data(), text.size(), 0);
    ASSERT_GT(length, 0);
    heard.emplace_back(text.data(), static_cast<std::size_t>(length));
  }
  close(listener);
  EXPECT_THAT(heard, ::testing::Each("READY=1\nWATCHDOG=1"));
}

TEST_F(WallTest, SaysThatATileHasAnotherFileThanTheMaster) {
  const std::string model = path("mine.obj");
  std::filesystem::copy_file(small_model(), model);
  Child master({VINDU_PROGRAM, "master", model, "--wall", wall_file_, "--mode", "loop"},
               path("master.log"));
  Child first = start_tile("tile-0-0");
  await_log("tile-0-0: admitted");
  std::ofstream(model, std::ios::app) << "# changed\n";
  Child second = start_tile("tile-1-0");
  const auto said = [&] { return bytes_of(path("tile-1-0.csv.log")); };
  while (said().find("is not what the master has there") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_THAT(said(), HasSubstr("vindu deploy"));
}

TEST_F(WallTest, EndsWithAnErrorWhereTheMasterCannotReadItsFirstModel) {
  const ProcessResult result =
      vindu({"master", "no-such.glb", "--wall", wall_file_, "--mode", "loop"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no-such.glb"));
}

TEST_F(WallTest, SaysWhichTilesThereAreWhenOneIsNotOfTheWall) {
  const ProcessResult result = vindu({"tile", "tile-9-9", "--wall", wall_file_, "--headless"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("tile-9-9"));
  EXPECT_THAT(result.err, HasSubstr("tile-0-0 to tile-1-1"));
}

}  // namespace
}  // namespace vindu
