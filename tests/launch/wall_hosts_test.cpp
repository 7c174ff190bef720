// A wall over hosts that are network namespaces, each with its own sshd and systemd of the user.
// Needs root.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/launch/namespace_hosts.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

constexpr const char* kModel = "it's a \"model\" $HOME 100%.glb";  // as launch_peer has it

class WallHosts : public ::testing::Test {
 protected:
  WallHosts() {
    fs::create_directories(stage() / "bin");
    fs::create_directories(stage() / "scene");
    fs::copy_file(VINDU_LAUNCH_PEER, stage() / "bin/vindu");
    std::ofstream(stage() / "wall.toml") << "a wall\n";
    std::ofstream(stage() / "scene" / kModel) << "a model\n";
  }

  ProgramResult on_head(const std::vector<std::string>& words) { return hosts_.on_head(words); }
  /// The lines of who failed.
  std::vector<std::string> ask(const std::string& verb,
                               std::vector<std::string> names = {"head", "tile-0-0", "tile-1-0"}) {
    names.insert(names.begin(), {VINDU_LAUNCH_PEER, "hosts", verb, stage()});
    return on_head(names).out;
  }
  void log_in_at_screens() {
    for (const std::string tile : {"tile-0-0", "tile-1-0"})
      on_head({"ssh", tile, "systemctl --user set-environment DISPLAY=:7"});
  }

  fs::path stage() const { return hosts_.folder() / "stage"; }
  fs::path home(const std::string& host) const { return hosts_.home(host); }
  /// What the stand-in for vindu said, from its process id on.
  std::vector<std::string> said(const std::string& host, const std::string& role) const {
    std::vector<std::string> lines;
    std::ifstream stream(home(host) / ("said-" + role));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  std::string await_other(const std::string& host, const std::string& first) const {
    while (true) {
      const auto lines = said(host, "tile");
      if (!lines.empty() && lines[0] != first) return lines[0];
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  std::vector<std::string> arguments(const std::string& host, const std::string& role) const {
    auto lines = said(host, role);
    if (!lines.empty()) lines.erase(lines.begin());
    return lines;
  }

  testing::NamespaceHosts hosts_{{"head", "tile-0-0", "tile-1-0"}};
};

TEST_F(WallHosts, RunWhatTheyAreToldUntilTheyAreStopped) {
  if (!hosts_.made()) GTEST_SKIP() << "no namespaces or no systemd here";
  log_in_at_screens();
  ASSERT_THAT(ask("copy"), IsEmpty());

  ASSERT_THAT(ask("start"), IsEmpty());

  const std::string wall = "/root/.vindu/wall.toml";
  EXPECT_THAT(arguments("head", "master"),
              ElementsAre(std::string("/root/.vindu/scene/") + kModel, "--wall", wall, "--mode",
                          "%h $TILES `id` \\ 'x'; touch /root/hacked", "DISPLAY="));
  EXPECT_THAT(arguments("tile-1-0", "tile"),
              ElementsAre("tile-1-0", "--wall", wall, "$(touch /root/hacked)", "DISPLAY=:7"));
  const std::string first = said("tile-0-0", "tile")[0];
  kill(std::stoi(first), SIGKILL);
  const std::string second = await_other("tile-0-0", first);
  ASSERT_THAT(ask("restart", {"tile-0-0", "tile-1-0"}), IsEmpty());
  const std::string third = await_other("tile-0-0", second);
  ASSERT_THAT(ask("stop"), IsEmpty());
  EXPECT_NE(kill(std::stoi(third), 0), 0);
  for (const std::string host : {"head", "tile-0-0", "tile-1-0"})
    EXPECT_FALSE(fs::exists(home(host) / "hacked"));
}

TEST_F(WallHosts, ThatCannotSayWhyAndTheOthersGoOn) {
  if (!hosts_.made()) GTEST_SKIP() << "no namespaces or no systemd here";
  ask("copy");
  on_head({"ssh", "tile-0-0", "systemctl --user set-environment DISPLAY=:7"});

  EXPECT_THAT(ask("start"), ElementsAre(HasSubstr("tile-1-0: display: nobody is logged in")));

  EXPECT_THAT(said("head", "master"), ::testing::Not(IsEmpty()));
  EXPECT_THAT(said("tile-0-0", "tile"), ::testing::Not(IsEmpty()));
  std::ofstream(home("tile-0-0") / ".vindu/wall.toml") << "another wall\n";
  fs::remove(home("tile-1-0") / ".vindu/bin/vindu");
  EXPECT_THAT(ask("start"),
              ElementsAre("tile-0-0: files: its wall file is not this one; bring it: vindu deploy",
                          "tile-1-0: files: there is no vindu; bring it: vindu deploy"));
  EXPECT_THAT(ask("stop", {"head", "tile-0-0", "nowhere"}),
              ElementsAre(HasSubstr("nowhere: ssh: Could not resolve")));
}

TEST_F(WallHosts, AreDeployedToByTheProgramItself) {
  if (!hosts_.made()) GTEST_SKIP() << "no namespaces or no systemd here";
  fs::create_directories(stage() / "site/models");
  const std::string wall = stage() / "site/wall.toml";
  std::ofstream(wall) << "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 1\nheight_m = 0.4\n"
                         "tile_width_px = 64\ntile_height_px = 48\n"
                         "[cluster]\nmaster = \"head\"\n[scene]\nmodel = \"models/a.obj\"\n";
  std::ofstream(stage() / "site/models/a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(stage() / "site/models/a.mtl") << "newmtl a\n";
  const std::string model = stage() / "scene" / "it's $HOME.glb";
  std::ofstream(model) << "a model\n";

  const auto deployed = on_head({VINDU_PROGRAM, "deploy", model, "--wall", wall});

  EXPECT_THAT(deployed.out, ElementsAre("3 of 3 hosts have it"))
      << ::testing::PrintToString(deployed.err);
  const fs::path there = home("tile-1-0") / ".vindu";
  for (const std::string file : {"bin/vindu", "wall.toml", "models/a.obj", "models/a.mtl",
                                 "scene/it's $HOME.glb", "share/vindu/shaders"})
    EXPECT_TRUE(fs::exists(there / file)) << file;
#ifndef __SANITIZE_THREAD__  // it draws, with Mesa
  const auto examined = on_head({VINDU_PROGRAM, "doctor", "--wall", wall, "--hosts"});
  EXPECT_THAT(examined.out, Contains(AllOf(HasSubstr("head,tile-[0-1]-0: note  graphics"),
                                           HasSubstr("llvmpipe"))))
      << ::testing::PrintToString(examined.out) << ::testing::PrintToString(examined.err);
  EXPECT_THAT(examined.out, Contains("Nothing stands in the way on 3 of 3 hosts."));
#endif
  const auto stopped = on_head({VINDU_PROGRAM, "stop", "--wall", wall});
  EXPECT_THAT(stopped.out, ElementsAre("3 of 3 hosts stopped"));
  const auto restarted = on_head({VINDU_PROGRAM, "restart", "tile-1-0", "--wall", wall});
  EXPECT_THAT(restarted.out, ElementsAre("0 of 1 hosts restarted"));
  EXPECT_THAT(restarted.err,
              ElementsAre("tile-1-0: units: nothing was launched there; vindu launch"));
  EXPECT_EQ(restarted.exit_code, 1);
}

}  // namespace
}  // namespace vindu
