// Wiimotes with threads of their own, on emulated devices in real time: found, lost, found again,
// shared out among cameras.
#include "tracker/wiimote/live.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "tracker/wiimote/emulator_bus.h"
#include "tracker/wiimote/find.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// A dot whose column tells the device.
WiimoteEmulator::Look dot_at(double x_px) {
  return [x_px](Time) {
    SensorView view;
    view.spots = {{.x_px = x_px, .y_px = 300, .brightness = 0.1}};
    return view;
  };
}

/// A device whose data reports lack their end.
class ShortReports final : public HidDevice {
 public:
  explicit ShortReports(std::unique_ptr<HidDevice> device) : device_(std::move(device)) {}

  HidRead read(std::span<std::uint8_t> buffer, Time until) override {
    HidRead read = device_->read(buffer, until);
    if (read.status == HidStatus::report && buffer[0] >= 0x30)
      read.size = std::min<std::size_t>(read.size, 12);
    return read;
  }
  bool write(std::span<const std::uint8_t> report) override { return device_->write(report); }

 private:
  std::unique_ptr<HidDevice> device_;
};

/// Ten times as fast as this machine's.
class FastClock final : public Clock {
 public:
  Time now() const override { return begin_ + 10 * (MonotonicClock().now() - begin_); }
  void sleep_until(Time time) override {
    MonotonicClock().sleep_until(begin_ + (time - begin_) / 10);
  }

 private:
  Time begin_ = MonotonicClock().now();
};

const GapCount& gaps(const LiveWiimoteState& state, GapCause cause) {
  return state.health.gaps[static_cast<std::size_t>(cause)];
}

class LiveWiimoteTest : public ::testing::Test {
 protected:
  EmulatedDevice& add(double x_px, EmulatedDeviceOptions options = {}) {
    return bus_.add(std::move(options), dot_at(x_px));
  }
  LiveWiimoteOptions named(const std::string& name, const std::string& address = {}) {
    return {.camera = 0,
            .name = name,
            .address = address,
            .path = {},
            .settings = {},
            .on_sample = {},
            .tap = {}};
  }
  /// Waits until it holds; a test that waits for ten seconds has failed.
  bool eventually(const std::function<bool()>& holds) {
    for (int i = 0; i < 2000; ++i) {
      if (holds()) return true;
      clock_.sleep_until(clock_.now() + milliseconds(5));
    }
    return false;
  }
  /// The column of the first dot that comes.
  std::optional<double> dot_of(LiveWiimote& wiimote) {
    std::optional<double> x_px;
    eventually([&] {
      while (const auto observation = wiimote.next(clock_.now()))
        if (!observation->dots.empty()) x_px = observation->dots[0].x_px;
      return x_px.has_value();
    });
    return x_px;
  }

  MonotonicClock clock_;
  EmulatedHidBus bus_{clock_};
  WiimoteClaims claims_;
};

TEST_F(LiveWiimoteTest, GivesEveryCameraADeviceOfItsOwn) {
  add(100), add(200);
  LiveWiimote left(bus_, clock_, claims_, named("left")),
      right(bus_, clock_, claims_, named("right"));
  const auto a = dot_of(left), b = dot_of(right);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(*a + *b, 300);
  EXPECT_FALSE(left.gone());
}

TEST_F(LiveWiimoteTest, TakesTheDeviceOfItsAddressAlone) {
  add(100);
  const std::string wanted = add(200).options().info.address;
  LiveWiimote right(bus_, clock_, claims_, named("right", wanted));
  EXPECT_EQ(dot_of(right), 200);
  EXPECT_EQ(right.state().device.address, wanted);
}

TEST_F(LiveWiimoteTest, WaitsForADeviceThatWentAwayAndGoesOnWithIt) {
  EmulatedDevice& device = add(100);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  ASSERT_TRUE(dot_of(left));
  device.unplug();
  ASSERT_TRUE(eventually([&] { return left.gone(); }));
  EXPECT_TRUE(eventually([&] { return !left.state().trouble.empty(); }));
  EXPECT_THAT(left.state().trouble, HasSubstr("is not connected: press a button"));
  while (left.next(clock_.now())) continue;
  device.plug_in();
  EXPECT_EQ(dot_of(left), 100);
  ASSERT_TRUE(eventually([&] { return gaps(left.state(), GapCause::absent).gaps == 1; }));
}

TEST_F(LiveWiimoteTest, KeepsADeviceThatIsSilentAndOpensItAnew) {
  FastClock clock;
  EmulatedHidBus bus(clock);
  EmulatedDevice& device = bus.add({}, dot_at(100));
  std::atomic<int> opened = 0;
  LiveWiimoteOptions options = named("left");
  options.tap = [&](std::unique_ptr<HidDevice> handle) { return ++opened, std::move(handle); };
  LiveWiimote left(bus, clock, claims_, options);
  ASSERT_TRUE(dot_of(left));
  device.stay_silent(true);
  bool gone = false;
  EXPECT_TRUE(eventually([&] { return gone = gone || left.gone(), opened > 2; }));
  EXPECT_FALSE(gone);
  EXPECT_THAT(trouble_text(left.state()), ContainsRegex("silent: press.*[0-9]+ s without"));
  device.stay_silent(false);
  EXPECT_TRUE(eventually([&] { return left.state().trouble.empty(); }));
  EXPECT_EQ(gaps(left.state(), GapCause::silence).gaps, 1u);
  EXPECT_EQ(gaps(left.state(), GapCause::absent).gaps, 0u);
}

TEST_F(LiveWiimoteTest, KeepsADeviceWhoseReportsAreTooShortAndSaysSo) {
  FastClock clock;
  EmulatedHidBus bus(clock);
  const std::string address = bus.add({}, dot_at(100)).options().info.address;
  for (const std::string& wanted : {address, std::string()}) {  // known, or the first that is there
    std::atomic<int> opened = 0;
    LiveWiimoteOptions options = named("left", wanted);
    options.tap = [&](std::unique_ptr<HidDevice> handle) {
      return ++opened, std::make_unique<ShortReports>(std::move(handle));
    };
    LiveWiimote left(bus, clock, claims_, options);
    const auto too_short = [&] {
      return left.state().trouble.find("too short") != std::string::npos;
    };
    EXPECT_TRUE(eventually(too_short));
    const Time begin = clock.now();
    EXPECT_TRUE(eventually([&] { return clock.now() - begin > seconds(12); }));
    EXPECT_TRUE(too_short());
    EXPECT_FALSE(left.gone());
    EXPECT_EQ(opened == 1, wanted == address);
  }
}

TEST_F(LiveWiimoteTest, SaysThatADeviceWentAwayWithEmptyBatteries) {
  EmulatedDeviceOptions nearly_empty;
  nearly_empty.firmware.battery = 0x18;
  EmulatedDevice& device = add(100, nearly_empty);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  ASSERT_TRUE(dot_of(left));
  device.set_battery(0);
  ASSERT_TRUE(eventually([&] { return left.gone(); }));
  EXPECT_THAT(left.state().trouble, HasSubstr("went away with empty batteries"));
  EXPECT_TRUE(eventually([&] { return gaps(left.state(), GapCause::battery).gaps == 1; }));
}

TEST_F(LiveWiimoteTest, SaysWhatHindersItAndKeepsTrying) {
  EmulatedDeviceOptions forbidden;
  forbidden.permitted = false;
  add(100, forbidden);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  EXPECT_TRUE(eventually([&] { return !left.state().trouble.empty(); }));
  EXPECT_THAT(left.state().trouble, HasSubstr("udev"));
}

TEST_F(LiveWiimoteTest, WarnsOfEmptyBatteries) {
  EmulatedDeviceOptions nearly_empty;
  nearly_empty.firmware.battery = 0x18;
  add(100, nearly_empty);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  EXPECT_TRUE(eventually([&] { return !left.state().trouble.empty(); }));
  EXPECT_THAT(left.state().trouble, HasSubstr("batteries"));
}

TEST_F(LiveWiimoteTest, SkipsTheEmptySlotsOfAnAdapterAndOtherControllers) {
  bus_.add_strangers();
  bus_.add_dolphin_bar({dot_at(100)});
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  EXPECT_EQ(dot_of(left), 100);
}

TEST_F(LiveWiimoteTest, PassesByEmptySlotsThatComeFirst) {
  bus_.add_dolphin_bar({});
  add(200);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  EXPECT_EQ(dot_of(left), 200);
}

TEST_F(LiveWiimoteTest, StaysWithItsDeviceWhenTheyComeBackInAnotherOrder) {
  EmulatedDevice& first = add(100);
  EmulatedDevice& second = add(200);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  ASSERT_EQ(dot_of(left), 100);
  LiveWiimote right(bus_, clock_, claims_, named("right"));
  ASSERT_EQ(dot_of(right), 200);
  first.unplug(), second.unplug();
  ASSERT_TRUE(eventually([&] { return left.gone() && right.gone(); }));
  for (LiveWiimote* wiimote : {&left, &right})
    while (wiimote->next(clock_.now())) continue;
  second.plug_in();
  ASSERT_EQ(dot_of(right), 200);
  first.plug_in();
  EXPECT_EQ(dot_of(left), 100);
}

TEST_F(LiveWiimoteTest, TakesTheSlotOfItsPathAlone) {
  bus_.add_dolphin_bar({dot_at(100), dot_at(200)});
  LiveWiimoteOptions second = named("right");
  second.path = bus_.path(1);
  LiveWiimote right(bus_, clock_, claims_, second);
  EXPECT_EQ(dot_of(right), 200);
}

TEST_F(LiveWiimoteTest, StaysWithItsSlotWhenTheWiimotesOfAnAdapterComeBackInAnotherOrder) {
  bus_.add_dolphin_bar({dot_at(100), dot_at(200)});
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  ASSERT_EQ(dot_of(left), 100);
  LiveWiimote right(bus_, clock_, claims_, named("right"));
  ASSERT_EQ(dot_of(right), 200);
  bus_.device(0).unplug(), bus_.device(1).unplug();
  ASSERT_TRUE(eventually([&] { return left.gone() && right.gone(); }));
  for (LiveWiimote* wiimote : {&left, &right})
    while (wiimote->next(clock_.now())) continue;
  bus_.device(1).plug_in();
  ASSERT_EQ(dot_of(right), 200);
  EXPECT_TRUE(left.gone());
  EXPECT_THAT(left.state().trouble, HasSubstr("/dev/hidraw0 is not connected: press a button"));
  bus_.device(0).plug_in();
  EXPECT_EQ(dot_of(left), 100);
}

TEST_F(LiveWiimoteTest, CountsWhatNobodyTookAndKeepsTheNewest) {
  EmulatedDeviceOptions fast;
  fast.firmware.report_period = milliseconds(1);
  add(100, fast);
  LiveWiimote left(bus_, clock_, claims_, named("left"));
  ASSERT_TRUE(eventually([&] { return left.state().dropped > 10; }));
  const auto oldest = left.next(clock_.now());
  ASSERT_TRUE(oldest);
  EXPECT_LT(clock_.now() - oldest->arrival, seconds(5));
}

TEST_F(LiveWiimoteTest, EndsWhileItWaits) {
  { const LiveWiimote none(bus_, clock_, claims_, named("none")); }
  add(100);
  { const LiveWiimote starting(bus_, clock_, claims_, named("starting")); }
  EXPECT_TRUE(claims_.claim(bus_.path(0)));  // it was given back
}

TEST(FindWiimotes, KnowsThemByIdOrNameAndLeavesOthers) {
  const auto info = [](int product, const char* name, const char* address) {
    return HidInfo{"/dev/hidraw0", 0x057e, static_cast<std::uint16_t>(product), name, address};
  };
  EXPECT_EQ(kind_of(info(0x0306, "Nintendo RVL-CNT-01", "00:1f")), WiimoteKind::classic);
  EXPECT_EQ(kind_of(info(0x0330, "Nintendo RVL-CNT-01-TR", "00:1f")), WiimoteKind::tr);
  EXPECT_EQ(kind_of(info(0x9999, "Nintendo RVL-CNT-01", "00:1f")), WiimoteKind::classic);
  EXPECT_EQ(kind_of(info(0x0330, "", "00:1f:c5:1b:3a:b1")), WiimoteKind::tr);
  EXPECT_EQ(kind_of(info(0x0306, "Mayflash Wiimote PC Adapter", "")), WiimoteKind::adapter);
  EXPECT_EQ(kind_of(info(0x0306, "Mayflash Wiimote PC Adapter", "STI0CF7A")), WiimoteKind::adapter);
  EXPECT_EQ(kind_of(info(0x0306, "Nintendo RVL-WBC-01", "00:1f")), WiimoteKind::none);
  EXPECT_EQ(kind_of(info(0x0330, "Nintendo RVL-CNT-01-UC", "00:1f")), WiimoteKind::none);
  EXPECT_EQ(kind_of(info(0x2009, "Pro Controller", "00:1f")), WiimoteKind::none);
}

TEST(BatteryCharge, IsFullWhereNewBatteriesStand) {
  EXPECT_NEAR(battery_charge(0), 0, 1e-9);
  EXPECT_NEAR(battery_charge(0x68), 0.5, 1e-9);
  EXPECT_NEAR(battery_charge(0xd0), 1, 1e-9);
  EXPECT_NEAR(battery_charge(0xff), 1, 1e-9);
}

}  // namespace
}  // namespace vindu
