// The driver's session against the firmware of an emulated Wiimote that shares no code with it,
// over a link with a delay, in time that the test moves. What is counted is what people would see:
// dots, gaps and their causes.
#include "tracker/wiimote/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <functional>

#include "tracker/wiimote/emulator.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Lt;

Time at(Duration since_start) { return Time{} + seconds(1) + since_start; }

/// A session and a device, a link's delay of 3 ms to either side between them.
class Connection {
 public:
  explicit Connection(const WiimoteSettings& settings = {}, EmulatorOptions options = {})
      : session(settings), device(started(std::move(options)), [this](Time) { return view; }) {}

  /// Lets time pass.
  void run_until(Time end) {
    while (now < end) {
      now += milliseconds(1);
      if (const auto happens = each_millisecond) happens();
      while (const auto report = device.next(now)) to_host_.emplace_back(*report, now + kDelay);
      while (!to_host_.empty() && to_host_.front().second <= now) hand_over();
      while (const auto output = session.next_output(now)) write(output->span());
      while (!to_device_.empty() && to_device_.front().second <= now) obey();
    }
  }
  void run(Duration length) { run_until(now + length); }

  /// What somebody else on this machine writes.
  void write(std::span<const std::uint8_t> bytes) {
    to_device_.push_back({{bytes.begin(), bytes.end()}, now + kDelay});
  }

  const GapCount& gaps(GapCause cause) const {
    return health_.gaps[static_cast<std::size_t>(cause)];
  }
  std::uint64_t all_gaps() {
    health_ = session.health();
    std::uint64_t count = 0;
    for (const GapCount& each : health_.gaps) count += each.gaps;
    return count;
  }

  Time now = at({});
  SensorView view;
  WiimoteSession session;
  WiimoteEmulator device;
  std::vector<WiimoteSample> samples;
  std::function<void()> each_millisecond;
  std::function<bool(std::span<const std::uint8_t>)> lose_input, lose_output;

 private:
  static constexpr Duration kDelay = milliseconds(3);

  static EmulatorOptions started(EmulatorOptions options) {
    options.start = at({});
    return options;
  }
  void hand_over() {
    const EmulatedReport report = to_host_.front().first;
    to_host_.pop_front();
    if (lose_input && lose_input(report.span())) return;
    if (const auto sample = session.take(report.span(), now)) samples.push_back(*sample);
  }
  void obey() {
    const auto bytes = to_device_.front().first;
    to_device_.pop_front();
    if (!lose_output || !lose_output(bytes)) device.output(bytes, now);
  }

  std::deque<std::pair<EmulatedReport, Time>> to_host_;
  std::deque<std::pair<std::vector<std::uint8_t>, Time>> to_device_;
  WiimoteHealth health_;
};

SensorView dot_in_the_middle() {
  SensorView view;
  view.spots = {{.x_px = 511, .y_px = 383, .brightness = 0.1}};
  return view;
}

class WiimoteSessionTest : public ::testing::Test {
 protected:
  void stream(Connection& connection) {
    connection.view = dot_in_the_middle();
    connection.run(seconds(1));
    ASSERT_TRUE(connection.session.started());
    ASSERT_EQ(connection.all_gaps(), 0u);
    connection.samples.clear();
  }
};

TEST_F(WiimoteSessionTest, StartsTheCameraAndStreamsItsDots) {
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

TEST_F(WiimoteSessionTest, ShowsThePlayersNumberAndReadsStatusAndCalibration) {
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

TEST_F(WiimoteSessionTest, NumbersItsSamplesAndStampsTheirArrival) {
  Connection connection;
  stream(connection);
  connection.run(seconds(1));
  ASSERT_THAT(connection.samples, ::testing::SizeIs(AllOf(Gt(95u), Lt(106u))));
  for (std::size_t i = 1; i < connection.samples.size(); ++i) {
    EXPECT_EQ(connection.samples[i].sequence, connection.samples[i - 1].sequence + 1);
    EXPECT_GT(connection.samples[i].arrival, connection.samples[i - 1].arrival);
  }
}

TEST_F(WiimoteSessionTest, GetsTheStreamBackAfterAStatusReport) {
  Connection connection;
  stream(connection);
  connection.device.send_status(connection.now);
  connection.run(seconds(1));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::status).gaps, 1u);
  EXPECT_LE(connection.gaps(GapCause::status).longest, milliseconds(60));
}

TEST_F(WiimoteSessionTest, GetsTheStreamBackWhenTheKernelAnswersEveryStatusWithItsOwnMode) {
  Connection connection;
  stream(connection);
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

TEST_F(WiimoteSessionTest, LeavesAStreamAloneThatComesInBursts) {
  Connection connection;
  stream(connection);
  int requests = 0;
  std::uint64_t bursts = 0;
  connection.lose_output = [&](std::span<const std::uint8_t> bytes) {
    return requests += bytes[0] == 0x12, false;
  };
  connection.lose_input = [&](std::span<const std::uint8_t>) { return ++bursts % 3 != 0; };
  connection.run(milliseconds(500));  // a report each 30 ms
  EXPECT_EQ(requests, 0);
}

TEST_F(WiimoteSessionTest, IsNotRefusedByAnErrorThatAnswersSomebodyElse) {
  std::vector<std::uint8_t> poll = {0x16, 0x04, 0xa6, 0x00, 0xf0, 0x01, 0x55};  // no such device
  poll.resize(22);
  for (int moment = 0; moment < 150; moment += 3) {
    Connection connection;
    stream(connection);
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

TEST_F(WiimoteSessionTest, KnowsThatAnExtensionWasPlugged) {
  Connection connection;
  stream(connection);
  connection.device.plug_extension(true, connection.now);
  connection.run(seconds(1));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::extension).gaps, 1u);
}

TEST_F(WiimoteSessionTest, TakesTheCameraBackFromSomebodyWhoSwitchesItOff) {
  Connection connection;
  stream(connection);
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

TEST_F(WiimoteSessionTest, TakesTheCameraBackFromSomebodyWhoSetsAnotherFormat) {
  Connection connection;
  stream(connection);
  std::vector<std::uint8_t> basic = {0x16, 0x04, 0xb0, 0x00, 0x33, 0x01, 0x01};
  basic.resize(22);
  connection.write(basic);
  connection.write(std::vector<std::uint8_t>{0x12, 0x04, 0x37});
  connection.run(seconds(1));
  EXPECT_EQ(connection.samples.back().data.id, 0x33);
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
}

TEST_F(WiimoteSessionTest, GetsItsOwnReportBackFromEveryOther) {
  for (const int other : {0x30, 0x31, 0x36, 0x37, 0x3d, 0x3e}) {
    Connection connection;
    stream(connection);
    connection.write(std::vector<std::uint8_t>{0x12, 0x04, static_cast<std::uint8_t>(other)});
    connection.run(seconds(1));
    EXPECT_EQ(connection.samples.back().data.id, 0x33) << other;
    EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u) << other;
  }
}

TEST_F(WiimoteSessionTest, FindsACameraThatWasSwitchedOffInSilence) {
  Connection connection;
  stream(connection);
  connection.write(std::vector<std::uint8_t>{0x13, 0x00});
  connection.write(std::vector<std::uint8_t>{0x1a, 0x00});
  connection.run(seconds(4));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::camera).gaps, 1u);
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
}

TEST_F(WiimoteSessionTest, ComesThroughLostCommandsAndLostAnswers) {
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

TEST_F(WiimoteSessionTest, StreamsFromADeviceThatAcknowledgesNothingAndSaysSo) {
  Connection connection;
  connection.view = dot_in_the_middle();
  connection.lose_input = [](std::span<const std::uint8_t> bytes) { return bytes[0] < 0x30; };
  connection.run(seconds(4));
  ASSERT_THAT(connection.samples, ::testing::Not(IsEmpty()));
  EXPECT_THAT(connection.session.health().trouble, HasSubstr("no answer"));
  connection.lose_input = nullptr;
  connection.run(seconds(5));
  EXPECT_EQ(connection.session.health().trouble, "");
}

TEST_F(WiimoteSessionTest, KeepsAskingADeviceThatIsSilentAndNoticesItsReturn) {
  Connection connection;
  stream(connection);
  bool silent = true;
  int asked = 0;
  connection.lose_input = [&](std::span<const std::uint8_t>) { return silent; };
  connection.lose_output = [&](std::span<const std::uint8_t>) { return ++asked, silent; };
  connection.run(seconds(30));
  EXPECT_GT(asked, 100);
  EXPECT_THAT(connection.session.health().trouble, HasSubstr("Press a button"));
  silent = false;
  connection.run(seconds(4));
  connection.all_gaps();
  EXPECT_EQ(connection.gaps(GapCause::silence).gaps, 1u);
  EXPECT_GT(connection.gaps(GapCause::silence).longest, seconds(30));
  EXPECT_EQ(connection.session.health().trouble, "");
  EXPECT_EQ(dots_of(*connection.samples.back().data.slots).size(), 1u);
}

TEST_F(WiimoteSessionTest, RumblesInEveryReportUntilItIsToldNotTo) {
  Connection connection;
  stream(connection);
  connection.session.rumble(true);
  connection.run(milliseconds(20));
  EXPECT_TRUE(connection.device.rumbling());
  connection.run(seconds(12));  // with a check of the camera between
  EXPECT_TRUE(connection.device.rumbling());
  connection.session.rumble(false);
  connection.run(milliseconds(20));
  EXPECT_FALSE(connection.device.rumbling());
}

TEST_F(WiimoteSessionTest, CountsTheTimeThatADeviceWasAway) {
  Connection connection;
  stream(connection);
  connection.lose_input = [](std::span<const std::uint8_t>) { return true; };
  connection.run(milliseconds(500));
  connection.lose_input = nullptr;
  connection.session.reconnected(connection.now);
  connection.run(seconds(1));
  EXPECT_EQ(connection.all_gaps(), 1u);
  EXPECT_EQ(connection.gaps(GapCause::absent).gaps, 1u);
}

}  // namespace
}  // namespace vindu
