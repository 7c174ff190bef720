// A day of streaming in accelerated time: the driver on an emulated Wiimote beside an emulated
// hid-wiimote, with a fault every second.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "core/random.h"
#include "tracker/wiimote/emulator_bus.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kDay = std::chrono::hours(24);

// The address sanitizer keeps what was freed for a while: 256 MiB.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kGrowth_bytes = std::size_t{512} << 20;
#else
constexpr std::size_t kGrowth_bytes = std::size_t{16} << 20;
#endif

/// A dot that walks over the sensor, in whole units, so that it is known exactly when it was seen.
SensorView walking_dot(Time now) {
  const auto step = now.time_since_epoch() / milliseconds(10);
  SensorView view;
  view.spots = {{.x_px = static_cast<double>(100 + step % 800),
                 .y_px = static_cast<double>(100 + step % 500),
                 .brightness = 0.1}};
  return view;
}

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * 4096;
}

/// A device with its faults, and the driver on it.
class Soak {
 public:
  Soak()
      : device_(bus_.add({.info = {}, .firmware = {}, .link = {}, .kernel = KernelOptions{}},
                         walking_dot)) {
    reader_.emplace(bus_.open(bus_.path(0)), 0);
  }

  void break_something() {
    const std::function<void()> faults[] = {
        [&] { device_.send_status(); },
        [&] { device_.read_battery(); },
        [&] { device_.open_camera_node(); },
        [&] { device_.close_camera_node(); },
        [&] { device_.plug_extension(plugged_ = !plugged_); },
        [&] { device_.send_garbage(3), garbage_until_ = now() + milliseconds(50); },
        [&] { device_.lose_acknowledgements(0.5); },
        [&] { device_.lose_acknowledgements(0); },
        [&] { device_.stay_silent(true), silent_ = true; },
        [&] { device_.unplug(), away_ = true; },
    };
    faults[static_cast<std::size_t>(random_.uniform(0, 0.999 * std::size(faults)))]();
  }

  /// The dots of the time up to `end`, as they come.
  void run_until(Time end) {
    while (clock_.now() < end) {
      clock_.sleep_until(std::min(end, clock_.now() + milliseconds(5)));
      while (const auto observation = reader_->next(clock_.now())) take(*observation);
      if (reader_->gone() && device_.connected())
        reader_->reconnect(bus_.open(bus_.path(0)), clock_.now());
    }
  }
  void mend() {
    if (std::exchange(silent_, false)) device_.stay_silent(false);
    if (std::exchange(away_, false)) device_.plug_in();
  }
  void heal() {
    device_.lose_acknowledgements(0);
    mend();
  }

  Time now() const { return clock_.now(); }
  const WiimoteReader& reader() const { return *reader_; }
  int dots() const { return dots_; }
  int wrong() const { return wrong_; }
  /// The longest time without the dot, since the last call.
  Duration take_longest() { return std::exchange(longest_, Duration{}); }

 private:
  void take(const Observation& observation) {
    if (observation.arrival < garbage_until_) return;  // random bytes may be dots
    if (observation.dots.size() > 1) ++wrong_;
    if (observation.dots.size() != 1) return;
    const Dot& dot = observation.dots[0];
    if (std::fmod(dot.y_px - dot.x_px + 800, 100) != 0) ++wrong_;  // both walk in the same steps
    if (dots_++) longest_ = std::max(longest_, observation.arrival - last_);
    last_ = observation.arrival;
  }

  ManualClock clock_;
  EmulatedHidBus bus_{clock_};
  EmulatedDevice& device_;
  std::optional<WiimoteReader> reader_;
  Random random_{5};
  bool plugged_ = false, silent_ = false, away_ = false;
  int dots_ = 0, wrong_ = 0;
  Duration longest_{};
  Time last_{};
  Time garbage_until_{};
};

TEST(WiimoteSoak, ComesThroughAFaultEverySecondAndRecoversFromEachOfThem) {
  Soak soak;
  soak.run_until(soak.now() + seconds(3));
  const std::size_t memory_before = resident_bytes();
  const Time end = soak.now() + kDay;
  while (soak.now() < end) {
    soak.break_something();
    soak.run_until(soak.now() + milliseconds(400));
    soak.mend();
    soak.run_until(soak.now() + milliseconds(600));
  }
  soak.heal();
  soak.run_until(soak.now() + seconds(15));
  soak.take_longest();
  soak.run_until(soak.now() + seconds(15));
  EXPECT_LE(soak.take_longest(), milliseconds(40)) << "the last seconds are without faults";
  EXPECT_EQ(soak.wrong(), 0);
  EXPECT_EQ(soak.reader().session().health().trouble, "");
  EXPECT_GT(soak.dots(), vindu::seconds(kDay) * 30);
  EXPECT_LT(resident_bytes(), memory_before + kGrowth_bytes);
}

}  // namespace
}  // namespace vindu
