// The command line: help with examples, and exit codes 0 (done), 1 (it failed), 2 (called wrong).
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

using CommandLine = AppTest;

class Commands : public AppTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(Commands, ExplainThemselvesWithExamples) {
  const ProcessResult result = vindu({GetParam(), "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("Examples:\n  vindu " + GetParam()));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_P(Commands, AreNamedInTheProgramsHelp) {
  const ProcessResult result = vindu({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("\n  " + GetParam()));
}

/// Those that need no further word.
class CommandsAlone : public Commands {};

TEST_P(CommandsAlone, RefuseAnUnknownOption) {
  const ProcessResult result = vindu({GetParam(), "--no-such-option"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--no-such-option"));
  EXPECT_THAT(result.out, IsEmpty());
}

const auto name_of_command = [](const auto& tested) { return tested.param; };

INSTANTIATE_TEST_SUITE_P(CommandLine, CommandsAlone,
                         ::testing::Values("view", "render", "simulate", "check", "launch",
                                           "status", "stop"),
                         name_of_command);
INSTANTIATE_TEST_SUITE_P(CommandLine, Commands,
                         ::testing::Values("view", "render", "simulate", "check", "launch",
                                           "status", "show", "clip", "mode", "goto", "pattern",
                                           "overlay", "stop", "restart", "logs", "deploy"),
                         name_of_command);

TEST_F(CommandLine, TellsTheVersion) {
  const ProcessResult result = vindu({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_of(result.out), SizeIs(1));
}

TEST_F(CommandLine, RefusesAnUnknownCommand) {
  const ProcessResult result = vindu({"rendre"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("rendre"));
}

class WrongCalls : public AppTest,
                   public ::testing::WithParamInterface<std::vector<std::string>> {};

TEST_P(WrongCalls, EndWithTwoAndSayWhatIsWrong) {
  std::vector<std::string> words = GetParam();
  const std::string option = words[1];
  words.insert(words.end(), {"--out", path("out")});
  const ProcessResult result = vindu(words);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr(option));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, WrongCalls,
    ::testing::Values(std::vector<std::string>{"render", "--eye", "1,2"},
                      std::vector<std::string>{"render", "--eye", "1,2,3,4"},
                      std::vector<std::string>{"render", "--eye", "1,2,3m"},
                      std::vector<std::string>{"render", "--eye", "1,,3"},
                      std::vector<std::string>{"render", "--eye", "nan,0,2"},
                      std::vector<std::string>{"render", "--eye", "0,0,inf"},
                      std::vector<std::string>{"render", "--eye", ""},
                      std::vector<std::string>{"render", "--scale", "0"},
                      std::vector<std::string>{"render", "--scale", "-1"},
                      std::vector<std::string>{"render", "--scale", "half"},
                      std::vector<std::string>{"render", "--place", "here"},
                      std::vector<std::string>{"render", "--all", "--tile", "tile-0-0"},
                      std::vector<std::string>{"simulate", "--mode", "fly"},
                      std::vector<std::string>{"simulate", "--seconds", "0"},
                      std::vector<std::string>{"simulate", "--seconds", "nan"},
                      std::vector<std::string>{"simulate", "--noise-px", "inf"},
                      std::vector<std::string>{"simulate", "--clock", "broken"},
                      std::vector<std::string>{"view", "--mouse", "--track"},
                      std::vector<std::string>{"view", "--screen-mm", "500"},
                      std::vector<std::string>{"view", "--screen-mm", "500", "0"}));

class Failures : public AppTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(Failures, OfAModelThatIsNotThereAreOneLineWithARemedy) {
  const ProcessResult result = vindu({GetParam(), path("no.glb"), "--out", path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), SizeIs(1));
  EXPECT_THAT(result.err, AllOf(StartsWith("vindu: " + path("no.glb") + ":"), HasSubstr("; ")));
}

TEST_P(Failures, OfAWallFileThatIsNotThereAreOneLine) {
  const ProcessResult result = vindu({GetParam(), "--wall", path("no.toml"), "--out", path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), SizeIs(1));
  EXPECT_THAT(result.err, HasSubstr(path("no.toml")));
}

INSTANTIATE_TEST_SUITE_P(CommandLine, Failures, ::testing::Values("render", "simulate", "view"),
                         [](const auto& tested) { return tested.param; });

TEST_F(CommandLine, NamesTheConverterForAFileOfOpenSceneGraph) {
  for (const std::string name : {"model.osg", "model.ive"}) {
    const ProcessResult result = vindu({"render", write(name, "Group {}\n"), "--out", path("out")});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(lines_of(result.err), SizeIs(1));
    EXPECT_THAT(result.err, AllOf(HasSubstr(name), HasSubstr("osgconv")));
  }
}

TEST_F(CommandLine, RefusesWhatIsNotAModel) {
  const ProcessResult result =
      vindu({"render", write("words.txt", "no model\n"), "--out", path("out")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(lines_of(result.err), SizeIs(1));
  EXPECT_FALSE(std::filesystem::exists(path("out/wall.png")));
}

}  // namespace
}  // namespace vindu
