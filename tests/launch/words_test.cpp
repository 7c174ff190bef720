// Nasty texts stay one word: a real shell says so. That systemd agrees is in wall_hosts_test.cpp.
#include "cluster/launch/words.h"

#include <gmock/gmock.h>

#include "cluster/launch/hosts.h"
#include "core/error.h"

namespace vindu {
namespace {

const std::vector<std::string> kNasty = {
    "",          "a b",
    "it's",      "'",
    "''",        "\"quoted\"",
    "$HOME",     "$(touch /tmp/hacked)",
    "`id`",      "; rm -rf ~",
    "a\nb",      "\n",
    "*",         "~",
    "-n",        "--help",
    "\\",        "a\\nb",
    "%h %i %%",  "#comment",
    "!history",  "&& true | cat > /dev/null",
    "Tromsø 壁", "\x01\x7f",
};

class NastyWords : public ::testing::TestWithParam<std::string> {};

TEST_P(NastyWords, ReachAProgramThroughAShellUnchanged) {
  const std::string script =
      "printf '%s' " + shell_word(GetParam()) + " | od -An -v -tx1 | tr -d ' \\n'";
  std::string bytes;
  for (const char letter : GetParam()) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned char>(letter));
    bytes += digits;
  }
  const auto expected = bytes.empty() ? std::vector<std::string>{} : std::vector{bytes};
  EXPECT_EQ(run_program({"sh", "-c", script}).out, expected);
  EXPECT_EQ(run_program({"sh", "-c", command_for_hosts(script)}).out, expected);
}

INSTANTIATE_TEST_SUITE_P(Shell, NastyWords, ::testing::ValuesIn(kNasty));

TEST(ShellWords, ArePlainWhereTheyCanBe) {
  EXPECT_EQ(shell_words({"vindu", "tile", "tile-0-0", "--wall", "/a/b.toml"}),
            "vindu tile tile-0-0 --wall /a/b.toml");
  EXPECT_EQ(shell_words({"echo", ""}), "echo ''");
  EXPECT_EQ(shell_words(kNasty).find('\0'), std::string::npos);
}

TEST(UnitWords, AreQuotedAsSystemdReadsThem) {
  EXPECT_EQ(unit_word("a \"b\" \\ $HOME 100%"), R"("a \"b\" \\ $$HOME 100%%")");
  EXPECT_EQ(unit_word("a\nExecStart=b"), R"("a\x0aExecStart=b")");
  EXPECT_EQ(unit_word("100%", "%h/"), R"("%h/100%%")");
}

TEST(Words, HoldNoZeroByte) {
  EXPECT_THROW(shell_word(std::string("a\0b", 3)), Error);
  EXPECT_THROW(unit_word(std::string("a\0b", 3)), Error);
}

TEST(CommandForHosts, HoldsNothingThatAnyShellOrClushCouldTakeForItsOwn) {
  const std::string command = command_for_hosts("echo %h '$x' \"`id`\"\n");
  EXPECT_EQ(command.find_first_of("%$`'\"\\\n;&<>*?~#!()"), std::string::npos) << command;
}

}  // namespace
}  // namespace vindu
