// What is wrong about who is on a wall's bus.
#include "cluster/roll.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Participant who(Role role, const std::string& name, const std::string& host,
                const std::string& wall = "a") {
  return {.role = role, .name = name, .host = host, .version = "1", .wall = wall};
}

class Rolls : public ::testing::Test {
 protected:
  void join(const Participant& participant) {
    console_.hear({PresenceChange::joined, participant});
    master_.hear({PresenceChange::joined, participant});
  }
  void leave(const Participant& participant) {
    console_.hear({PresenceChange::left, participant});
    master_.hear({PresenceChange::left, participant});
  }

  Roll console_{who(Role::console, "c", "desk")};
  Roll master_{who(Role::master, "master", "head")};
};

TEST_F(Rolls, OfAGoodWallHaveNothingToComplainOf) {
  join(who(Role::tile, "tile-0-0", "node0"));
  join(who(Role::tracker, "tracker-eye", "eye"));
  EXPECT_THAT(master_.complaints(), IsEmpty());
  join(who(Role::master, "master", "head"));
  EXPECT_THAT(console_.complaints(), IsEmpty());
  EXPECT_EQ(console_.master()->host, "head");
  EXPECT_THAT(console_.trackers(), ElementsAre("tracker-eye"));
}

TEST_F(Rolls, NameTwoMastersUntilOneIsLeft) {
  const Participant first = who(Role::master, "master", "head"),
                    second = who(Role::master, "master", "desk");
  join(first);
  join(second);
  EXPECT_THAT(console_.complaints(), ElementsAre(HasSubstr("2 masters, on head and desk")));
  leave(first);
  EXPECT_THAT(console_.complaints(), IsEmpty());
  EXPECT_EQ(console_.master(), second);
}

TEST_F(Rolls, CountTheMasterThatListens) {
  join(who(Role::master, "master", "head"));
  EXPECT_THAT(master_.complaints(), ElementsAre(HasSubstr("2 masters, on head and head")));
}

TEST_F(Rolls, NameWhoHasAnotherWallThanTheMaster) {
  join(who(Role::tile, "tile-0-0", "node0", "b"));
  join(who(Role::tile, "tile-1-0", "node1", "b"));
  join(who(Role::tile, "tile-2-0", "node2", ""));
  EXPECT_THAT(console_.complaints(), IsEmpty()) << "without a master nobody knows who is right";
  EXPECT_THAT(master_.complaints(),
              ElementsAre(AllOf(HasSubstr("tile-[0-1]-0: "), HasSubstr("another wall file"))));
  join(who(Role::master, "master", "head"));
  EXPECT_THAT(console_.complaints(), ElementsAre(HasSubstr("tile-[0-1]-0: ")));
}

TEST_F(Rolls, TellAConsoleThatItIsItsOwnFileThatDiffers) {
  join(who(Role::master, "master", "head", "b"));
  join(who(Role::tile, "tile-0-0", "node0", "b"));
  EXPECT_THAT(console_.complaints(),
              ElementsAre(AllOf(HasSubstr("the master on head"), HasSubstr("--wall"))));
}

TEST_F(Rolls, NameOtherVersionsButNotThoseOfConsoles) {
  Participant old = who(Role::tile, "tile-0-0", "node0"), desk = who(Role::console, "d", "desk");
  old.protocol = desk.protocol = 0;
  master_.hear({PresenceChange::other_version, old});
  master_.hear({PresenceChange::other_version, desk});
  EXPECT_THAT(master_.complaints(), ElementsAre(HasSubstr("speaks protocol 0")));
  old.role = Role::master;
  console_.hear({PresenceChange::other_version, old});
  EXPECT_FALSE(console_.master());
}

}  // namespace
}  // namespace vindu
