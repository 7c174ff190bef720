// The driver's session against an emulated Wiimote: what stops the stream, and how it comes back.
// What is counted is what people would see: dots, gaps and their causes.
#include "tracker/wiimote/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tracker/wiimote_connection.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::AllOf;
using testing::Connection;
using testing::dot_in_the_middle;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Lt;

TEST(WiimoteSession, StartsTheCameraAndStreamsItsDots) {
  for (const IrFormat format : {IrFormat::basic, IrFormat::extended, IrFormat::full}) {
    Connection connection({.format = format});
    connection.view = dot_in_the_middle();
    connection.run(milliseconds(500));
    EXPECT_TRUE(connection.session.started());
    EXPECT_EQ(connection.session.health().trouble, "");
    ASSERT_THAT(connection.samples, ::testing::SizeIs(Gt(15u)));
    const auto& slots = connection.samples.back().data.slots;
    ASSERT_TRUE(slots && (*slots)[0]);
    EXPECT_EQ((*slots)[0]->x_px, 511);
    EXPECT_EQ((*slots)[0]->y_px, 383);
    EXPECT_EQ((*slots)[0]->blob.has_value(), format == IrFormat::full);
  }
}

TEST(WiimoteSession, ShowsThePlayersNumberAndReadsStatusAndCalibration) {
  Connection connection({.player = 3}, {.eeprom = {}, .battery = 0x80});
  connection.run(seconds(1));
  EXPECT_EQ(connection.device.leds(), 0b0100);
  const WiimoteHealth health = connection.session.health();
  ASSERT_TRUE(health.status && health.calibration);
  EXPECT_EQ(health.status->battery, 0x80);
  const auto g =
      acceleration_g(*connection.samples.back().data.acceleration_raw, *health.calibration);
  EXPECT_NEAR(g[0], 0, 0.03);
  EXPECT_NEAR(g[2], 1, 0.03);
}

TEST(WiimoteSession, NumbersItsSamplesAndStampsTheirArrival) {
  Connection connection;
  connection.stream();
  connection.run(seconds(1));
  ASSERT_THAT(connection.samples, ::testing::SizeIs(AllOf(Gt(95u), Lt(106u))));
  for (std::size_t i = 1; i < connection.samples.size(); ++i) {
    EXPECT_EQ(connection.samples[i].sequence, connection.samples[i - 1].sequence + 1);
    EXPECT_GT(connection.samples[i].arrival, connection.samples[i - 1].arrival);
  }
}

TEST(WiimoteSession, GetsTheStreamBackAfterAStatusReport) {
  Connection connection;
  connection.stream();
  connection.device.send_status(connection.now);
  connection.run(seconds(1));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::status).gaps, 1u);
  EXPECT_LE(connection.gaps(GapCause::status).longest, milliseconds(60));
}

TEST(WiimoteSession, GetsTheStreamBackWhenTheKernelAnswersEveryStatusWithItsOwnMode) {
  Connection connection;
  connection.stream();
  int race = 0;
  connection.lose_input = [&](std::span<const std::uint8_t> bytes) {
    static constexpr std::uint8_t kKernels[] = {0x12, 0x00, 0x30};
    if (bytes[0] == 0x20)
      connection.each_millisecond = [&, due = connection.now + milliseconds(race)] {
        if (connection.now >= due) connection.write(kKernels), connection.each_millisecond = {};
      };
    return false;
  };
  for (; race < 40; ++race) {  // the kernel's command before, between and after ours
    connection.device.send_status(connection.now);
    connection.run(milliseconds(500));
    EXPECT_LE(connection.now - connection.samples.back().arrival, milliseconds(12)) << race;
  }
  EXPECT_GE(connection.all_gaps(), 35u);  // a few are too short to be gaps
  for (const GapCount& count : connection.session.health().gaps)
    EXPECT_LE(count.longest, milliseconds(50));
}

TEST(WiimoteSession, LeavesAStreamAloneThatComesInBursts) {
  Connection connection;
  connection.stream();
  int requests = 0;
  std::uint64_t bursts = 0;
  connection.lose_output = [&](std::span<const std::uint8_t> bytes) {
    return requests += bytes[0] == 0x12, false;
  };
  connection.lose_input = [&](std::span<const std::uint8_t>) { return ++bursts % 3 != 0; };
  connection.run(milliseconds(500));  // a report each 30 ms
  EXPECT_EQ(requests, 0);
}

TEST(WiimoteSession, IsNotRefusedByAnErrorThatAnswersSomebodyElse) {
  std::vector<std::uint8_t> poll = {0x16, 0x04, 0xa6, 0x00, 0xf0, 0x01, 0x55};  // no such device
  poll.resize(22);
  for (int moment = 0; moment < 150; moment += 3) {
    Connection connection;
    connection.stream();
    connection.write(std::vector<std::uint8_t>{0x13, 0x00});
    connection.write(std::vector<std::uint8_t>{0x1a, 0x00});
    connection.write(std::vector<std::uint8_t>{0x12, 0x00, 0x30});
    connection.run(milliseconds(moment));
    connection.write(poll);
    connection.run(seconds(3));
    connection.all_gaps();
    EXPECT_LE(connection.gaps(GapCause::camera).longest, milliseconds(400)) << moment;
    EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u) << moment;
  }
}

TEST(WiimoteSession, IsNotDisturbedByWritesOfOthersToOtherChips) {
  std::vector<std::uint8_t> motion_plus = {0x16, 0x04, 0xa6, 0x00, 0xf0, 0x01, 0x55};  // refused
  std::vector<std::uint8_t> extension = {0x16, 0x04, 0xa4, 0x00, 0xf0, 0x01, 0x55};
  motion_plus.resize(22), extension.resize(22);
  Connection connection;
  connection.stream();
  connection.device.plug_extension(true, connection.now);
  connection.run(seconds(1));
  const std::uint64_t gaps_before = connection.all_gaps();
  int reads = 0;
  connection.lose_output = [&](std::span<const std::uint8_t> bytes) {
    return reads += bytes[0] == 0x17, false;
  };
  for (int poll = 0; poll < 7; ++poll) {
    for (const auto& bytes : {motion_plus, extension, {0x11, 0x12}})
      connection.write(bytes), connection.run(milliseconds(300));
  }
  EXPECT_EQ(reads, 0);
  EXPECT_EQ(connection.all_gaps(), gaps_before);
}

TEST(WiimoteSession, WaitsForAnswersThatTakeLong) {
  Connection connection({}, {}, milliseconds(73));  // 150 ms with the device's own 4
  connection.view = dot_in_the_middle();
  connection.run(seconds(4));
  connection.write({0x13, 0x00});
  connection.write({0x1a, 0x00});
  connection.run(seconds(4));
  EXPECT_TRUE(connection.shows_the_dot());
  EXPECT_EQ(connection.session.health().starts, 2u);
  EXPECT_EQ(connection.session.health().repeated, 1u);  // reading a camera that is off is refused
  EXPECT_EQ(connection.session.health().trouble, "");
}

TEST(WiimoteSession, KnowsThatAnExtensionWasPlugged) {
  Connection connection;
  connection.stream();
  connection.device.plug_extension(true, connection.now);
  connection.run(seconds(1));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::extension).gaps, 1u);
}

TEST(WiimoteSession, TakesTheCameraBackFromSomebodyWhoSwitchesItOff) {
  Connection connection;
  connection.stream();
  for (const std::vector<std::uint8_t>& bytes :
       std::vector<std::vector<std::uint8_t>>{{0x13, 0x00}, {0x1a, 0x00}, {0x12, 0x00, 0x30}})
    connection.write(bytes);
  connection.run(seconds(1));
  connection.all_gaps();
  EXPECT_EQ(connection.gaps(GapCause::camera).gaps, 1u);
  EXPECT_LE(connection.gaps(GapCause::camera).longest, milliseconds(150));
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
  EXPECT_EQ(connection.session.health().trouble, "");
}

TEST(WiimoteSession, TakesTheCameraBackFromSomebodyWhoSetsAnotherFormat) {
  Connection connection;
  connection.stream();
  std::vector<std::uint8_t> basic = {0x16, 0x04, 0xb0, 0x00, 0x33, 0x01, 0x01};
  basic.resize(22);
  connection.write(basic);
  connection.write(std::vector<std::uint8_t>{0x12, 0x04, 0x37});
  connection.run(seconds(1));
  EXPECT_EQ(connection.samples.back().data.id, 0x33);
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
}

TEST(WiimoteSession, GetsItsOwnReportBackFromEveryOther) {
  for (const int other : {0x30, 0x31, 0x36, 0x37, 0x3d, 0x3e}) {
    Connection connection;
    connection.stream();
    connection.write(std::vector<std::uint8_t>{0x12, 0x04, static_cast<std::uint8_t>(other)});
    connection.run(seconds(1));
    EXPECT_EQ(connection.samples.back().data.id, 0x33) << other;
    EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u) << other;
  }
}

TEST(WiimoteSession, FindsACameraThatWasSwitchedOffInSilence) {
  Connection connection;
  connection.stream();
  connection.write(std::vector<std::uint8_t>{0x13, 0x00});
  connection.write(std::vector<std::uint8_t>{0x1a, 0x00});
  connection.run(seconds(4));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::camera).gaps, 1u);
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
}

TEST(WiimoteSession, ComesThroughLostCommandsAndLostAnswers) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Connection connection;
    connection.view = dot_in_the_middle();
    unsigned state = 17 + seed;
    const auto sometimes = [&](std::span<const std::uint8_t> bytes) {
      state = state * 1664525 + 1013904223;
      return (bytes[0] < 0x30) && (state >> 16) % 4 == 0;
    };
    connection.lose_input = connection.lose_output = sometimes;
    connection.run(seconds(20));
    connection.lose_input = connection.lose_output = nullptr;
    connection.run(seconds(5));
    ASSERT_TRUE(connection.session.started()) << seed;
    ASSERT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u) << seed;
    ASSERT_EQ(connection.session.health().trouble, "") << seed;
    ASSERT_GT(connection.session.health().repeated, 0u) << seed;
  }
}

TEST(WiimoteSession, StreamsFromADeviceThatAcknowledgesNothingAndSaysSo) {
  Connection connection;
  connection.view = dot_in_the_middle();
  connection.lose_input = [](std::span<const std::uint8_t> bytes) { return bytes[0] < 0x30; };
  connection.run(seconds(4));
  ASSERT_THAT(connection.samples, ::testing::Not(IsEmpty()));
  EXPECT_THAT(connection.session.health().trouble, HasSubstr("acknowledges nothing"));
  connection.lose_input = nullptr;
  connection.run(seconds(5));
  EXPECT_EQ(connection.session.health().trouble, "");
}

TEST(WiimoteSession, KeepsAskingADeviceThatIsSilentAndNoticesItsReturn) {
  Connection connection;
  connection.stream();
  bool silent = true;
  int asked = 0;
  connection.lose_input = [&](std::span<const std::uint8_t>) { return silent; };
  connection.lose_output = [&](std::span<const std::uint8_t>) { return ++asked, silent; };
  connection.run(seconds(30));
  EXPECT_GT(asked, 100);
  EXPECT_THAT(connection.session.health().trouble, HasSubstr("press a button"));
  silent = false;
  connection.run(seconds(4));
  connection.all_gaps();
  EXPECT_EQ(connection.gaps(GapCause::silence).gaps, 1u);
  EXPECT_GT(connection.gaps(GapCause::silence).longest, seconds(30));
  EXPECT_EQ(connection.session.health().trouble, "");
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
}

TEST(WiimoteSession, RumblesInEveryReportUntilItIsToldNotTo) {
  Connection connection;
  connection.stream();
  connection.session.rumble(true);
  connection.run(milliseconds(20));
  EXPECT_TRUE(connection.device.rumbling());
  connection.run(seconds(12));  // with a check of the camera between
  EXPECT_TRUE(connection.device.rumbling());
  connection.session.rumble(false);
  connection.run(milliseconds(20));
  EXPECT_FALSE(connection.device.rumbling());
}

TEST(WiimoteSession, CountsTheTimeThatADeviceWasAway) {
  Connection connection;
  connection.stream();
  connection.lose_input = [](std::span<const std::uint8_t>) { return true; };
  connection.session.away(connection.now);
  connection.run(milliseconds(500));
  connection.lose_input = nullptr;
  connection.session.reconnected(connection.now);
  connection.run(seconds(1));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::absent).gaps, 1u);
}

}  // namespace
}  // namespace vindu
