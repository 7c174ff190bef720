// What BlueZ knows of Wiimotes, and what is said where there is no BlueZ.
#include <gmock/gmock.h>

#include "tests/bluez/mock_bluez.h"
#include "tracker/wiimote/bluez.h"

namespace vindu::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(BluezView, SaysWhichWiimoteIsOnWhichAdapterAndHowItStands) {
  const PrivateBus bus;
  MockBluez bluez(bus);
  bluez.add_adapter("hci0");
  bluez.add_adapter("hci1");
  bluez.add_device("hci0", "00:00:00:00:00:0B", kWiimoteName);
  bluez.add_bonded("hci1", "00:00:00:00:00:0A");
  bluez.set_device("hci1", "00:00:00:00:00:0A", "Trusted", true);
  bluez.add_device("hci0", "00:00:00:00:00:0C", "Nintendo RVL-CNT-01-UC");

  const BluezView view = bluez_wiimotes();

  EXPECT_EQ(view.trouble, "");
  EXPECT_EQ(view.adapters.size(), 2u);
  ASSERT_EQ(view.wiimotes.size(), 2u);
  EXPECT_EQ(view.wiimotes[0].adapter, "hci1");
  EXPECT_TRUE(view.wiimotes[0].paired && view.wiimotes[0].trusted);
  EXPECT_FALSE(view.wiimotes[0].connected);
  EXPECT_EQ(view.wiimotes[1].adapter, "hci0");
  EXPECT_FALSE(view.wiimotes[1].paired);
}

TEST(BluezView, APairingWhoseKeyIsNotKeptIsNone) {
  const PrivateBus bus;
  MockBluez bluez(bus);
  bluez.add_adapter("hci0");
  bluez.add_bonded("hci0", "00:00:00:00:00:0A");
  bluez.set_device("hci0", "00:00:00:00:00:0A", "Bonded", false);

  const BluezView view = bluez_wiimotes();

  ASSERT_EQ(view.wiimotes.size(), 1u);
  EXPECT_FALSE(view.wiimotes[0].paired);
}

TEST(BluezView, WithoutBluezItIsEmptyAndSaysWhatToInstall) {
  const PrivateBus bus;

  const BluezView view = bluez_wiimotes();

  EXPECT_THAT(view.adapters, IsEmpty());
  EXPECT_THAT(view.trouble, AllOf(HasSubstr("BlueZ"), HasSubstr("apt install bluez")));
}

TEST(BluezView, WithoutABusItIsEmptyAndSaysWhatToInstall) {
  setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nonexistent/bus", 1);

  const BluezView view = bluez_wiimotes();

  unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
  EXPECT_THAT(view.trouble, AllOf(HasSubstr("D-Bus"), HasSubstr("apt install dbus")));
}

TEST(BluezView, WithoutPermissionItSaysWhichGroupToJoin) {
  const PrivateBus bus("org.bluez");
  const MockBluez bluez(bus);

  EXPECT_THAT(bluez_wiimotes().trouble, HasSubstr("adduser $USER bluetooth"));
}

BluezDevice bonded(const std::string& adapter) { return {.adapter = adapter, .paired = true}; }

TEST(AdapterWarnings, ThreeOnOneAdapterAreTooMany) {
  const std::vector<BluezDevice> wiimotes = {bonded("hci0"), bonded("hci1"), bonded("hci0"),
                                             bonded("hci0")};

  EXPECT_THAT(adapter_warnings(wiimotes),
              ElementsAre(AllOf(HasSubstr("hci0: 3 Wiimotes"), HasSubstr("--adapter"))));
}

TEST(AdapterWarnings, TwoAreNotNorAreStrangers) {
  const std::vector<BluezDevice> wiimotes = {
      bonded("hci0"), bonded("hci0"), {.adapter = "hci0"}, bonded("hci1"), bonded("hci1")};

  EXPECT_THAT(adapter_warnings(wiimotes), IsEmpty());
}

}  // namespace
}  // namespace vindu::testing
