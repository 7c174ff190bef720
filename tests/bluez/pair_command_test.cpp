// vindu wiimote pair as a real process: exit codes, JSON, errors with their remedies.
#include <gmock/gmock.h>

#include "tests/app/process.h"
#include "tests/bluez/mock_bluez.h"

namespace vindu::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(WiimotePair, WithoutBluezItFailsAndSaysWhatToInstall) {
  const PrivateBus bus;

  const ProcessResult result = vindu({"wiimote", "pair"});

  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("vindu: BlueZ"), HasSubstr("apt install bluez")));
}

TEST(WiimotePair, TellsThePersonWhatToPressAndThatNoneWasFound) {
  const PrivateBus bus;
  MockBluez bluez(bus);
  bluez.add_adapter("hci0");

  const ProcessResult result = vindu({"wiimote", "pair", "--seconds", "1"});

  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("press the red button"), HasSubstr("Not 1+2"),
                                HasSubstr("no Wiimote was found")));
}

TEST(WiimotePair, SaysAsJsonWhatBecameOfEach) {
  const PrivateBus bus;
  MockBluez bluez(bus);
  bluez.add_adapter("hci0");
  bluez.add_device_in_discovery("hci0", "00:00:00:00:00:0A", kWiimoteName,
                                {.pair = "AuthenticationFailed"});

  const ProcessResult result = vindu({"wiimote", "pair", "--seconds", "3", "--json"});

  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr(R"("address":"00:00:00:00:00:0A")"), HasSubstr(R"("bonded":false)"),
                    HasSubstr(R"("ready":false)"), HasSubstr("AuthenticationFailed")));
}

TEST(WiimotePair, WarnsOfThreeOnOneAdapter) {
  const PrivateBus bus;
  MockBluez bluez(bus);
  bluez.add_adapter("hci0");
  for (const char* address : {"00:00:00:00:00:0A", "00:00:00:00:00:0B", "00:00:00:00:00:0C"}) {
    bluez.add_bonded("hci0", address);
    bluez.set_device("hci0", address, "Connected", true);
  }

  const ProcessResult result = vindu({"wiimote", "pair", "--seconds", "1"});

  EXPECT_THAT(result.err, HasSubstr("hci0: 3 Wiimotes share this adapter"));
}

TEST(WiimotePair, CalledWrongItSaysSo) {
  EXPECT_EQ(vindu({"wiimote", "pair", "--seconds", "soon"}).exit_code, 2);
  EXPECT_EQ(vindu({"wiimote", "pair", "--count", "0"}).exit_code, 2);
}

}  // namespace
}  // namespace vindu::testing
