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

  void say(const std::string& tile, TileState state = TileState::ready,
           std::uint64_t incarnation = 1, const std::string& error = "") {
    view_.hear(StatusMessage{.tile = tile,
                             .incarnation = incarnation,
                             .state = state,
                             .presented = 100,
                             .frames_per_s = 59.9,
                             .error = error});
  }

  static Participant tile(const std::string& name) { return {.role = Role::tile, .name = name}; }

  WallView view_;
};

TEST_F(Views, OfAGoodWallAreOneLineOfTiles) {
  EXPECT_TRUE(view_.now().good());
  EXPECT_EQ(table_of(view_.now()),
            "master on head, no frame yet\n"
            "TILES             STATE  FRAME  FPS  LATE  RESTARTS  LAST ERROR\n"
            "tile-[0-6]-[0-3]  ready  100    60   0     0\n");
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

TEST_F(Views, SayWhichTilesWereNeverHeardOf) {
  const WallView fresh({"tile-0-0", "tile-0-1"}, kSelf);
  EXPECT_EQ(table_of(fresh.now()),
            "no master\n"
            "TILES         STATE    FRAME  FPS  LATE  RESTARTS  LAST ERROR\n"
            "tile-0-[0-1]  missing  -      -    -     -\n");
}

TEST_F(Views, CountFramesOfOneMasterAlone) {
  const Time start{std::chrono::seconds(100)};
  const auto frame = [](std::uint64_t epoch, std::uint64_t number) {
    return FrameMessage{.epoch = epoch, .newest = {.number = number}, .active_tiles = 28};
  };
  view_.hear(frame(7, 1000), start);
  view_.hear(frame(7, 1060), start + std::chrono::seconds(1));
  EXPECT_THAT(table_of(view_.now()), HasSubstr("frame 1060, 60.0 fps, 28 of 28 tiles"));

  view_.hear(frame(8, 1), start + std::chrono::seconds(2));
  view_.hear(frame(7, 1061), start + std::chrono::seconds(2));
  view_.hear(frame(8, 31), start + std::chrono::seconds(3));
  EXPECT_THAT(table_of(view_.now()), HasSubstr("frame 31, 30.0 fps"));
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
