// What a console shows of a wall.
#include "cluster/wall_view.h"

#include <gmock/gmock.h>

#include "core/wall.h"

namespace vindu {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const Participant kSelf{.role = Role::console, .name = "c", .host = "here", .version = "1"};
const Participant kMaster{.role = Role::master, .name = "master", .host = "head", .version = "1"};

const Time kNow{std::chrono::seconds(50)};

class Views : public ::testing::Test {
 protected:
  Views() : view_(names(), kSelf) {
    view_.hear(Presence{PresenceChange::joined, kMaster});
    for (const std::string& name : names()) say(name);
  }

  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 7; ++column) names.push_back(tile_name(column, row));
    return names;
  }

  void say(const std::string& tile, TileState state = TileState::ready, std::uint32_t process = 1,
           const std::string& error = "") {
    view_.hear(StatusMessage{.tile = tile,
                             .host = "node",
                             .incarnation = process,
                             .state = state,
                             .presented = 100,
                             .frames_per_s = 59.9,
                             .error = error,
                             .process = process},
               kNow);
  }

  static Participant tile(const std::string& name) { return {.role = Role::tile, .name = name}; }

  WallView view_;
};

TEST_F(Views, OfAGoodWallAreOneLineOfTiles) {
  EXPECT_TRUE(view_.now().good());
  EXPECT_EQ(table_of(view_.now()),
            "master on head, no frame yet\n"
            "TILES             STATE  FRAME  FPS  GPU ms  SKEW ms  LATE  RESTARTS  LAST ERROR\n"
            "tile-[0-6]-[0-3]  ready  100    60   -       -        0     0\n");
}

TEST_F(Views, SayThatAPatternIsShownOrThatTheWallIsBlank) {
  FrameMessage frame{.epoch = 1, .newest = {.number = 7}};
  view_.hear(frame, Time{});
  EXPECT_THAT(table_of(view_.now()), Not(HasSubstr("pattern")));
  EXPECT_THAT(table_of(view_.now()), Not(HasSubstr("blank")));

  frame.newest = {.number = 8, .pattern = Pattern::seams, .blank = true};
  view_.hear(frame, Time{});
  EXPECT_THAT(table_of(view_.now()), HasSubstr("in the frame lock, pattern seams, blank\n"));

  frame.newest = {.number = 9, .touch_page = TouchPage{}};
  view_.hear(frame, Time{});
  EXPECT_THAT(table_of(view_.now()), HasSubstr("in the frame lock, points to be touched\n"));
}

TEST_F(Views, NameWhatIsNotReadyFirst) {
  say("tile-3-1", TileState::failed, 1, "no such model");
  view_.hear(Presence{PresenceChange::silent, tile("tile-0-0")});
  view_.hear(Presence{PresenceChange::left, tile("tile-6-3")});

  EXPECT_FALSE(view_.now().good());
  const std::string table = table_of(view_.now());
  EXPECT_THAT(table, HasSubstr("\ntile-3-1 "));
  EXPECT_THAT(table, HasSubstr(" no such model\n"));
  EXPECT_THAT(table, HasSubstr("\ntile-0-0 "));
  EXPECT_LT(table.find("gone"), table.find("ready"));
  EXPECT_THAT(summary_of(view_.now()), "1 failed, 1 gone, 25 ready, 1 silent, 0.0 fps");
}

TEST_F(Views, ShowATileThatComesBackAsRestarted) {
  view_.hear(Presence{PresenceChange::left, tile("tile-6-3")});
  say("tile-6-3", TileState::loading, 2);

  EXPECT_THAT(table_of(view_.now()), ContainsRegex("tile-6-3 +loading"));
  EXPECT_EQ(view_.now().tiles.back().restarts, 1);
}

TEST_F(Views, ShowATileAsEvictedFromTheMastersWordUntilItIsTakenInAgain) {
  ReportMessage report{.tile = "tile-6-3", .epoch = 1, .locked = 0, .evictions = 1};
  view_.hear(report);
  say("tile-6-3");
  EXPECT_THAT(table_of(view_.now()), ContainsRegex("tile-6-3 +evicted"));
  EXPECT_FALSE(view_.now().good());

  report.locked = 1;
  view_.hear(report);
  EXPECT_TRUE(view_.now().good());
}

TEST_F(Views, SayWhichTilesWereNeverHeardOf) {
  const WallView fresh({"tile-0-0", "tile-0-1"}, kSelf);
  EXPECT_EQ(table_of(fresh.now()),
            "no master\n"
            "TILES         STATE    FRAME  FPS  GPU ms  SKEW ms  LATE  RESTARTS  LAST ERROR\n"
            "tile-0-[0-1]  missing  -      -    -       -        -     -\n");
}

TEST_F(Views, CountFramesOfOneMasterAlone) {
  const Time start{std::chrono::seconds(100)};
  const auto frame = [](std::uint64_t epoch, std::uint64_t number) {
    FrameMessage message{.epoch = epoch, .newest = {.number = number}, .active_tiles = 28};
    message.newest.eye_in_wall.x() = 1e-3 * static_cast<double>(number);
    return message;
  };
  view_.hear(frame(7, 1000), start);
  view_.hear(frame(7, 1060), start + std::chrono::seconds(1));
  EXPECT_THAT(table_of(view_.now()), HasSubstr("frame 1060, 60.0 fps, 28 of 28 tiles"));

  view_.hear(frame(8, 1), start + std::chrono::seconds(2));
  view_.hear(frame(7, 1061), start + std::chrono::seconds(2));
  view_.hear(frame(8, 31), start + std::chrono::seconds(3));
  EXPECT_THAT(table_of(view_.now()), HasSubstr("frame 31, 30.0 fps"));
}

TEST_F(Views, SayThatNothingChangesWhereFramesLookAlike) {
  const Time start{std::chrono::seconds(100)};
  FrameMessage message{.epoch = 7, .newest = {.number = 1}};
  for (int half_s = 0; half_s < 4; ++half_s, ++message.newest.number)
    view_.hear(message, start + half_s * std::chrono::milliseconds(500));
  EXPECT_THAT(table_of(view_.now()), HasSubstr("2.0 fps since nothing changes"));
  message.newest.eye_in_wall.x() += 0.1;
  view_.hear(message, start + std::chrono::seconds(2));
  EXPECT_THAT(table_of(view_.now()), Not(HasSubstr("since nothing changes")));
}

TEST_F(Views, AMasterThatLeavesIsMissedUnlessAnotherCame) {
  view_.hear(Presence{PresenceChange::left, kMaster});
  EXPECT_FALSE(view_.now().master);
  Participant next = kMaster;
  next.host = "reserve";
  view_.hear(Presence{PresenceChange::joined, next});
  view_.hear(Presence{PresenceChange::left, kMaster});
  EXPECT_EQ(view_.now().master, next);
}

ReportMessage report_of(const std::string& tile, double skew_ms, std::uint32_t restarts = 0) {
  ReportMessage report{.tile = tile, .epoch = 7, .restarts = restarts};
  report.frames = {.frames = 300,
                   .frames_per_s = 60,
                   .mean_ms = {8, 0.5, 0.25, 0, 6, 3, 0.25, 16},
                   .tracked = true,
                   .motion_to_photon_ms = {34, 40.25, 51},
                   .skew_ms = {skew_ms / 2, skew_ms, 2 * skew_ms}};
  report.level = TrackingLevel::six_dof;
  return report;
}

TEST_F(Views, ShowSkewAndTheSumOfMotionToPhotonAsTheMasterSays) {
  const WallView& view = view_;
  view_.hear(FrameMessage{.epoch = 7, .newest = {.number = 100}, .active_tiles = 28}, Time{});
  view_.hear(report_of("", 0.4));
  EXPECT_THAT(
      table_of(view.now()),
      HasSubstr("28 of 28 tiles in the frame lock, eye six-dof\n"
                "                        p50     p99     max\n"
                "  skew of swaps        0.20    0.40    0.80 ms\n"
                "  motion to photon     34.0    40.2    51.0 ms\n"
                "  mean of parts: capture age 8.0, solve 0.5, publish 0.2, pick-up 0.0, draw 6.0, "
                "barrier 3.0, swap 0.2, display 16.0 ms\n"));
}

TEST_F(Views, FoldTilesWithTheLeastAndTheLargestOfTheirFigures) {
  view_.hear(report_of("tile-0-0", 0.1));
  view_.hear(report_of("tile-3-2", 0.5, 2));
  view_.hear(StatusMessage{.tile = "tile-5-1",
                           .incarnation = 1,
                           .state = TileState::ready,
                           .presented = 100,
                           .frames_per_s = 60,
                           .draw = {.gpu_ms = 4.25}},
             kNow);
  EXPECT_THAT(table_of(view_.now()),
              ContainsRegex("tile-\\[0-6\\]-\\[0-3\\] +ready +100 +60 +4.2 +0.10-0.50 +0 +0-2\n"));
}

TEST_F(Views, BelieveNoMasterThatWasReplaced) {
  view_.hear(FrameMessage{.epoch = 8, .newest = {.number = 1}}, Time{});
  view_.hear(report_of("", 0.4));
  EXPECT_FALSE(view_.now().report);
}

TEST_F(Views, NameATileThatRunsTwiceAndFollowTheNewerProcess) {
  for (int turn = 0; turn < 3; ++turn) {
    say("tile-3-1", TileState::loading, 2);
    say("tile-3-1");
  }
  EXPECT_THAT(table_of(view_.now()),
              AllOf(ContainsRegex("tile-3-1 +loading"),
                    HasSubstr("tile-3-1 runs twice, as process 1 on node and 2 on node")));
  EXPECT_EQ(view_.now().tiles[10].restarts, 1);
  say("tile-3-1", TileState::ready, 2);
  EXPECT_FALSE(view_.now().good());
}

TEST_F(Views, NameTheTrackerThatIsHeard) {
  for (const char* name : {"tracker-a-1", "tracker-b-2"})
    view_.hear(Presence{PresenceChange::joined, {.role = Role::tracker, .name = name}});
  EXPECT_THAT(table_of(view_.now()), HasSubstr("tracker-a-1 is there\ntracker-b-2 is there"));
  ReportMessage report = report_of("", 0.4);
  report.tracker = "tracker-b-2";
  view_.hear(report);
  EXPECT_THAT(table_of(view_.now()),
              AllOf(HasSubstr("tracker-a-1 is in reserve"), HasSubstr("tracker-b-2 is heard")));
}

TEST_F(Views, OfAMasterWithALargerWallDoNotSayThreeOfTwo) {
  view_.hear(FrameMessage{.epoch = 1, .newest = {.number = 7}, .active_tiles = 29}, kNow);
  EXPECT_THAT(table_of(view_.now()), HasSubstr(", 29 tiles in the frame lock"));
}

TEST_F(Views, SayWhereToLookForWhatIsMissing) {
  WallView view({"tile-0-0", "tile-1-0"}, kSelf);
  EXPECT_THAT(table_of(view.now()), Not(HasSubstr("vindu logs"))) << "nobody is there at all";
  view.hear(Presence{PresenceChange::joined, kMaster});
  EXPECT_THAT(table_of(view.now()), HasSubstr("tile-[0-1]-0: no word; see its lines"));
}

TEST_F(Views, TellOfOtherVersions) {
  Participant old = tile("tile-1-1");
  old.protocol = 0;
  view_.hear(Presence{PresenceChange::other_version, old});
  EXPECT_THAT(table_of(view_.now()), HasSubstr("speaks protocol 0"));
}

TEST_F(Views, TakeNoNoticeOfTilesOfAnotherWall) {
  say("tile-9-9");
  EXPECT_THAT(table_of(view_.now()), Not(HasSubstr("tile-9-9")));
}

}  // namespace
}  // namespace vindu
