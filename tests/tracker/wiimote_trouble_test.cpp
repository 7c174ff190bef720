// What the driver's session says of a Wiimote that is not as it should be, and what it does all the
// same.
#include <gmock/gmock.h>

#include "tests/tracker/wiimote_connection.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using ::testing::AllOf;
using testing::Connection;
using testing::dot_in_the_middle;
using ::testing::HasSubstr;

const WiimoteSettings kThirdPlayer{.player = 3};

std::string trouble_of(const Connection& connection) { return connection.session.health().trouble; }

TEST(WiimoteTrouble, SaysThatReportsAreTooShort) {
  Connection connection;
  connection.spoil_input = [](std::vector<std::uint8_t>& report) {
    if (report[0] == 0x33) report.resize(12);
  };
  connection.run(seconds(5));
  EXPECT_THAT(trouble_of(connection), AllOf(HasSubstr("no 0x33"), HasSubstr("too short")));
  EXPECT_GT(connection.session.health().refused, 100u);
  connection.spoil_input = nullptr;
  connection.run(seconds(1));
  EXPECT_EQ(trouble_of(connection), "");
}

TEST(WiimoteTrouble, SaysWhichReportADeviceSendsForEverInstead) {
  Connection connection;
  connection.lose_output = [&](std::span<const std::uint8_t> bytes) {
    const std::vector<std::uint8_t> buttons = {0x12, 0x04, 0x30};
    return bytes[0] == 0x12 && connection.device.output(buttons, connection.now);
  };
  connection.run(seconds(5));
  EXPECT_THAT(trouble_of(connection), AllOf(HasSubstr("no 0x33"), HasSubstr("it sends 0x30")));
  connection.lose_output = nullptr;
  connection.run(seconds(2));
  EXPECT_EQ(trouble_of(connection), "");
}

TEST(WiimoteTrouble, SaysThatADeviceObeysButSendsNoData) {
  Connection connection;
  connection.lose_input = [](std::span<const std::uint8_t> bytes) { return bytes[0] >= 0x30; };
  connection.run(seconds(5));
  EXPECT_THAT(trouble_of(connection), AllOf(HasSubstr("no 0x33"), HasSubstr("no data")));
}

TEST(WiimoteTrouble, SaysThatOneHalfOfTheFullFormatIsMissing) {
  for (const int missing : {0x3e, 0x3f}) {
    Connection connection({.format = IrFormat::full});
    connection.stream();
    connection.lose_input = [missing](std::span<const std::uint8_t> bytes) {
      return bytes[0] == missing;
    };
    connection.run(seconds(5));
    EXPECT_THAT(trouble_of(connection), HasSubstr("one is missing")) << missing;
    connection.lose_input = nullptr;
    connection.run(seconds(1));
    EXPECT_EQ(trouble_of(connection), "") << missing;
  }
}

TEST(WiimoteTrouble, CountsTheGapThatIsStillOpen) {
  Connection connection;
  connection.stream();
  connection.lose_input = [](std::span<const std::uint8_t> bytes) { return bytes[0] >= 0x30; };
  connection.run(seconds(5));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_GT(connection.gaps(GapCause::silence).total, seconds(4));
  EXPECT_GT(connection.session.health().open_gap, seconds(4));
}

TEST(WiimoteTrouble, TellsASilentDeviceFromOneThatAcknowledgesNothing) {
  Connection connection;
  connection.view = dot_in_the_middle();
  connection.lose_input = [](std::span<const std::uint8_t>) { return true; };
  connection.run(seconds(4));
  EXPECT_THAT(trouble_of(connection), HasSubstr("silent: press a button"));
  connection.lose_input = [](std::span<const std::uint8_t> bytes) { return bytes[0] < 0x30; };
  connection.run(seconds(4));
  EXPECT_TRUE(connection.shows_the_dot());
  EXPECT_THAT(trouble_of(connection), HasSubstr("acknowledges nothing"));
}

/// Answers every read of these addresses with an error.
void refuse_reads(Connection& connection, bool registers, std::uint8_t last_byte = 0,
                  int times = 1 << 20) {
  connection.lose_output = [&, registers, last_byte,
                            times](std::span<const std::uint8_t> bytes) mutable {
    const bool this_one = bytes[0] == 0x17 && ((bytes[1] & 0x04) != 0) == registers &&
                          (last_byte == 0 || bytes[4] == last_byte) && times > 0;
    if (!this_one) return false;
    --times;
    std::vector<std::uint8_t> error = {0x21, 0, 0, 0xf7, bytes[3], bytes[4]};
    error.resize(22);
    connection.send(error);
    return true;
  };
}

TEST(WiimoteTrouble, ReadsTheCopyOfACalibrationThatCannotBeRead) {
  Connection connection(kThirdPlayer);
  refuse_reads(connection, false, 0x16);
  connection.stream();
  EXPECT_TRUE(connection.session.health().calibration);
  EXPECT_EQ(connection.device.leds(), 0b0100);
  EXPECT_EQ(trouble_of(connection), "");
}

TEST(WiimoteTrouble, MakesUpForAGreetingThatWasLost) {
  Connection connection(kThirdPlayer);
  connection.view = dot_in_the_middle();
  connection.lose_input = [](std::span<const std::uint8_t> bytes) { return bytes[0] == 0x20; };
  connection.run(milliseconds(1020));
  ASSERT_FALSE(connection.session.health().status);
  connection.lose_input = nullptr;
  connection.run(seconds(2));
  const WiimoteHealth health = connection.session.health();
  EXPECT_TRUE(health.status && health.calibration);
  EXPECT_EQ(connection.device.leds(), 0b0100);
  EXPECT_EQ(health.trouble, "");
}

TEST(WiimoteTrouble, LightsItsLedAgainAfterSomebodyElseHasSetThem) {
  Connection connection(kThirdPlayer);
  connection.stream();
  connection.write({0x11, 0x10});  // as hid-wiimote does when it finds the device
  connection.run(milliseconds(50));
  ASSERT_EQ(connection.device.leds(), 0b0001);
  connection.device.send_status(connection.now);
  connection.run(milliseconds(200));
  EXPECT_EQ(connection.device.leds(), 0b0100);
}

TEST(WiimoteTrouble, WagesNoWarAboutTheLeds) {
  Connection connection(kThirdPlayer);
  connection.stream();
  int lit = 0;
  connection.lose_output = [&](std::span<const std::uint8_t> bytes) {
    return lit += bytes[0] == 0x11 && bytes[1] == 0x40, false;
  };
  for (int second = 0; second < 60; ++second) {
    connection.write({0x11, 0x10});
    connection.run(milliseconds(500));
    connection.device.send_status(connection.now);
    connection.run(milliseconds(500));
  }
  EXPECT_GE(lit, 1);
  EXPECT_LE(lit, 2);
}

TEST(WiimoteTrouble, LeavesACameraAloneThatShowsDotsAndDoesNotLetItselfBeRead) {
  Connection connection;
  refuse_reads(connection, true);
  connection.stream();
  connection.run(minutes(2));
  EXPECT_EQ(connection.session.health().starts, 1u);
  EXPECT_EQ(connection.all_gaps(), 0u);
  EXPECT_THAT(trouble_of(connection), HasSubstr("runs unchecked"));
  connection.lose_output = nullptr;
  connection.run(seconds(11));
  EXPECT_EQ(trouble_of(connection), "");
}

TEST(WiimoteTrouble, StartsACameraThatIsOffThoughItDoesNotLetItselfBeRead) {
  Connection connection;
  refuse_reads(connection, true);
  connection.stream();
  connection.write({0x13, 0x00});
  connection.write({0x1a, 0x00});
  connection.run(seconds(4));
  EXPECT_TRUE(connection.shows_the_dot());
}

TEST(WiimoteTrouble, KeepsTheStreamWhileTheCameraCannotBeMadeAsItShouldBe) {
  Connection connection;
  connection.stream();
  connection.spoil_input = [](std::vector<std::uint8_t>& report) {
    if (report[0] == 0x21) report[6] ^= 0xff;  // the first byte of what is read back
  };
  connection.run(seconds(12));
  EXPECT_THAT(trouble_of(connection), HasSubstr("end other programs"));
  for (int moment = 0; moment < 60; ++moment) {
    if (moment % 6 == 0) connection.device.send_status(connection.now);
    connection.run(milliseconds(100));
    EXPECT_LE(connection.now - connection.samples.back().arrival, milliseconds(200)) << moment;
  }
  connection.spoil_input = nullptr;
  connection.run(seconds(3));
  EXPECT_EQ(trouble_of(connection), "");
}

TEST(WiimoteTrouble, ReadsOnceMoreWhatWasRefusedOnce) {
  Connection connection;
  refuse_reads(connection, true, 0, 1);
  connection.stream();
  EXPECT_EQ(connection.session.health().starts, 1u);
  EXPECT_EQ(trouble_of(connection), "");
}

TEST(WiimoteTrouble, TellsThatADeviceWentAwayWithEmptyBatteries) {
  Connection connection({}, {.eeprom = {}, .battery = 0x18});
  connection.stream();
  connection.lose_input = [](std::span<const std::uint8_t>) { return true; };
  connection.session.away(connection.now);
  connection.run(milliseconds(500));
  connection.lose_input = nullptr;
  connection.session.reconnected(connection.now);
  connection.run(seconds(2));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::battery).gaps, 1u);
}

TEST(WiimoteTrouble, LooksAtTheBatteryNowAndThenWhileNobodyIsInView) {
  Connection connection;
  connection.stream();
  connection.device.set_battery(0x30);
  connection.run(minutes(25));
  EXPECT_EQ(connection.session.health().status->battery, 0xc0);
  connection.view = {};
  connection.run(minutes(1));
  EXPECT_EQ(connection.session.health().status->battery, 0x30);
}

}  // namespace
}  // namespace vindu
