// Which host runs what, and the texts for systemd and Slurm.
#include "cluster/launch/host_plan.h"

#include <gmock/gmock.h>

#include "cluster/launch/hosts.h"
#include "core/error.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

Site site_of(const std::string& hosts) {
  WallGrid grid;
  grid.columns = 2;
  grid.rows = 2;
  grid.width_m = grid.height_m = 1;
  grid.tile_width_px = grid.tile_height_px = 100;
  grid.hosts = hosts;
  Site site;
  site.wall = expand_wall(grid, {}, {});
  site.cluster.master = "head";
  return site;
}

HostRequest request() {
  return {.model = "my \"model\" 100%.glb",
          .master_arguments = {"--mode", "loop"},
          .tile_arguments = {"--scale", "0.5"},
          .headless = false,
          .program_sha256 = std::string(64, 'a'),
          .wall_sha256 = std::string(64, 'b')};
}

TEST(HostPlans, NameEveryHostOnce) {
  const auto plans = host_plans(site_of("column-{x}"));
  ASSERT_THAT(names_of(plans), ElementsAre("head", "column-0", "column-1"));
  EXPECT_TRUE(plans[0].master);
  EXPECT_THAT(plans[0].tiles, SizeIs(0));
  EXPECT_THAT(plans[2].tiles, ElementsAre("tile-1-0", "tile-1-1"));
}

TEST(HostPlans, LetTheMastersHostHaveTilesToo) {
  Site site = site_of("tile-{x}-{y}");
  site.cluster.master = "tile-1-1";
  const auto plans = host_plans(site);
  ASSERT_THAT(plans, SizeIs(4));
  EXPECT_TRUE(plans[0].master);
  EXPECT_THAT(plans[0].tiles, ElementsAre("tile-1-1"));
}

TEST(HostPlans, RefuseWhatSshOrClushWouldTakeForSomethingElse) {
  for (const std::string host : {"-oProxyCommand=id", "@all", "a[0-3]", "a b", "a;b", "a,b", "",
                                 "a$(id)", "a/b", "root@a", "*"})
    EXPECT_THROW(host_plans(site_of(host)), Error) << host;
}

TEST(Units, OfTilesAreWatchedRestartedAndOfTheSession) {
  const std::string unit = tile_unit(request());
  EXPECT_THAT(unit, AllOf(HasSubstr("\nType=notify\n"), HasSubstr("\nRestart=on-failure\n"),
                          HasSubstr("\nRestartSec=200ms\n"), HasSubstr("\nWatchdogSec=10\n"),
                          HasSubstr("\nStartLimitBurst="),
                          HasSubstr("\nPartOf=graphical-session.target\n")));
  EXPECT_THAT(unit, HasSubstr("\nExecStart=%h/.vindu/bin/vindu tile $TILES --wall "
                              "%h/.vindu/wall.toml \"--scale\" \"0.5\"\n"));
  EXPECT_THAT(unit, HasSubstr("xset"));
}

TEST(Units, OfHeadlessTilesTouchNoScreen) {
  HostRequest headless = request();
  headless.headless = true;
  EXPECT_THAT(tile_unit(headless), AllOf(HasSubstr(" --headless"), Not(HasSubstr("xset"))));
}

TEST(Units, OfTheMasterNameTheModelThatWasDeployed) {
  EXPECT_THAT(master_unit(request()),
              HasSubstr("\nExecStart=%h/.vindu/bin/vindu master \"%h/.vindu/scene/my \\\"model\\\" "
                        "100%%.glb\" --wall %h/.vindu/wall.toml \"--mode\" \"loop\"\n"));
}

TEST(Scripts, AreGoodShell) {
  const auto plans = host_plans(site_of("tile-{x}-{y}"));
  for (const std::string& script :
       {start_script(plans, request()), stop_script(), restart_script(), log_script(5),
        doctor_script(plans, request()), slurm_script(plans, request()),
        kept_script(plans, "vindu-7-wall", "00-", 5)}) {
    const ProgramResult shell = run_program({"sh", "-n", "-c", script});
    EXPECT_EQ(shell.exit_code, 0) << script;
    EXPECT_THAT(shell.err, SizeIs(0));
  }
}

/// What the doctor's script prints on a host whose vindu ends so.
std::vector<std::string> doctor_that_ends_with(int code) {
  const std::string stand_ins = R"(home=$(mktemp -d); mkdir -p "$home/.vindu/bin"
stand_in() { printf '#!/bin/sh\n%s\n' "$2" > "$home/$1"; chmod +x "$home/$1"; }
stand_in uname 'echo tile-1-0'
stand_in systemctl 'echo DISPLAY=:7'
stand_in sha256sum 'cat > /dev/null'
stand_in .vindu/bin/vindu '[ "$1" = --version ] || { echo "on $DISPLAY"; exit )" +
                                std::to_string(code) + R"(; }'
export HOME="$home" PATH="$home:$PATH"
)";
  HostRequest checked = request();
  checked.model.clear();
  const auto plans = host_plans(site_of("tile-{x}-{y}"));
  return run_program({"sh", "-c", stand_ins + doctor_script(plans, checked)}).out;
}

TEST(Doctor, RunsOnTheScreenOfTheHostAndMayFindWhatIsBad) {
  EXPECT_THAT(doctor_that_ends_with(0), ::testing::ElementsAre("on :7", "@done"));
  EXPECT_THAT(doctor_that_ends_with(1), ::testing::ElementsAre("on :7", "@done"));
}

TEST(Doctor, ThatCrashesIsNotTakenForOneThatFoundNothing) {
  EXPECT_THAT(doctor_that_ends_with(139),
              ::testing::ElementsAre("on :7", HasSubstr("@fail\tdoctor\tit ended with 139")));
}

/// On a host named tile-1-0 whose runtime folder holds the picture, or does not.
std::vector<std::string> kept_where(const std::string& made) {
  const std::string stand_ins = R"(home=$(mktemp -d); mkdir "$home/it's a wall"
printf '#!/bin/sh\necho tile-1-0\n' > "$home/uname"; chmod +x "$home/uname"
export XDG_RUNTIME_DIR="$home" PATH="$home:$PATH"
)";
  const auto plans = host_plans(site_of("tile-{x}-{y}"));
  return run_program({"sh", "-c",
                      stand_ins + ": > \"$home/it's a wall/" + made + "\"\n" +
                          kept_script(plans, "it's a wall", "0042-", 0)})
      .out;
}

TEST(Kept, AreThePathsOfTheHostsOwnTiles) {
  EXPECT_THAT(
      kept_where("0042-tile-1-0.png"),
      ::testing::ElementsAre(::testing::EndsWith("/it's a wall/0042-tile-1-0.png"), "@done"));
  EXPECT_THAT(kept_where("0041-tile-1-0.png"), ::testing::ElementsAre("@done"));
}

TEST(Slurm, RunsOnEachHostWhatIsItsOwnWithTheArgumentsAsTheyAre) {
  HostRequest nasty = request();
  nasty.headless = true;
  nasty.tile_arguments = {"$(id)", "it's"};
  const std::string script = slurm_script(host_plans(site_of("tile-{x}-{y}")), nasty);
  // srun and vindu stand-ins: one runs the step here, the other prints its words.
  const std::string stand_ins = R"(home=$(mktemp -d); mkdir -p "$home/.vindu/bin"
printf '#!/bin/sh\nshift 3; exec "$@"\n' > "$home/srun"
printf '#!/bin/sh\nprintf "<%%s>" "$@"\n' > "$home/.vindu/bin/vindu"
chmod +x "$home/srun" "$home/.vindu/bin/vindu"
export HOME="$home" PATH="$home:$PATH" SLURMD_NODENAME=tile-1-0
)";
  const ProgramResult result = run_program({"sh", "-c", stand_ins + script});
  ASSERT_THAT(result.out, SizeIs(1)) << ::testing::PrintToString(result.err);
  EXPECT_THAT(result.out[0],
              AllOf(HasSubstr("<tile><tile-1-0><--wall>"), HasSubstr("<--headless><$(id)><it's>")));
}

}  // namespace
}  // namespace vindu
