// The command line: help with examples, and exit codes 0 (done), 1 (it failed), 2 (called wrong).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

using CommandLine = AppTest;

using Command = std::vector<std::string>;

ProcessResult help_of(Command command) {
  command.emplace_back("--help");
  return vindu(command);
}

/// The commands that a help text lists, each with those below it.
std::vector<Command> commands_in(const std::string& help, const Command& parent = {}) {
  std::vector<Command> found;
  bool listed = false;
  for (const std::string& line : lines_of(help)) {
    if (line == "Subcommands:" || line.empty()) listed = !line.empty();
    if (!listed || !line.starts_with("  ") || line[2] == ' ') continue;
    Command command = parent;
    command.push_back(line.substr(2, line.find(' ', 2) - 2));
    found.push_back(command);
    std::ranges::move(commands_in(help_of(command).out, command), std::back_inserter(found));
  }
  return found;
}

TEST_F(CommandLine, ExplainsEachCommandWithExamplesOfItsOwn) {
  const std::vector<Command> commands = commands_in(help_of({}).out);
  ASSERT_THAT(commands, IsSupersetOf({Command{"simulate"}, Command{"calibrate", "wand"},
                                      Command{"measure", "accuracy"}, Command{"keys"}}));
  for (const Command& command : commands) {
    const std::string name = fmt::format("vindu {}", fmt::join(command, " "));
    const ProcessResult result = help_of(command);
    EXPECT_EQ(result.exit_code, 0) << name;
    EXPECT_THAT(result.out, ContainsRegex("\nUsage: " + name + " ")) << name;
    EXPECT_THAT(result.out, ContainsRegex("\nExamples?[^\n]*:\n(  [^\n]*\n)*  (sudo )?" + name))
        << name;
    EXPECT_THAT(result.err, IsEmpty()) << name;
  }
}

TEST_F(CommandLine, RefusesAnUnknownOptionOfEachCommand) {
  for (Command command : commands_in(help_of({}).out)) {
    command.emplace_back("--no-such-option");
    const ProcessResult result = vindu(command);
    EXPECT_EQ(result.exit_code, 2) << command.front();
    EXPECT_THAT(result.err, Not(IsEmpty())) << command.front();
    EXPECT_THAT(result.out, IsEmpty()) << command.front();
  }
}

TEST_F(CommandLine, NamesTheOptionThatItRefuses) {
  EXPECT_THAT(vindu({"check", "--no-such-option"}).err, HasSubstr("--no-such-option"));
}

TEST_F(CommandLine, TellsTheVersion) {
  const ProcessResult result = vindu({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_of(result.out), SizeIs(1));
}

TEST_F(CommandLine, RefusesAnUnknownCommand) {
  const ProcessResult result = vindu({"rendre"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("no command rendre; did you mean render?"));
}

TEST_F(CommandLine, RefusesToPredictWhereNothingIsTracked) {
  const ProcessResult result = vindu({"replay", "walk.vrec", "--predict-ms", "30"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--predict-ms requires --track"));
}

TEST_F(CommandLine, RefusesTargetsWhereNothingIsTracked) {
  const ProcessResult result =
      vindu({"replay", "walk.vrec", "--parts", "--target", "globe,0.5,0.2,-1,0.3"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--target requires --track"));
}

TEST_F(CommandLine, RefusesPressesAfterTheEnd) {
  for (const Command& command : {Command{"track"}, {"record"}, {"simulate"}, {"view", "--track"}}) {
    Command words = command;
    words.insert(words.end(), {"--seconds", "2", "--press", "home@1", "--press", "up@2.5"});
    const ProcessResult result = vindu(words);
    EXPECT_EQ(result.exit_code, 2) << command.front();
    EXPECT_THAT(result.err, HasSubstr("--press: up@2.5 comes after the end: --seconds 2"));
  }
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
