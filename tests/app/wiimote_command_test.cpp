// vindu wiimote list, identify and watch on emulated devices: the real driver under the real
// program.
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::Each;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::SizeIs;

using WiimoteCommand = AppTest;

TEST_F(WiimoteCommand, ListsWhatThereIsWithBatteryAndState) {
  const ProcessResult result = vindu({"wiimote", "list", "--emulated"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_of(result.out), SizeIs(3));
  EXPECT_THAT(result.out, AllOf(HasSubstr("RVL-CNT-01"), ContainsRegex("1 .* 92 % .*ready"),
                                ContainsRegex("2 .* 92 % .*ready")));
}

TEST_F(WiimoteCommand, ListsAsLinesOfJson) {
  const ProcessResult result = vindu({"wiimote", "list", "--emulated", "--json"});
  EXPECT_THAT(lines_of(result.out), AllOf(SizeIs(2), Each(AllOf(HasSubstr(R"("battery":0.92)"),
                                                                HasSubstr(R"("state":"ready")")))));
}

TEST_F(WiimoteCommand, ListsNothingWhereThereIsNothingAndSaysWhatToDo) {
  const ProcessResult result = vindu({"wiimote", "list"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AnyOf(HasSubstr("vindu wiimote pair"), HasSubstr("057e")));
}

TEST_F(WiimoteCommand, IdentifiesOneByNumberOrAddress) {
  for (const char* which : {"2", "00:1F:C5:00:00:01"}) {
    const ProcessResult result =
        vindu({"wiimote", "identify", which, "--emulated", "--seconds", "0.3"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("00:1f:c5:00:00:01"));
  }
}

TEST_F(WiimoteCommand, SaysThatThereIsNoSuchWiimote) {
  for (const char* which : {"3", "0", "aa:bb"}) {
    const ProcessResult result = vindu({"wiimote", "identify", which, "--emulated"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, AllOf(HasSubstr(which), HasSubstr("vindu wiimote list")));
  }
}

TEST_F(WiimoteCommand, WatchesALineOfJsonAReport) {
  const ProcessResult result =
      vindu({"wiimote", "watch", "--emulated", "--json", "--seconds", "1.5"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_of(result.out), SizeIs(Gt(50u)));
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr(R"({"device":1,"sequence":)"), HasSubstr(R"({"device":2,"sequence":)"),
            ContainsRegex(R"("slots":\[\{"x":[0-9]+,"y":[0-9]+,"size":[1-9])"),
            HasSubstr(R"("buttons":[])"), HasSubstr(R"("acceleration_raw":[)")));
}

TEST_F(WiimoteCommand, WatchesOneByTheNumberThatTheListGivesIt) {
  const ProcessResult result =
      vindu({"wiimote", "watch", "2", "--emulated", "--json", "--seconds", "1.5"});
  EXPECT_THAT(lines_of(result.out), AllOf(SizeIs(Gt(20u)), Each(HasSubstr(R"({"device":2,"s)"))));
}

TEST_F(WiimoteCommand, SaysInTheHelpOfEachHowItIsCalledAndWhatIsUsual) {
  const std::map<std::string, std::string> usual = {{"list", "vindu wiimote list --json"},
                                                    {"identify", "default: 3"},
                                                    {"watch", "default: wii-4"}};
  for (const auto& [command, word] : usual) {
    const ProcessResult result = vindu({"wiimote", command, "--help"});
    EXPECT_THAT(result.out,
                AllOf(HasSubstr(word), HasSubstr("Examples:\n  vindu wiimote " + command)))
        << command;
  }
}

TEST_F(WiimoteCommand, TellsAsJsonAtTheEndWhatEachStreamWasLike) {
  const ProcessResult result =
      vindu({"wiimote", "watch", "--emulated", "--kernel", "--json", "--seconds", "1.5"});
  for (const std::string device : {"1", "2"})
    EXPECT_THAT(result.out, ContainsRegex(R"(\{"device":)" + device +
                                          R"(,"samples":[0-9]+,"starts":[0-9]+,"repeated":[0-9]+,)"
                                          R"("refused":[0-9]+,"lone":[0-9]+,)"
                                          R"("dropped":[0-9]+,"gaps":\{.*\},"trouble":")"));
}

TEST_F(WiimoteCommand, WatchesOneAloneInEachFormatAsText) {
  for (const char* format : {"basic", "extended", "full"}) {
    const ProcessResult result =
        vindu({"wiimote", "watch", "1", "--emulated", "--format", format, "--seconds", "2.2"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("reports/s"), HasSubstr("00:1f:c5:00:00:00"),
                                  ::testing::Not(HasSubstr("00:1f:c5:00:00:01"))));
  }
}

TEST_F(WiimoteCommand, WatchesEmulatedOnesBehindABadLinkBesideTheKernel) {
  const ProcessResult result = vindu({"wiimote", "watch", "1", "--emulated", "--link", "bad",
                                      "--kernel", "--json", "--seconds", "3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr(R"("slots":null)"));  // the kernel's own report
  EXPECT_THAT(result.out, HasSubstr(R"("slots":[{)"));
}

TEST_F(WiimoteCommand, EmulatesNothingUnlessItIsAskedTo) {
  EXPECT_EQ(vindu({"wiimote", "watch", "--link", "busy"}).exit_code, 2);
  EXPECT_EQ(vindu({"wiimote", "watch", "--emulated", "--link", "awful"}).exit_code, 2);
}

TEST_F(WiimoteCommand, NamesTheSensitivitiesThatThereAre) {
  const ProcessResult result = vindu({"wiimote", "watch", "--emulated", "--sensitivity", "wii-6"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("wii-6"), HasSubstr("wii-5"), HasSubstr("22 hexa")));
}

TEST_F(WiimoteCommand, ShowsTheDotsInAWindowWhereThereIsADisplay) {
  const VirtualDisplay display;
  const ProcessResult result =
      vindu({"wiimote", "watch", "--emulated", "--seconds", "1.5"}, display.environment());
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace vindu
