// A wall of real processes on loopback: a master and tiles that draw. Which frame a tile showed is
// read from its pixels. Nothing here says how long anything may take.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "cluster/dds.h"
#include "renderer/frame_counter.h"
#include "renderer/image.h"
#include "tests/app/osc_bytes.h"
#include "tests/app/process.h"
#include "tests/wall/children.h"
#include "tests/wall/swaps.h"

namespace vindu {
namespace {

using namespace testing;
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

void send_datagram(int port, const Bytes& bytes) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int file = socket(AF_INET, SOCK_DGRAM, 0);
  sendto(file, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  close(file);
}

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

class WallTest : public AppTest {
 protected:
  WallTest()
      : wall_file_(write("wall.toml",
                         "[wall]\ncolumns = 2\nrows = 2\nwidth_m = 2\nheight_m = 1.5\n"
                         "tile_width_px = 1024\ntile_height_px = 768\n"
                         "[cluster]\nname = \"test-" +
                             std::to_string(getpid()) + "\"\n")) {}

  Child start_tiles(const std::vector<std::string>& tiles, const std::string& shown) const {
    std::vector<std::string> words = {VINDU_PROGRAM, "tile",     "--headless", "--scale",  "0.1",
                                      "--wall",      wall_file_, "--shown",    path(shown)};
    words.insert(words.end(), tiles.begin(), tiles.end());
    return Child(words, path(shown + ".log"));
  }
  Child start_tile(const std::string& tile) const { return start_tiles({tile}, tile + ".csv"); }
  Child start_master(const std::vector<std::string>& more = {},
                     const std::string& mode = "loop") const {
    std::vector<std::string> words = {VINDU_PROGRAM, "master", small_model(), "--wall",  wall_file_,
                                      "--mode",      mode,     "--pattern",   "counter", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return Child(words, path("master.log"));
  }

  /// Until the file has so many swaps more.
  void await_swaps(const std::string& shown, std::size_t more) const {
    const std::size_t before = swaps_in(path(shown)).size();
    while (swaps_in(path(shown)).size() < before + more)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  void await_log(const std::string& text) const {
    while (bytes_of(path("master.log")).find(text) == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  /// Every swap showed, in its pixels, the frame that it said; frames come in order; all tiles had
  /// one eye in one frame.
  void expect_right(const std::vector<std::string>& files) const {
    std::vector<std::vector<Swap>> swaps;
    for (const std::string& file : files) swaps.push_back(swaps_in(path(file)));
    EXPECT_THAT(wrong_swaps(swaps), ::testing::IsEmpty());
  }

  static std::vector<std::string> all() { return {"tile-0-0", "tile-1-0", "tile-0-1", "tile-1-1"}; }
  static std::vector<std::string> files() {
    std::vector<std::string> files = all();
    for (std::string& file : files) file += ".csv";
    return files;
  }

  std::string wall_file_;
};

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
  await_log("poses come from a tracker elsewhere");
  strong.send(SIGKILL);
  await_swaps("tile-0-0.csv", 60);
  weak.send(SIGKILL);
  await_log("no tracker is heard any more");
  expect_right({"tile-0-0.csv"});
  std::set<std::string> eyes;
  for (const Swap& swap : swaps_in(path("tile-0-0.csv"))) eyes.insert(swap.eye_x_m);
  EXPECT_GT(eyes.size(), 30u);  // it moved
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

/// Of a picture that vindu render made, as --shown has it.
double mean_level_of(const std::string& file) {
  const Image image = read_png(file);
  double sum = 0;
  for (const Rgba8& pixel : image.pixels) sum += pixel[0] + pixel[1] + pixel[2];
  return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

// What the pixels are is compared with what vindu render draws.
TEST_F(WallTest, ShowsPatternsAndGoesBlankOnAllTilesInOneFrame) {
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master();
  for (const std::string& file : files()) await_swaps(file, 10);
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--wall", wall_file_});
    return vindu(words);
  };
  const auto await_level = [&](double level) {
    for (const std::string& file : files())
      while (std::abs(swaps_in(path(file)).back().mean_level - level) > 1e-4)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  ASSERT_EQ(ask({"render", "--pattern", "ramps", "--scale", "0.1", "--out", path("out")}).exit_code,
            0);
  const double ramps = mean_level_of(path("out/tile-0-0.png"));
  EXPECT_GT(ramps, 40);
  EXPECT_EQ(ask({"pattern", "ramps"}).exit_code, 0);
  await_level(ramps);
  EXPECT_EQ(ask({"overlay", "on"}).exit_code, 0);
  EXPECT_EQ(ask({"blank", "on"}).exit_code, 0);
  await_level(0);
  for (const std::string& file : files()) await_swaps(file, 10);  // the frames go on
  EXPECT_THAT(ask({"status"}).out, HasSubstr(", pattern ramps, blank"));
  EXPECT_EQ(ask({"overlay", "off"}).exit_code, 0);
  EXPECT_EQ(ask({"blank", "off"}).exit_code, 0);
  await_level(ramps);
  EXPECT_THAT(ask({"status", "--json"}).out, HasSubstr(R"("pattern": "ramps", "blank": false)"));
  EXPECT_EQ(ask({"stop"}).exit_code, 0);
  EXPECT_EQ(master.end(), 0);

  std::map<std::uint64_t, bool> black;  // by frame
  int dark = 0;
  for (const std::string& file : files())
    for (const Swap& swap : swaps_in(path(file))) {
      const bool is = swap.mean_level == 0;
      EXPECT_EQ(black.try_emplace(swap.frame, is).first->second, is)
          << swap.tile << " in frame " << swap.frame;
      dark += is;
    }
  EXPECT_GE(dark, 4 * 10);
}

/// What stands in the counters of a capture's tiles.
std::set<std::optional<std::uint64_t>> numbers_in(const std::string& folder,
                                                  const std::vector<std::string>& tiles) {
  std::set<std::optional<std::uint64_t>> numbers;
  for (const std::string& tile : tiles)
    numbers.insert(read_frame_counter(read_png(folder + "/" + tile + ".png")));
  return numbers;
}

TEST_F(WallTest, GivesPicturesOfOneFrameOfAllTilesAndNamesTheOneThatIsDead) {
  setenv("XDG_RUNTIME_DIR", path("").c_str(), 1);
  std::vector<Child> tiles;
  for (const std::string& tile : all()) tiles.push_back(start_tile(tile));
  Child master = start_master();
  for (const std::string& file : files()) await_swaps(file, 20);
  const auto capture = [&](const std::string& out, const std::string& timeout_s) {
    return testing::vindu(
        {"capture", "--wall", wall_file_, "--out", path(out), "--timeout", timeout_s});
  };
  const ProcessResult whole = capture("whole", "60");
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  const auto numbers = numbers_in(path("whole"), all());
  EXPECT_EQ(numbers.size(), 1u);
  EXPECT_TRUE(*numbers.begin());
  const Image wall = read_png(path("whole/wall.png")),
              tile = read_png(path("whole/tile-1-1.png"));  // the upper right one
  ASSERT_EQ(wall.width_px, 2 * tile.width_px);
  ASSERT_EQ(wall.height_px, 2 * tile.height_px);
  for (int y = 0; y < tile.height_px; ++y)
    for (int x = 0; x < tile.width_px; ++x) ASSERT_EQ(wall.at(tile.width_px + x, y), tile.at(x, y));
  EXPECT_EQ(read_png(path("whole/eye.png")).width_px, 1600);

  tiles[2].send(SIGKILL);
  tiles[2].end();
  const ProcessResult less = capture("less", "5");
  EXPECT_EQ(less.exit_code, 1);
  EXPECT_THAT(less.err, HasSubstr("tile-0-1"));
  EXPECT_THAT(files_in("less"), ::testing::ElementsAre("eye.png", "tile-0-0.png", "tile-1-0.png",
                                                       "tile-1-1.png", "wall.png"));
  EXPECT_EQ(numbers_in(path("less"), {"tile-0-0", "tile-1-0", "tile-1-1"}).size(), 1u);
  unsetenv("XDG_RUNTIME_DIR");
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
  EXPECT_THAT(heard, ::testing::ElementsAre("READY=1", "WATCHDOG=1", "WATCHDOG=1"));
}

TEST_F(WallTest, ShowsAnotherModelAndKeepsItWhereTheNextOneCannotBeRead) {
  Child tile = start_tile("tile-0-0"), other = start_tile("tile-1-1");
  Child master = start_master();
  await_swaps("tile-0-0.csv", 20);
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--wall", wall_file_});
    return vindu(words);
  };
  const std::string model = path("other.obj");
  std::filesystem::copy_file(small_model(), model);
  EXPECT_EQ(ask({"show", model}).exit_code, 0);
  const ProcessResult broken = ask({"show", write("broken.obj", "v 1\n")});
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.err, HasSubstr("broken.obj"));
  EXPECT_EQ(ask({"goto", "0,0,1"}).exit_code, 0);
  EXPECT_EQ(ask({"mode", "loop"}).exit_code, 0);
  await_swaps("tile-0-0.csv", 20);
  await_swaps("tile-1-1.csv", 20);
  EXPECT_EQ(ask({"stop"}).exit_code, 0);
  EXPECT_EQ(master.end(), 0);
  expect_right({"tile-0-0.csv", "tile-1-1.csv"});
}

TEST_F(WallTest, FollowsAHandThatATouchFrameReports) {
  const std::string port = std::to_string(20000 + getpid() % 20000);
  Child tile = start_tile("tile-0-0");
  Child master = start_master({}, "touch");
  Child touch({VINDU_PROGRAM, "touch", "--wall", wall_file_, "--port", port}, path("touch.log"));
  const auto eye_x_m = [&] {
    const std::vector<Swap> swaps = swaps_in(path("tile-0-0.csv"));
    return swaps.empty() ? 0.0 : std::stod(swaps.back().eye_x_m);
  };
  // Repeated, as senders do: the first ones come before the others know each other.
  for (int frame = 1; std::abs(eye_x_m() - 0.5) > 0.05; ++frame) {
    send_datagram(std::stoi(port),
                  bundle({source("frame"), alive({3}), set(3, frame % 2 ? 0.7f : 0.75f, 0.5f),
                          fseq(2 * frame)}));
    send_datagram(std::stoi(port),
                  bundle({source("frame"), alive({3}), set(3, 0.75f, 0.5f), fseq(2 * frame + 1)}));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  send_datagram(std::stoi(port), {1, 2, 3});
  touch.send(SIGINT);
  EXPECT_EQ(touch.end(), 0);
  EXPECT_THAT(bytes_of(path("touch.log")), HasSubstr("1 messages were no TUIO"));
  EXPECT_TRUE(master.runs());
  expect_right({"tile-0-0.csv"});
}

/// Hears the master as tiles do.
class Listener {
 public:
  explicit Listener(const std::string& wall_file)
      : transport_(dds_settings_of(read_site(wall_file).cluster)),
        bus_(transport_.join({{.role = Role::console,
                               .name = "listener-" + std::to_string(getpid()),
                               .host = "here",
                               .version = "test"},
                              {},
                              {Topic::frame}})) {}

  /// The first one that plays this clip.
  FrameState await_clip(int clip) {
    while (true) {
      bus_->wait({Topic::frame}, std::chrono::steady_clock::now() + std::chrono::milliseconds(100));
      const auto frame = bus_->take_newest<FrameMessage>();
      if (frame && frame->newest.clip == clip) return frame->newest;
    }
  }

 private:
  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
};

TEST_F(WallTest, PlaysTheClipThatItIsToldAndRefusesOneThatIsNotThere) {
  const std::string beast = "/usr/share/assimp/models/X/Testwuson.X";
  Child tile = start_tile("tile-0-0");
  Child master({VINDU_PROGRAM, "master", beast, "--clip", "Wuson_Walk", "--wall", wall_file_,
                "--mode", "loop", "--pattern", "counter"},
               path("master.log"));
  await_swaps("tile-0-0.csv", 5);
  Listener listener(wall_file_);
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--wall", wall_file_});
    return vindu(words);
  };
  const FrameState walk = listener.await_clip(1);
  EXPECT_EQ(ask({"clip", "Wuson_Run"}).exit_code, 0);
  const FrameState run = listener.await_clip(0);
  EXPECT_LT(run.animation_time_s, walk.animation_time_s) << "it begins anew";
  EXPECT_EQ(ask({"clip", "2"}).exit_code, 0);
  listener.await_clip(1);
  const ProcessResult unknown = ask({"clip", "fly"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("1 Wuson_Run, 2 Wuson_Walk"));
  EXPECT_EQ(ask({"show", beast, "--clip", "fly"}).exit_code, 1);
  EXPECT_EQ(ask({"show", beast, "--clip", "rest"}).exit_code, 0);
  listener.await_clip(-1);
  await_swaps("tile-0-0.csv", 5);
  EXPECT_EQ(ask({"stop"}).exit_code, 0);
  EXPECT_EQ(master.end(), 0);
  expect_right({"tile-0-0.csv"});
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
