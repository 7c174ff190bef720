// Emulated devices through the seam that programs see: found, opened, read, written, and broken.
#include "tracker/wiimote/emulator_bus.h"

#include <gmock/gmock.h>

#include <thread>

#include "core/error.h"
#include "tests/tracker/emulator_host.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

SensorView nothing_seen(Time) { return {}; }

class EmulatedBusTest : public ::testing::Test {
 protected:
  EmulatedDevice& add(EmulatedDeviceOptions options = {}) {
    return bus_.add(std::move(options), nothing_seen);
  }
  std::unique_ptr<HidDevice> open(std::size_t index) { return bus_.open(bus_.path(index)); }
  static bool write(HidDevice& device, const std::string& hex) {
    return device.write(from_hex(hex));
  }
  /// All reports that arrive within this time; "gone" where the device went.
  std::vector<std::string> read(HidDevice& device, Duration time) {
    std::vector<std::string> reports;
    std::array<std::uint8_t, 64> buffer;
    for (const Time until = clock_.now() + time;;) {
      const HidRead read = device.read(buffer, until);
      if (read.status == HidStatus::gone) reports.emplace_back("gone");
      if (read.status != HidStatus::report) return reports;
      reports.push_back(to_hex(std::span(buffer).first(read.size)));
    }
  }

  ManualClock clock_;
  EmulatedHidBus bus_{clock_};
};

TEST_F(EmulatedBusTest, lists_wiimotes_of_both_kinds_and_what_is_none) {
  EmulatedDeviceOptions plus;
  plus.firmware.motion_plus = true;
  add();
  add(plus);
  bus_.add_strangers();
  std::vector<std::string> lines;
  for (const HidInfo& info : bus_.list())
    lines.push_back(info.path + " " + info.name + " " +
                    to_hex(Bytes{static_cast<std::uint8_t>(info.product_id / 256),
                                 static_cast<std::uint8_t>(info.product_id % 256)}));
  EXPECT_THAT(lines, ElementsAre("/dev/hidraw0 Nintendo RVL-CNT-01 03 06",
                                 "/dev/hidraw1 Nintendo RVL-CNT-01-TR 03 30",
                                 "/dev/hidraw2 Nintendo RVL-WBC-01 03 06",
                                 "/dev/hidraw3 Nintendo RVL-CNT-01-UC 03 30"));
}

TEST_F(EmulatedBusTest, answers_after_the_way_there_the_command_and_the_way_back) {
  add();
  const auto wiimote = open(0);
  EXPECT_TRUE(write(*wiimote, "11 12"));
  EXPECT_THAT(read(*wiimote, milliseconds(11)), IsEmpty());  // 2 + 4 + 6 ms, and jitter
  EXPECT_THAT(read(*wiimote, milliseconds(2)), ElementsAre("22 00 00 11 00"));
  EXPECT_EQ(bus_.device(0).leds(), 1);
}

TEST_F(EmulatedBusTest, waits_on_the_clock_until_a_report_arrives) {
  add();
  const auto wiimote = open(0);
  write(*wiimote, "12 04 30");
  std::array<std::uint8_t, 3> buffer;
  const HidRead got = wiimote->read(buffer, Time{seconds(1)});
  EXPECT_EQ(got.status, HidStatus::report);
  EXPECT_EQ(clock_.now(), got.arrival);
  EXPECT_GT(got.arrival, Time{milliseconds(6)});
}

TEST_F(EmulatedBusTest, cuts_a_report_that_does_not_fit) {
  add();
  const auto wiimote = open(0);
  write(*wiimote, "15 00");
  std::array<std::uint8_t, 2> buffer;
  EXPECT_EQ(wiimote->read(buffer, Time{seconds(1)}).size, 2u);
}

TEST_F(EmulatedBusTest, shows_every_reader_every_report) {
  add();
  const auto one = open(0), other = open(0);
  write(*one, "15 00");
  EXPECT_THAT(read(*one, milliseconds(50)), ElementsAre("20 00 00 00 00 00 c0"));
  EXPECT_THAT(read(*other, milliseconds(50)), ElementsAre("20 00 00 00 00 00 c0"));
}

TEST_F(EmulatedBusTest, drops_what_a_slow_reader_leaves_in_a_full_ring) {
  EmulatedDevice& device = add();
  const auto wiimote = open(0);
  write(*wiimote, "12 04 30");
  clock_.sleep_until(Time{seconds(2)});
  const auto kept = read(*wiimote, Duration::zero());
  EXPECT_EQ(kept.size(), 64u);
  EXPECT_EQ(device.counts().dropped + 64, device.counts().arrived);
}

TEST_F(EmulatedBusTest, says_why_a_device_cannot_be_opened) {
  EmulatedDeviceOptions forbidden;
  forbidden.permitted = false;
  add(forbidden);
  for (const std::string path : {"/dev/hidraw0", "/dev/hidraw9"}) {
    try {
      bus_.open(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(path));
    }
  }
}

TEST_F(EmulatedBusTest, a_dolphin_bar_has_four_slots_of_which_the_empty_ones_refuse) {
  bus_.add_dolphin_bar({nothing_seen});
  ASSERT_EQ(bus_.list().size(), 4u);
  for (const HidInfo& slot : bus_.list()) EXPECT_EQ(slot.address, "");
  const auto held = open(0), empty = open(3);
  EXPECT_TRUE(write(*held, "15 00"));
  EXPECT_FALSE(write(*empty, "15 00"));
  EXPECT_THAT(read(*held, milliseconds(50)), ::testing::SizeIs(1));
  EXPECT_THAT(read(*empty, milliseconds(50)), IsEmpty());
}

TEST_F(EmulatedBusTest, a_slot_stays_open_and_at_its_place_when_its_wiimote_goes_and_comes) {
  bus_.add_dolphin_bar({nothing_seen});
  const auto slot = open(0);
  bus_.device(0).unplug();
  EXPECT_EQ(bus_.list().size(), 4u);
  EXPECT_THAT(read(*slot, milliseconds(50)), IsEmpty());
  EXPECT_FALSE(write(*slot, "15 00"));
  bus_.device(0).plug_in();
  EXPECT_EQ(bus_.path(0), "/dev/hidraw0");
  EXPECT_TRUE(write(*slot, "15 00"));
  EXPECT_THAT(read(*slot, milliseconds(50)), ElementsAre("20 00 00 00 00 00 c0"));
}

TEST_F(EmulatedBusTest, an_unplugged_device_is_gone_for_its_reader_and_returns_at_another_path) {
  EmulatedDevice& device = add();
  const auto before = open(0);
  write(*before, "11 10");
  read(*before, milliseconds(50));
  device.unplug_at(clock_.now() + milliseconds(100));
  device.plug_in_at(clock_.now() + milliseconds(300));
  EXPECT_THAT(read(*before, milliseconds(200)), ElementsAre("gone"));
  EXPECT_FALSE(write(*before, "11 10"));
  EXPECT_THAT(bus_.list(), IsEmpty());
  clock_.sleep_until(clock_.now() + milliseconds(300));
  ASSERT_EQ(bus_.list().size(), 1u);
  EXPECT_NE(bus_.list()[0].path, "/dev/hidraw0");
  const auto after = open(0);
  EXPECT_EQ(device.leds(), 0);
  write(*after, "15 00");
  EXPECT_THAT(read(*after, milliseconds(50)), ElementsAre("20 00 00 00 00 00 c0"));
  EXPECT_THAT(read(*before, milliseconds(50)), ElementsAre("gone"));
}

TEST_F(EmulatedBusTest, faults_do_what_their_names_say) {
  EmulatedDevice& device = add();
  const auto wiimote = open(0);
  device.lose_acknowledgements(1);
  write(*wiimote, "11 12");
  write(*wiimote, "15 00");
  EXPECT_THAT(read(*wiimote, milliseconds(100)), ElementsAre("20 00 00 10 00 00 c0"));
  device.lose_acknowledgements(0);
  device.stay_silent(true);
  write(*wiimote, "11 12");
  EXPECT_THAT(read(*wiimote, milliseconds(100)), IsEmpty());
  device.stay_silent(false);
  device.send_status();
  EXPECT_THAT(read(*wiimote, milliseconds(100)), ElementsAre("20 00 00 10 00 00 c0"));
  device.plug_extension(true);
  EXPECT_THAT(read(*wiimote, milliseconds(100)), ElementsAre("20 00 00 12 00 00 c0"));
  device.send_garbage(20);
  EXPECT_THAT(read(*wiimote, milliseconds(100)), ::testing::SizeIs(20));
  device.set_battery(0);
  EXPECT_THAT(read(*wiimote, milliseconds(100)), ElementsAre("gone"));
}

TEST_F(EmulatedBusTest, loses_the_given_share_of_acknowledgements) {
  add().lose_acknowledgements(0.25);
  const auto wiimote = open(0);
  std::size_t came = 0;
  for (int i = 0; i < 1000; ++i) {
    write(*wiimote, "11 12");
    came += read(*wiimote, milliseconds(20)).size();
  }
  EXPECT_NEAR(static_cast<double>(came), 750, 60);
}

TEST_F(EmulatedBusTest, the_kernel_stops_a_stream_when_the_battery_is_read) {
  EmulatedDeviceOptions options;
  options.kernel = KernelOptions{};
  EmulatedDevice& device = add(options);
  const auto wiimote = open(0);
  read(*wiimote, seconds(1));
  write(*wiimote, "12 04 31");
  EXPECT_GE(read(*wiimote, milliseconds(500)).size(), 48u);
  device.read_battery();
  const auto last = read(*wiimote, milliseconds(500));
  EXPECT_THAT(last, ::testing::Contains("20 00 00 10 00 00 c0"));
  EXPECT_EQ(last.back(), "30 00 00");
  EXPECT_THAT(read(*wiimote, milliseconds(500)), IsEmpty());
}

TEST_F(EmulatedBusTest, gives_the_same_bytes_at_the_same_times_with_the_same_seeds) {
  const auto times_of = [](std::uint64_t seed) {
    ManualClock clock;
    EmulatedHidBus bus(clock);
    EmulatedDeviceOptions options;
    options.link = two_on_one_adapter();
    options.seed = seed;
    bus.add(options, nothing_seen);
    const auto wiimote = bus.open(bus.path(0));
    wiimote->write(from_hex("12 04 31"));
    std::vector<Time> times;
    std::array<std::uint8_t, 64> buffer;
    while (times.size() < 300) times.push_back(wiimote->read(buffer, Time{seconds(9)}).arrival);
    return times;
  };
  EXPECT_EQ(times_of(1), times_of(1));
  EXPECT_NE(times_of(1), times_of(2));
}

TEST(EmulatedBusThreads, readers_and_whoever_breaks_their_devices_run_side_by_side) {
  MonotonicClock clock;
  EmulatedHidBus bus(clock);
  EmulatedDeviceOptions options;
  options.kernel = KernelOptions{};
  for (int i = 0; i < 3; ++i) bus.add(options, nothing_seen);
  std::array<std::size_t, 3> reports{};
  std::vector<std::jthread> readers;
  for (std::size_t i = 0; i < 3; ++i)
    readers.emplace_back([&, i](const std::stop_token& stop) {
      const auto wiimote = bus.open(bus.path(i));
      std::array<std::uint8_t, 64> buffer;
      while (!stop.stop_requested()) {
        wiimote->write(from_hex("12 04 31"));
        if (wiimote->read(buffer, clock.now() + milliseconds(20)).status == HidStatus::report)
          ++reports[i];
      }
    });
  for (int i = 0; i < 30; ++i) {
    EmulatedDevice& device = bus.device(static_cast<std::size_t>(i % 3));
    device.send_status();
    device.send_garbage(3);
    device.read_battery();
    bus.list();
    clock.sleep_until(clock.now() + milliseconds(5));
  }
  readers.clear();
  for (const std::size_t count : reports) EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace vindu
