// What a running wall is asked for: another model, clip, pattern or mode, a dark wall, a picture.
#include <netinet/in.h>
#include <sys/socket.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "cluster/dds.h"
#include "renderer/frame_counter.h"
#include "renderer/image.h"
#include "tests/app/osc_bytes.h"
#include "tests/wall/wall_fixture.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::HasSubstr;

class AskedWall : public WallTest {};

void send_datagram(int port, const Bytes& bytes) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int file = socket(AF_INET, SOCK_DGRAM, 0);
  sendto(file, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  close(file);
}

/// Of a picture that vindu render made, as --shown has it.
double mean_level_of(const std::string& file) {
  const Image image = read_png(file);
  double sum = 0;
  for (const Rgba8& pixel : image.pixels) sum += pixel[0] + pixel[1] + pixel[2];
  return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

// What the pixels are is compared with what vindu render draws.
TEST_F(AskedWall, ShowsPatternsAndGoesBlankOnAllTilesInOneFrame) {
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

TEST_F(AskedWall, GivesPicturesOfOneFrameOfAllTilesAndNamesTheOneThatIsDead) {
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
  EXPECT_THAT(less.err, AllOf(HasSubstr("tile-0-1: no picture of frame"), HasSubstr(path(""))));
  EXPECT_THAT(files_in("less"), ::testing::ElementsAre("eye.png", "tile-0-0.png", "tile-1-0.png",
                                                       "tile-1-1.png", "wall.png"));
  EXPECT_EQ(numbers_in(path("less"), {"tile-0-0", "tile-1-0", "tile-1-1"}).size(), 1u);
  unsetenv("XDG_RUNTIME_DIR");
}

TEST_F(AskedWall, ShowsAnotherModelAndKeepsItWhereTheNextOneCannotBeRead) {
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

// Two tiles on one machine whose files differ: to the second, another one stands in the place.
TEST_F(AskedWall, TellsWhoAsksForAModelWhichTilesCannotShowIt) {
  if (std::system("unshare -rm true 2>/dev/null") != 0) GTEST_SKIP() << "no namespaces here";
  const std::string model = path("new.obj"), other = write("old.obj", "v 1 2 3\n");
  std::filesystem::copy_file(small_model(), model);
  Child good = start_tile("tile-0-0");
  Child bad(
      {"/usr/bin/unshare", "-rm", "sh", "-c", R"(mount --bind "$0" "$1" && shift && exec "$@")",
       other, model, VINDU_PROGRAM, "tile", "tile-1-1", "--headless", "--scale", "0.1", "--wall",
       wall_file_, "--shown", path("tile-1-1.csv")},
      path("tile-1-1.log"));
  Child master = start_master();
  await_swaps("tile-0-0.csv", 20);
  await_swaps("tile-1-1.csv", 20);
  const ProcessResult shown = vindu({"show", model, "--wall", wall_file_});
  EXPECT_EQ(shown.exit_code, 1);
  EXPECT_THAT(shown.err, HasSubstr("1 of 2 tiles show it; tile-1-1: " + model));
  EXPECT_EQ(vindu({"show", small_model(), "--wall", wall_file_}).exit_code, 0);
}

TEST_F(AskedWall, FollowsAHandThatATouchFrameReports) {
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

TEST_F(AskedWall, PlaysTheClipThatItIsToldAndRefusesOneThatIsNotThere) {
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

}  // namespace
}  // namespace vindu
