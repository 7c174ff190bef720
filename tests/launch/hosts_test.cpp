// What clush says, read as what became of every host.
#include "cluster/launch/hosts.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Reports, TellWhoIsDoneWhoFailedAndWhoWasNotReached) {
  const ProgramResult clush{
      .exit_code = 255,
      .out = {"tile-0-0: some line", "tile-0-0: @done",
              "tile-1-0: @fail\tdisplay\tno screen\tbuy one"},
      .err = {"tile-2-0: ssh: connect to host tile-2-0 port 22: No route to host",
              "clush: tile-2-0: exited with exit code 255"}};

  const auto reports = reports_from({"tile-0-0", "tile-1-0", "tile-2-0", "tile-3-0"}, clush);

  ASSERT_THAT(reports, SizeIs(4));
  EXPECT_FALSE(reports[0].failure);
  EXPECT_THAT(reports[0].lines, ElementsAre("some line"));
  EXPECT_EQ(reports[1].failure, (HostFailure{"display", "no screen", "buy one"}));
  EXPECT_EQ(reports[2].failure->step, "ssh");
  EXPECT_THAT(reports[2].failure->reason, HasSubstr("No route to host"));
  EXPECT_THAT(reports[2].failure->remedy, HasSubstr("runs sshd"));
  EXPECT_EQ(reports[3].failure->reason, "the connection ended");
}

TEST(Reports, OfAHostThatSaysNothingMoreAreNoSuccess) {
  const ProgramResult clush{.exit_code = 0, .out = {"a: sh: systemctl: not found"}, .err = {}};
  EXPECT_TRUE(reports_from({"a"}, clush)[0].failure);
}

TEST(Reports, DoNotTakeOneHostsLinesForAnothers) {
  const ProgramResult clush{.exit_code = 0, .out = {"tile-1: @done"}, .err = {}};
  EXPECT_FALSE(reports_from({"tile-1"}, clush)[0].failure);
  EXPECT_TRUE(reports_from({"tile-10"}, clush)[0].failure);
  EXPECT_TRUE(reports_from({"tile"}, clush)[0].failure);
}

TEST(Failures, AreFoldedOverEqualHosts) {
  const HostFailure display{"display", "no screen", "buy one"};
  const std::vector<HostReport> reports = {{"tile-0-0", display},
                                           {"tile-1-0", display},
                                           {"tile-2-0", std::nullopt},
                                           {"tile-3-0", HostFailure{"start", "it dies", ""}}};
  EXPECT_EQ(failures_of(reports),
            "tile-[0-1]-0: display: no screen; buy one\n"
            "tile-3-0: start: it dies\n");
  EXPECT_THAT(failures_of({}), IsEmpty());
}

TEST(Failures, ThatDifferInTheHostsNameAloneAreFolded) {
  const auto unreachable = [](const std::string& host) {
    return HostReport{host,
                      HostFailure{"ssh", "connect to host " + host + " port 22: No route to host",
                                  "see that it is on: ssh HOST"}};
  };
  EXPECT_EQ(failures_of({unreachable("tile-0-0"), unreachable("tile-1-0")}),
            "tile-[0-1]-0: ssh: connect to host HOST port 22: No route to host; see that it is "
            "on: ssh HOST\n");
  EXPECT_THAT(failures_of({unreachable("tile-0-0")}), HasSubstr("host tile-0-0 port"));
  const HostReport short_name{"a", HostFailure{"ssh", "a-b: a bad key of a", ""}};
  const HostReport other{"b", HostFailure{"ssh", "a-b: b bad key of b", ""}};
  EXPECT_EQ(failures_of({short_name, other}), "a,b: ssh: a-b: HOST bad key of HOST\n");
}

TEST(CommandLines, NameHostsFoldedAndAskNothing) {
  const auto asked = clush_words({"tile-0-0", "tile-1-0"}, "echo @done");
  EXPECT_THAT(asked, ::testing::Contains("tile-[0-1]-0"));
  EXPECT_THAT(asked, ::testing::Contains(HasSubstr("BatchMode=yes")));
  const std::vector<std::string> words = rsync_words({"tile-0-0", {"/tmp/a b", "/tmp/own"}});
  EXPECT_THAT(std::vector(words.end() - 4, words.end()),
              ElementsAre("--", "/tmp/a b/", "/tmp/own/", "tile-0-0:.vindu/"));
  const HostPaths paths{"tile-0-0", {"/run/a b.png", "/run/c.png"}};
  const std::vector<std::string> back = rsync_words(paths, "/tmp/here");
  EXPECT_THAT(std::vector(back.end() - 4, back.end()),
              ElementsAre("--", "tile-0-0:/run/a b.png", "tile-0-0:/run/c.png", "/tmp/here/"));
  EXPECT_THAT(back, ::testing::Contains("--secluded-args"));
}

TEST(Programs, ThatAreNotThereSaySo) {
  const ProgramResult result = run_program({"/no/such/program"});
  EXPECT_EQ(result.exit_code, 127);
  EXPECT_THAT(result.err, ElementsAre("cannot start /no/such/program: No such file or directory"));
}

TEST(Programs, MayWriteMoreThanAPipeHoldsAndLinesOfAnyLength) {
  const ProgramResult result = run_program(
      {"sh", "-c", "head -c 1000000 /dev/zero | tr '\\0' x; echo; seq 100000; printf end"});
  std::size_t bytes = 0;
  for (const std::string& line : result.out) bytes += line.size();
  EXPECT_EQ(bytes, 1000000u + 488895u + 3u);
  EXPECT_EQ(result.out.back(), "end");
}

}  // namespace
}  // namespace vindu
