// The local launcher with processes that crash, end, and hang, and itself killed by all means.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace vindu {
namespace {

using ::testing::HasSubstr;

/// launch_peer, and a pipe that every process below it holds open as long as it lives.
class Launcher : public ::testing::Test {
 protected:
  ~Launcher() override {
    if (lines_) fclose(lines_);
    if (launcher_ > 0) {
      kill(launcher_, SIGKILL);
      waitpid(launcher_, nullptr, 0);
    }
  }

  void launch(std::vector<std::string> processes, const std::string& verb = "launch") {
    processes.insert(processes.begin(), {VINDU_LAUNCH_PEER, verb});
    std::vector<char*> words;
    for (std::string& word : processes) words.push_back(word.data());
    words.push_back(nullptr);
    int out[2], alive[2];
    ASSERT_EQ(pipe2(out, O_CLOEXEC), 0);
    ASSERT_EQ(pipe2(alive, O_CLOEXEC), 0);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, alive[1], 9);  // inherited by all below
    ASSERT_EQ(posix_spawn(&launcher_, words[0], &actions, nullptr, words.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    close(out[1]);
    close(alive[1]);
    alive_ = alive[0];
    lines_ = fdopen(out[0], "r");
  }

  /// A line that holds this, each once; processes print in any order.
  std::string await_line(const std::string& part) {
    const auto holds = [&](const std::string& line) {
      return line.find(part) != std::string::npos;
    };
    char line[8192];
    while (std::ranges::none_of(printed_, holds) && fgets(line, sizeof line, lines_))
      printed_.emplace_back(line);
    const auto found = std::ranges::find_if(printed_, holds);
    if (found == printed_.end()) {
      ADD_FAILURE() << "the launcher ended without: " << part;
      return "";
    }
    std::string text = *found;
    printed_.erase(found);
    return text;
  }

  pid_t await_pid(const std::string& name) {
    const std::string line = await_line(name + ": pid ");
    return line.empty() ? -1 : std::stoi(line.substr(line.rfind(' ')));
  }

  /// Returns when the last of all processes below has died.
  void await_nothing_left() {
    char byte = 0;
    EXPECT_EQ(read(alive_, &byte, 1), 0);
    close(alive_);
  }

  int exit_code() {
    int status = 0;
    waitpid(std::exchange(launcher_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  pid_t launcher_ = -1;

 private:
  FILE* lines_ = nullptr;
  std::vector<std::string> printed_;
  int alive_ = -1;
};

class LauncherEnds : public Launcher, public ::testing::WithParamInterface<int> {};

TEST_P(LauncherEnds, AndNothingIsLeft) {
  launch({"master=stay", "tile-0-0=stay", "tile-1-0=stubborn"});
  await_pid("tile-0-0");
  await_pid("tile-1-0");

  kill(launcher_, GetParam());

  await_nothing_left();
}

TEST_P(LauncherEnds, AndNothingIsLeftWhenItIsTheInnerOne) {
  launch({"master=stay", "tile-0-0=stay", "tile-1-0=stubborn"});
  const pid_t inner = await_pid("launcher");
  await_pid("tile-1-0");

  kill(inner, GetParam());

  await_nothing_left();
}

INSTANTIATE_TEST_SUITE_P(By, LauncherEnds,
                         ::testing::Values(SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGSEGV));

TEST_F(Launcher, EndsWellWhenItIsTold) {
  launch({"master=stay", "tile-0-0=stay"});
  await_pid("tile-0-0");

  kill(launcher_, SIGINT);

  await_line("launcher: good, 0 restarts");
  EXPECT_EQ(exit_code(), 0);
}

TEST_F(Launcher, StartsAKilledTileAgainAndEndsWhatItHadStarted) {
  launch({"master=stay", "tile-0-0=stay"});
  const pid_t first = await_pid("tile-0-0");

  kill(first, SIGKILL);

  EXPECT_THAT(await_line("tile-0-0: was killed"), HasSubstr("starts again"));
  EXPECT_NE(await_pid("tile-0-0"), first);
  kill(launcher_, SIGTERM);
  await_line("1 restarts");
  await_nothing_left();
}

TEST_F(Launcher, StartsACrashedMasterAgain) {
  launch({"master=stay", "tile-0-0=stay"});
  const pid_t first = await_pid("result");

  kill(first, SIGABRT);

  await_line("master: was killed (Aborted); it starts again");
  EXPECT_NE(await_pid("result"), first);
}

TEST_F(Launcher, StartsAgainWhoSaysNoMoreThatItLives) {
  launch({"master=live", "tile-0-0=stay", "tile-1-0=hang"});
  await_pid("result");
  await_pid("tile-0-0");
  const pid_t first = await_pid("tile-1-0");

  EXPECT_THAT(await_line("tile-1-0: hangs"), HasSubstr("it is ended"));

  EXPECT_NE(await_pid("tile-1-0"), first);
  kill(launcher_, SIGTERM);
  await_line("launcher: good");
  await_nothing_left();
}

TEST_F(Launcher, EndsWhoNeverSaysThatItLives) {
  launch({"master=live", "tile-0-0=stay"}, "launch-impatiently");
  await_line("tile-0-0: hangs");
  await_line("tile-0-0: was killed (Killed); it starts again");
}

TEST_F(Launcher, GivesUpATileThatAlwaysCrashesAndKeepsTheOthers) {
  launch({"master=stay", "tile-0-0=crash", "tile-1-0=stay"});

  await_line("tile-0-0: was killed (Aborted) again and again; given up");

  kill(launcher_, SIGTERM);
  await_line("launcher: good, 4 restarts");
  EXPECT_EQ(exit_code(), 0);
}

TEST_F(Launcher, NeverStartsAgainWhatWasCalledWrong) {
  launch({"master=stay", "tile-0-0=wrong", "tile-1-0=stay"});

  await_line("tile-0-0: ended with exit code 2; given up");

  kill(launcher_, SIGTERM);
  await_line("launcher: good, 0 restarts");
}

TEST_F(Launcher, EndsWithTheMaster) {
  launch({"master=end", "tile-0-0=stay"});
  await_line("launcher: good");
  EXPECT_EQ(exit_code(), 0);
}

TEST_F(Launcher, FailsWithTheMaster) {
  launch({"master=fail", "tile-0-0=stay"});
  await_line("master: ended with exit code 1; the wall is stopped");
  EXPECT_EQ(exit_code(), 1);
}

TEST_F(Launcher, FailsWhenNoTileIsLeft) {
  launch({"master=stay", "tile-0-0=wrong"});
  EXPECT_EQ(exit_code(), 1);
}

}  // namespace
}  // namespace vindu
