// vindu launch, status, pattern, show, mode and stop together: a wall of real processes on this
// machine and its consoles.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <regex>

#include "tests/app/process.h"
#include "tests/wall/children.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class LaunchCommand : public AppTest {
 protected:
  LaunchCommand() {
    wall_ = write("wall.toml",
                  "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 1\nheight_m = 0.4\n"
                  "tile_width_px = 640\ntile_height_px = 480\n[cluster]\nname = \"" +
                      name_ + "\"\n");
  }
  ~LaunchCommand() override {
    if (launcher_ <= 0) return;
    kill(launcher_, SIGTERM);
    waitpid(launcher_, nullptr, 0);
  }

  /// `output`: a file for all that the launcher says.
  void launch(const char* output = nullptr) {
    std::vector<std::string> words = {VINDU_PROGRAM, "launch",  small_model(), "--wall", wall_,
                                      "--headless",  "--scale", "0.1",         "--mode", "loop"};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      if (output) posix_spawn_file_actions_addopen(&actions, stream, output, O_WRONLY, 0);
    ASSERT_EQ(
        posix_spawn(&launcher_, words[0].c_str(), &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  int launched_exit_code() {
    int status = 0;
    waitpid(std::exchange(launcher_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  ProcessResult ask(std::vector<std::string> words) const {
    words.insert(words.end(), {"--wall", wall_});
    return vindu(words);
  }
  void await_good() const {
    while (ask({"status"}).exit_code != 0) continue;
  }

  /// Of the wall's own processes: the first that runs `vindu COMMAND`; -1: there is none.
  pid_t process(const std::string& command) const {
    const std::string pattern = "^" + std::string(VINDU_PROGRAM) + " " + command + " .*" + wall_;
    const std::string found = run({"pgrep", "-f", pattern}).out;
    return found.empty() ? -1 : std::stoi(found);
  }

  std::string name_ = "launched-" + std::to_string(getpid());
  std::string wall_;
  pid_t launcher_ = -1;
};

TEST_F(LaunchCommand, LightsAWallThatConsolesSpeakTo) {
  launch();
  await_good();

  EXPECT_THAT(ask({"status"}).out, HasSubstr("tile-[0-1]-0  ready"));
  EXPECT_THAT(ask({"status", "--json"}).out,
              AllOf(HasSubstr("\"good\": true"), HasSubstr("\"tile\": \"tile-1-0\"")));
  EXPECT_THAT(ask({"doctor"}).out,
              HasSubstr("good  wall      the wall \"" + name_ + "\" runs: 2 ready"));
  EXPECT_EQ(ask({"pattern", "counter"}).exit_code, 0);
  EXPECT_THAT(ask({"pattern", "no-such"}).err, HasSubstr("no-such"));
  EXPECT_EQ(ask({"pattern", "none"}).exit_code, 0);
  EXPECT_EQ(ask({"blank", "perhaps"}).exit_code, 2);
  EXPECT_EQ(ask({"overlay", "on"}).exit_code, 0);
  EXPECT_EQ(ask({"overlay", "perhaps"}).exit_code, 2);
  EXPECT_THAT(ask({"show", path("no.glb")}).err, HasSubstr("no.glb"));
  EXPECT_THAT(ask({"launch"}).err, HasSubstr("a wall of this name runs on this machine"));
  EXPECT_EQ(ask({"stop"}).exit_code, 0);
  EXPECT_EQ(launched_exit_code(), 0);
  EXPECT_EQ(ask({"status"}).exit_code, 1);
}

TEST_F(LaunchCommand, GoesOnWhereTheDiskForItsLogIsFullAndHasEndedWhenStopReturns) {
  launch("/dev/full");
  await_good();
  EXPECT_EQ(ask({"pattern", "grid"}).exit_code, 0);
  EXPECT_EQ(ask({"stop"}).exit_code, 0);
  const ProcessResult again = ask({"launch", small_model(), "--headless", "--scale", "0.1",
                                   "--mode", "loop", "--seconds", "1"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(launched_exit_code(), 0);
}

TEST_F(LaunchCommand, GoesOnWithWhatItWasAskedForAfterItsMasterWasKilled) {
  launch();
  await_good();
  std::filesystem::copy_file(small_model(), path("mine.obj"));
  EXPECT_EQ(ask({"show", path("mine.obj")}).exit_code, 0);
  EXPECT_EQ(ask({"blank", "on"}).exit_code, 0);
  EXPECT_EQ(ask({"pattern", "counter"}).exit_code, 0);
  const pid_t first = process("master");
  ASSERT_GT(first, 0);
  kill(first, SIGKILL);
  while (process("master") == first || process("master") < 0) continue;
  await_good();

  EXPECT_THAT(ask({"status"}).out, HasSubstr("pattern counter, blank"));
  std::string said;
  do said = ask({"clip", "no-such"}).err;
  while (said.find("shows no model yet") != std::string::npos);
  EXPECT_THAT(said, HasSubstr("mine: has no clips"));

  EXPECT_EQ(ask({"stop"}).exit_code, 0);
  EXPECT_EQ(launched_exit_code(), 0);
  launch();
  await_good();
  EXPECT_THAT(ask({"status"}).out, Not(HasSubstr("pattern"))) << "another launch begins anew";
}

TEST_F(LaunchCommand, IsLeftAloneByASecondMasterAndByASecondProcessOfATile) {
  launch();
  await_good();
  const ProcessResult master = ask({"master", "--mode", "loop", "--seconds", "60"});
  EXPECT_EQ(master.exit_code, 3);
  EXPECT_THAT(master.err, AllOf(HasSubstr("another master of the wall"), HasSubstr("vindu stop")));
  EXPECT_EQ(ask({"status"}).exit_code, 0);

  const Child twin(
      {VINDU_PROGRAM, "tile", "tile-0-0", "--headless", "--scale", "0.1", "--wall", wall_},
      path("twin.log"));
  while (ask({"status"}).out.find("tile-0-0 runs twice") == std::string::npos) continue;
}

TEST_F(LaunchCommand, FailsWhereNoTileShowsAnything) {
  const ProcessResult result = ask({"launch", small_model(), "--headless", "--mode", "loop",
                                    "--seconds", "1", "--shown", "/proc/nowhere"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, ::testing::AnyOf(HasSubstr("no tile has shown anything"),
                                           HasSubstr("tile-1-0: ended with exit code 1 again")));
}

TEST_F(LaunchCommand, SaysWhichTilesHaveAnotherWallFile) {
  launch();
  await_good();
  const std::string wider = write(
      "wider.toml", std::regex_replace(bytes_of(wall_), std::regex("width_m = 1"), "width_m = 2"));
  EXPECT_THAT(vindu({"status", "--wall", wider}).out,
              HasSubstr("has another wall than the wall file here"));
  const pid_t own = process("tile");
  ASSERT_GT(own, 0);
  kill(own, SIGSTOP);
  const Child tile(
      {VINDU_PROGRAM, "tile", "tile-0-0", "--headless", "--scale", "0.1", "--wall", wider},
      path("other.log"));
  while (ask({"status"}).out.find("tile-0-0: the wall of another wall file") == std::string::npos)
    continue;
}

TEST_F(LaunchCommand, SaysWhatItWouldRun) {
  const ProcessResult result =
      ask({"launch", "a b.glb", "--dry-run", "--tiles-per-process", "2", "--pattern", "grid"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out,
              AllOf(ContainsRegex("vindu master --wall .* --pattern grid --session \\w+ 'a b.glb'"),
                    HasSubstr("vindu tile tile-0-0 tile-1-0 --wall " + wall_)));
}

TEST_F(LaunchCommand, FailsWithTheMaster) {
  const ProcessResult result = ask({"launch", path("no.glb"), "--headless", "--mode", "loop"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("no.glb"), HasSubstr("the wall is stopped")));
}

TEST_F(LaunchCommand, SaysWhatHostsWouldBeTold) {
  wall_ = write("hosts.toml",
                "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 1\nheight_m = 0.4\n"
                "tile_width_px = 640\ntile_height_px = 480\n"
                "[cluster]\nmaster = \"head\"\n");
  EXPECT_THAT(ask({"launch", "--dry-run"}).out,
              AllOf(HasSubstr("-w 'head,tile-[0-1]-0'"), HasSubstr("Restart=on-failure")));
  EXPECT_THAT(ask({"launch", "--dry-run", "--engine", "slurm"}).out, HasSubstr("srun --label"));
}

}  // namespace
}  // namespace vindu
