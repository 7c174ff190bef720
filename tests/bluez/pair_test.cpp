// Pairing over a mocked BlueZ: what is paired, what is left alone, what is said when it fails.
#include "tracker/wiimote/bluez_pair.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/bluez/mock_bluez.h"

namespace vindu::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kWiimote = "00:1F:C5:1B:3A:B1";
constexpr const char* kOther = "00:22:D7:E7:5B:D3";

/// HID devices that appear a few looks late, as hidapi names them.
class LateHid final : public HidBus {
 public:
  std::vector<HidInfo> list() override {
    if (++looks_ < 3) return {};
    return {{"/dev/hidraw0", 0x057e, 0x0306, kWiimoteName, "00:1f:c5:1b:3a:b1"},
            {"/dev/hidraw1", 0x057e, 0x0306, kWiimoteName, "00:22:d7:e7:5b:d3"}};
  }
  std::unique_ptr<HidDevice> open(const std::string&) override { return nullptr; }
  int looks() const { return looks_; }

 private:
  int looks_ = 0;
};

class NoHid final : public HidBus {
 public:
  std::vector<HidInfo> list() override { return {}; }
  std::unique_ptr<HidDevice> open(const std::string&) override { return nullptr; }
};

class PairTest : public ::testing::Test {
 protected:
  std::vector<PairResult> pair(HidBus& hid, const PairOptions& options) {
    return pair_wiimotes(options, hid, clock_);
  }
  std::vector<PairResult> pair(const PairOptions& options) { return pair(hid_, options); }
  std::string error_of_pairing(const PairOptions& options = {}) {
    try {
      pair(options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  MonotonicClock clock_;
  LateHid hid_;
  PrivateBus bus_;
  MockBluez bluez_{bus_};
};

TEST_F(PairTest, OneThatIsFoundAfterAWhileIsBondedTrustedConnectedAndReady) {
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName);

  const auto results = pair({});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_TRUE(results[0].ready()) << results[0].trouble;
  EXPECT_EQ(results[0].device.address, kWiimote);
  EXPECT_EQ(results[0].device.adapter, "hci0");
  EXPECT_TRUE(results[0].device.paired);
  EXPECT_TRUE(results[0].device.trusted);
  EXPECT_TRUE(results[0].device.connected);
}

TEST_F(PairTest, ItWaitsForTheHidDevice) {
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName);

  pair({});

  EXPECT_GE(hid_.looks(), 3);
}

TEST_F(PairTest, OnlyClassicBluetoothIsSearched) {
  bluez_.add_adapter("hci0");

  pair({.patience = 300ms});

  EXPECT_EQ(bluez_.discovery_transport("hci0"), "bredr");
}

TEST_F(PairTest, AsManyAsAreAskedFor) {
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName);
  bluez_.add_device_in_discovery("hci0", kOther, "Nintendo RVL-CNT-01-TR");

  const auto results = pair({.count = 2});

  ASSERT_EQ(results.size(), 2u);
  EXPECT_TRUE(results[0].ready() && results[1].ready());
}

TEST_F(PairTest, WhatIsNoWiimoteIsLeftAlone) {
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", "00:00:00:00:00:01", "Nintendo RVL-CNT-01-UC");
  bluez_.add_device_in_discovery("hci0", "00:00:00:00:00:02", "Nintendo RVL-WBC-01");
  bluez_.add_device_in_discovery("hci0", "00:00:00:00:00:03", "Keyboard");

  EXPECT_THAT(pair({.patience = 2s}), IsEmpty());
}

TEST_F(PairTest, AFailedPairingSaysWhatToPressAndIsForgotten) {
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName, {.pair = "AuthenticationFailed"});

  const auto results = pair({.patience = 2s});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_THAT(results[0].trouble, HasSubstr("AuthenticationFailed"));
  EXPECT_THAT(results[0].remedy, AllOf(HasSubstr("red button"), HasSubstr("docs/wiimotes.md")));
  EXPECT_FALSE(results[0].device.paired);
  EXPECT_THAT(bluez_wiimotes().wiimotes, IsEmpty());
}

TEST_F(PairTest, AFailureDoesNotKeepTheNextOneFromBeingPaired) {
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName, {.connect = "Failed"});
  bluez_.add_device_in_discovery("hci0", kOther, kWiimoteName);

  const auto results = pair({.patience = 4s});

  ASSERT_EQ(results.size(), 2u);
  EXPECT_THAT(results[0].trouble, HasSubstr("the connection failed"));
  EXPECT_TRUE(results[1].ready()) << results[1].trouble;
}

TEST_F(PairTest, AConnectionWithoutHidDeviceSaysWhyNot) {
  NoHid none;
  bluez_.add_adapter("hci0");
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName);

  const auto results = pair(none, {.patience = 2s, .hid_wait = 300ms});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_THAT(results[0].trouble, HasSubstr("no HID device"));
  EXPECT_THAT(results[0].remedy, HasSubstr("ClassicBondedOnly"));
}

TEST_F(PairTest, OneThatIsKnownWithoutABondIsRemovedAndPairedAnew) {
  bluez_.add_adapter("hci0");
  bluez_.add_device("hci0", kWiimote, kWiimoteName, {.pair = "AuthenticationFailed"});
  bluez_.set_device("hci0", kWiimote, "Connected", true);  // as 1+2 leaves it
  bluez_.add_device_in_discovery("hci0", kWiimote, kWiimoteName);

  const auto results = pair({});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_TRUE(results[0].ready()) << results[0].trouble;
}

TEST_F(PairTest, OneThatIsKnownWithoutABondIsNotTakenForOneInDiscovery) {
  bluez_.add_adapter("hci0");
  bluez_.add_device("hci0", kWiimote, kWiimoteName);

  EXPECT_THAT(pair({.patience = 1s}), IsEmpty());
  EXPECT_THAT(bluez_wiimotes().wiimotes, IsEmpty());
}

TEST_F(PairTest, ABondedOneInDiscoveryIsConnectedAndKeepsItsBond) {
  bluez_.add_adapter("hci0");
  bluez_.add_bonded("hci0", kWiimote);

  const auto results = pair({});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_TRUE(results[0].ready()) << results[0].trouble;
  EXPECT_TRUE(results[0].device.paired);
}

TEST_F(PairTest, AStaleBondIsRemoved) {
  bluez_.add_adapter("hci0");
  bluez_.add_device("hci0", kWiimote, kWiimoteName, {.connect = "Failed"});
  bluez_.set_device("hci0", kWiimote, "Paired", true);

  pair({.patience = 2s});

  EXPECT_THAT(bluez_wiimotes().wiimotes, IsEmpty());
}

TEST_F(PairTest, TheAdapterWithTheFewestWiimotesIsTaken) {
  bluez_.add_adapter("hci0");
  bluez_.add_adapter("hci1");
  bluez_.add_bonded("hci0", kOther);
  bluez_.add_device_in_discovery("hci1", kWiimote, kWiimoteName);

  const auto results = pair({});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].device.adapter, "hci1");
}

TEST_F(PairTest, TheAdapterThatIsNamedIsTaken) {
  bluez_.add_adapter("hci0");
  bluez_.add_adapter("hci1");
  bluez_.add_bonded("hci1", kOther);
  bluez_.set_device("hci1", kOther, "Connected", true);
  bluez_.add_device_in_discovery("hci1", kWiimote, kWiimoteName);

  const auto results = pair({.adapter = "hci1"});

  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].device.address, kWiimote);
}

TEST_F(PairTest, WithoutAnAdapterItSaysSo) {
  EXPECT_THAT(error_of_pairing(), HasSubstr("there is no Bluetooth adapter"));
}

TEST_F(PairTest, AnUnknownAdapterIsAnErrorThatNamesThoseThereAre) {
  bluez_.add_adapter("hci0");
  bluez_.add_adapter("hci1");

  EXPECT_THAT(error_of_pairing({.adapter = "hci7"}),
              AllOf(HasSubstr("hci7"), HasSubstr("hci0, hci1")));
}

TEST_F(PairTest, AnAdapterThatIsOffIsAnErrorThatSaysHowToSwitchItOn) {
  bluez_.add_adapter("hci0");
  bluez_.set_adapter("hci0", "Powered", false);

  EXPECT_THAT(error_of_pairing(), AllOf(HasSubstr("hci0"), HasSubstr("bluetoothctl power on")));
}

TEST_F(PairTest, ABlockedAdapterIsAnErrorThatSaysHowToUnblockIt) {
  bluez_.add_adapter("hci0");
  bluez_.set_adapter("hci0", "Powered", false);
  bluez_.set_adapter_text("hci0", "PowerState", "off-blocked");

  EXPECT_THAT(error_of_pairing(),
              AllOf(HasSubstr("blocked by rfkill"), HasSubstr("rfkill unblock bluetooth")));
}

TEST_F(PairTest, AnAdapterThatIsOnIsPreferred) {
  bluez_.add_adapter("hci0");
  bluez_.add_adapter("hci1");
  bluez_.set_adapter("hci0", "Powered", false);
  bluez_.add_device_in_discovery("hci1", kWiimote, kWiimoteName);

  EXPECT_EQ(pair({}).size(), 1u);
}

}  // namespace
}  // namespace vindu::testing
