// What participants say of themselves when they are found.
#include "cluster/internal/participant_text.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace vindu {
namespace {

using internal::participant_from;
using internal::text_of;

const Participant kTile{.role = Role::tile, .name = "tile-3-0", .host = "node7", .version = "0.1"};
const std::string kProtocol = std::to_string(kProtocolVersion);

TEST(ParticipantText, ComesBack) {
  EXPECT_EQ(text_of(kTile), "role=tile name=tile-3-0 host=node7 version=0.1 protocol=" + kProtocol);
  EXPECT_EQ(participant_from(text_of(kTile)), kTile);
}

TEST(ParticipantText, SaysOfAMasterWhenItCameAndOfAllWhichWallTheyMean) {
  Participant master = kTile;
  master.role = Role::master;
  master.epoch = 18446744073709551615u;
  master.wall = "0123456789abcdef";
  EXPECT_EQ(participant_from(text_of(master)), master);
}

TEST(ParticipantText, MaySayMore) {
  EXPECT_EQ(participant_from("colour=red " + text_of(kTile) + " more=1"), kTile);
}

TEST(ParticipantText, OfOthersIsRefused) {
  for (const char* text :
       {"", " ", "tile", "role=tile", "role=king name=a host=b version=c protocol=1",
        "role=tile name= host=b version=c protocol=1",
        "role=tile name=a host=b version=c protocol=x",
        "role=tile name=a host=b version=c protocol=99999999999",
        "role=tile name=\x1b[1m host=b version=c protocol=1"})
    EXPECT_FALSE(participant_from(text)) << text;
  EXPECT_FALSE(participant_from(text_of(kTile) + std::string(2000, ' ')));
}

TEST(ParticipantText, OfANameThatCannotBeSaidThrows) {
  EXPECT_THROW(text_of({.name = "a b", .host = "c", .version = "1"}), Error);
  EXPECT_THROW(text_of({.name = "", .host = "c", .version = "1"}), Error);
}

TEST(VersionComplaint, NamesBothSidesAndTheRemedy) {
  Participant other = kTile;
  other.protocol = 99;
  EXPECT_EQ(version_complaint({Role::master, "master", "node0", "0.2"}, other),
            "tile tile-3-0 on node7 (vindu 0.1) speaks protocol 99, but master master on node0 "
            "(vindu 0.2) speaks protocol " +
                kProtocol +
                ": they do not hear each other; install the same vindu "
                "on both (vindu deploy)");
}

}  // namespace
}  // namespace vindu
