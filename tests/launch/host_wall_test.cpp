// A wall of real processes over hosts (network namespaces of this machine), as its admin runs it:
// vindu keys, deploy, launch, capture, status, stop; by systemd over ssh, and by Slurm. Which frame
// a tile showed is read from its pixels. VINDU_HOSTS=7x4 makes it that large (two tiles without).
// Needs root.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include "core/clock.h"
#include "renderer/frame_counter.h"
#include "renderer/image.h"
#include "tests/launch/namespace_hosts.h"
#include "tests/wall/children.h"
#include "tests/wall/whole_frames.h"

namespace vindu::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Ne;
using ::testing::SizeIs;
namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr Duration kPatience = std::chrono::seconds(240);  // slow is not dead
constexpr const char* kModel = "/usr/share/assimp/models/OBJ/box.obj";

struct Size {
  int columns = 2;
  int rows = 1;
};

Size wanted_size() {
  Size size;
  if (const char* const text = std::getenv("VINDU_HOSTS"))
    if (std::sscanf(text, "%dx%d", &size.columns, &size.rows) != 2)
      throw std::runtime_error("VINDU_HOSTS is columns x rows, like 7x4");
  return size;
}

std::vector<std::string> tile_names(Size size) {
  std::vector<std::string> names;
  for (int x = 0; x < size.columns; ++x)
    for (int y = 0; y < size.rows; ++y) names.push_back(fmt::format("tile-{}-{}", x, y));
  return names;
}

std::vector<std::string> and_head(std::vector<std::string> names) {
  names.insert(names.begin(), "head");
  return names;
}

class HostWall : public ::testing::Test {
 protected:
  explicit HostWall(bool slurm = false) : hosts_(and_head(tiles_), slurm), whole_(tiles_.size()) {
    fs::create_directories(hosts_.folder() / "site");
    std::ofstream(wall_file_) << fmt::format(
        "[wall]\ncolumns = {}\nrows = {}\nwidth_m = {}\nheight_m = {}\n"
        "tile_width_px = 1024\ntile_height_px = 768\n"
        "[cluster]\nname = \"hosts-{}\"\nmaster = \"head\"\nkeys = \"keys\"\n",
        size_.columns, size_.rows, 0.74 * size_.columns, 0.56 * size_.rows, getpid());
  }

  /// vindu WORDS --wall FILE on the head's network.
  std::vector<std::string> words(std::vector<std::string> of_command) const {
    of_command.insert(of_command.begin(), VINDU_PROGRAM);
    of_command.insert(of_command.end(), {"--wall", wall_file_});
    return hosts_.words_on_head(of_command);
  }
  ProgramResult ask(const std::vector<std::string>& of_command) const {
    return run_program(words(of_command));
  }
  void expect_done(const std::vector<std::string>& of_command) const {
    const ProgramResult result = ask(of_command);
    EXPECT_EQ(result.exit_code, 0) << of_command.front() << ::testing::PrintToString(result.out)
                                   << ::testing::PrintToString(result.err);
  }
  std::vector<std::string> launch_words() const {
    return {"launch", kModel,      "--headless", "--scale", "0.1",        "--mode",
            "loop",   "--pattern", "counter",    "--shown", "/root/shown"};
  }
  fs::path shown(const std::string& tile, int start) const {
    return hosts_.home(tile) / "shown" / fmt::format("{}-{}.csv", tile, start);
  }
  std::vector<pid_t> vindu_on(const std::string& host, const std::string& role) const {
    return hosts_.processes(host, ".vindu/bin/vindu " + role);
  }

  /// False where it does not come to be.
  template <typename Condition>
  bool await(Condition&& condition) const {
    for (const Time end = clock_.now() + kPatience; clock_.now() < end;) {
      if (condition()) return true;
      std::this_thread::sleep_for(milliseconds(20));
    }
    return false;
  }
  /// The first frame that all tiles showed after that time.
  std::optional<WholeFrame> await_whole(Time since) {
    std::optional<WholeFrame> found;
    await([&] {
      read();
      for (const WholeFrame& frame : whole_.in_order())
        if (!found && frame.first > since) found = frame;
      return found.has_value();
    });
    return found;
  }
  /// What tiles have written since.
  void read() {
    for (const std::string& tile : tiles_)
      for (int start = 1; fs::exists(shown(tile, start)); ++start) {
        const std::string file = shown(tile, start);
        auto& [reader, counted] = files_.try_emplace(file, SwapReader(file), 0).first->second;
        const std::vector<Swap>& swaps = reader.read();
        for (; counted < swaps.size(); ++counted) whole_.add(swaps[counted]);
      }
  }
  std::vector<std::string> wrong() {
    read();
    std::vector<std::vector<Swap>> all;
    for (auto& [file, read] : files_) all.push_back(read.first.read());
    for (const auto& swaps : all) swaps_ += swaps.size();
    return wrong_swaps(all);
  }

  bool runs_everywhere() const {
    return !vindu_on("head", "master").empty() &&
           std::ranges::all_of(tiles_, [&](const std::string& tile) {
             return !vindu_on(tile, "tile").empty() && fs::exists(shown(tile, 1));
           });
  }

  void make_and_deploy() {
    expect_done({"keys"});
    const ProgramResult deployed = ask({"deploy", kModel});
    EXPECT_THAT(deployed.out, Contains(fmt::format("{0} of {0} hosts have it", tiles_.size() + 1)))
        << ::testing::PrintToString(deployed.err);
  }
  /// Of one frame, by its number in the pixels, wherever the tiles' hosts are.
  void expect_pictures() const {
    const fs::path folder = hosts_.folder() / "pictures";
    expect_done({"capture", "--timeout", "60", "--out", folder});
    std::set<std::optional<std::uint64_t>> numbers;
    for (const std::string& tile : tiles_)
      numbers.insert(read_frame_counter(read_png(folder / (tile + ".png"))));
    EXPECT_THAT(numbers, ElementsAre(Ne(std::nullopt)));
    EXPECT_TRUE(fs::exists(folder / "wall.png") && fs::exists(folder / "eye.png"));
  }
  /// One tile's process dies; its host starts it again.
  void lose_a_tile() {
    const std::string& tile = tiles_.back();
    const std::vector<pid_t> before = vindu_on(tile, "tile");
    ASSERT_THAT(before, SizeIs(1));
    const Time killed = clock_.now();
    kill(before.front(), SIGKILL);
    ASSERT_TRUE(await([&] { return fs::exists(shown(tile, 2)); })) << "nobody starts it again";
    const auto whole = await_whole(time_of_first(shown(tile, 2)));
    ASSERT_TRUE(whole) << "it is not back in the lock";
    say("a killed tile: whole again after", whole->last - killed);
  }
  /// Of the first swap in a file.
  Time time_of_first(const fs::path& file) const {
    await([&] { return !swaps_in(file).empty(); });
    const auto swaps = swaps_in(file);
    return swaps.empty() ? Time::max() : Time(std::chrono::nanoseconds(swaps.front().time_ns - 1));
  }
  void expect_status_is_good() const {
    const ProgramResult status = ask({"status", "--timeout", "100"});
    EXPECT_EQ(status.exit_code, 0)
        << ::testing::PrintToString(status.out) << ::testing::PrintToString(status.err);
    EXPECT_THAT(
        status.out,
        Contains(HasSubstr(fmt::format("{0} of {0} tiles in the frame lock", tiles_.size()))));
  }
  void expect_right_frames() {
    const std::vector<std::string> found = wrong();
    EXPECT_THAT(found, IsEmpty());
    fmt::print("  {} hosts: {} swaps, wrong frames: {}\n", tiles_.size(), swaps_, found.size());
  }
  void expect_nothing_left() {
    EXPECT_TRUE(await([&] { return hosts_.processes(".vindu/bin/vindu").empty(); }));
    hosts_.take_down();
    EXPECT_THAT(hosts_.processes(""), IsEmpty());
  }
  static void say(const char* what, Duration after) {
    fmt::print("  {} {:.2f} s\n", what, seconds(after));
  }

  MonotonicClock clock_;
  Size size_ = wanted_size();
  std::vector<std::string> tiles_ = tile_names(size_);
  NamespaceHosts hosts_;
  std::string wall_file_ = hosts_.folder() / "site/wall.toml";
  WholeFrames whole_;
  std::map<std::string, std::pair<SwapReader, std::size_t>> files_;
  std::size_t swaps_ = 0;
};

TEST_F(HostWall, OfSystemdUnitsOutlivesItsLauncherAndTakesADeadTileIn) {
  if (!hosts_.made()) GTEST_SKIP() << "no namespaces or no systemd here";
  make_and_deploy();

  const Time began = clock_.now();
  Child launcher(words(launch_words()), hosts_.folder() / "launch.log");
  ASSERT_TRUE(await([&] { return runs_everywhere(); }));
  launcher.send(SIGKILL);
  launcher.end();

  const auto first = await_whole(clock_.now());
  ASSERT_TRUE(first) << "it is never whole";
  say("launch to the first whole frame", first->last - began);
  expect_pictures();
  lose_a_tile();
  expect_status_is_good();
  const ProgramResult stopped = ask({"stop"});
  EXPECT_THAT(stopped.out, Contains(fmt::format("{0} of {0} hosts stopped", tiles_.size() + 1)))
      << ::testing::PrintToString(stopped.err);
  expect_right_frames();
  expect_nothing_left();
}

class SlurmWall : public HostWall {
 protected:
  SlurmWall() : HostWall(true) {}
};

TEST_F(SlurmWall, OfOneJobTakesADeadTileInAndEndsWithIt) {
  if (!hosts_.made()) GTEST_SKIP() << "no namespaces or no Slurm here";
  make_and_deploy();
  auto launch = launch_words();
  launch.insert(launch.end(), {"--engine", "slurm"});

  const Time began = clock_.now();
  expect_done(launch);

  const auto first = await_whole(began);
  ASSERT_TRUE(first) << "it is never whole";
  say("launch to the first whole frame", first->last - began);
  expect_pictures();
  lose_a_tile();
  expect_status_is_good();
  expect_done({"stop", "--engine", "slurm"});
  expect_right_frames();
  expect_nothing_left();
}

}  // namespace
}  // namespace vindu::testing
