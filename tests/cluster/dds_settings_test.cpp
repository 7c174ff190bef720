// What Cyclone is told, from the wall file's [cluster].
#include <gmock/gmock.h>

#include "cluster/dds.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(DdsSettings, StayOnLoopbackWithoutAMaster) {
  EXPECT_THAT(dds_configuration(dds_settings_of({}), ""),
              AllOf(HasSubstr("name=\"lo\""), HasSubstr("<AllowMulticast>true<"),
                    HasSubstr("<Tag>wall</Tag>"), Not(HasSubstr("Peer"))));
}

TEST(DdsSettings, FindEachOtherByTheMasterAndSendDataByMulticast) {
  const ClusterConfig cluster{.name = "left", .master = "node0", .interface = "eth1", .domain = 7};
  EXPECT_THAT(dds_configuration(dds_settings_of(cluster), ""),
              AllOf(HasSubstr("name=\"eth1\""), HasSubstr("<AllowMulticast>asm<"),
                    HasSubstr("<Peer address=\"node0\"/>"), HasSubstr("<Tag>left</Tag>"),
                    HasSubstr("<ExternalDomainId>7<")));
}

TEST(DdsSettings, SendAllByUnicastOnOneWord) {
  EXPECT_THAT(dds_configuration({.multicast = false, .peers = {"node0"}}, ""),
              HasSubstr("<AllowMulticast>false<"));
}

TEST(DdsSettings, GiveWayToTheEnvironmentButForTheWallsName) {
  EXPECT_EQ(dds_configuration({.name = "a<b", .domain = 3}, "file:///etc/cyclone.xml"),
            "<CycloneDDS><Domain Id=\"any\"><Discovery><Tag>a&lt;b</Tag>"
            "<ExternalDomainId>3</ExternalDomainId></Discovery></Domain></CycloneDDS>,"
            "file:///etc/cyclone.xml");
}

}  // namespace
}  // namespace vindu
