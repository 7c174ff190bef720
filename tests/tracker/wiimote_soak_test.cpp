// A day of streaming in accelerated time: the driver on an emulated Wiimote beside an emulated
// hid-wiimote, with a fault every second. Outside recoveries no dot is missed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "core/random.h"
#include "tracker/wiimote/emulator_bus.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kCycle = 4000;  // steps until the walking dot is back
constexpr Duration kBroken = milliseconds(400), kGarbage = milliseconds(50);
/// The longest time without a dot, beside that of the fault itself: with all answers, and while
/// half of the acknowledgements are lost, of which starting the camera takes eight in a row.
constexpr Duration kRecovery = milliseconds(300), kHardRecovery = seconds(10);
constexpr int kSettled = 10;  // so many dots without a hole: it has recovered

// The address sanitizer keeps what was freed for a while: 256 MiB.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kGrowth_bytes = std::size_t{512} << 20;
#else
constexpr std::size_t kGrowth_bytes = std::size_t{16} << 20;
#endif

/// A dot that walks over the sensor, in whole units, so that it is known exactly when it was seen.
/// 800 and 500 have kCycle in common.
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

/// Which step of the walk a dot shows; empty when it is none.
std::optional<int> step_of(const Dot& dot) {
  const int x = static_cast<int>(dot.x_px) - 100, y = static_cast<int>(dot.y_px) - 100;
  for (int step = x; step < kCycle; step += 800)
    if (step % 500 == y) return step;
  return std::nullopt;
}

/// What went over the link that may stop dots, seen below the driver.
struct Overheard {
  std::uint8_t wanted = 0;  ///< the data report that carries dots
  int reads = 0;            ///< answers to reads: each takes the place of a data report
  bool disturbed = false;   ///< a status, another data report, an obeyed command
};

class OverhearingDevice final : public HidDevice {
 public:
  OverhearingDevice(std::unique_ptr<HidDevice> device, Overheard& overheard)
      : device_(std::move(device)), overheard_(overheard) {}

  HidRead read(std::span<std::uint8_t> buffer, Time until) override {
    const HidRead read = device_->read(buffer, until);
    if (read.status != HidStatus::report) return read;
    const bool other_data = buffer[0] >= 0x30 && buffer[0] / 2 != overheard_.wanted / 2;
    const bool obeyed = buffer[0] == 0x22 && buffer[4] == 0;
    overheard_.reads += buffer[0] == 0x21;
    overheard_.disturbed |= buffer[0] == 0x20 || other_data || obeyed;
    return read;
  }
  bool write(std::span<const std::uint8_t> report) override {
    // The driver has found the camera changed, and starts it.
    overheard_.disturbed |= report[0] == 0x13 || report[0] == 0x16;
    return device_->write(report);
  }

 private:
  std::unique_ptr<HidDevice> device_;
  Overheard& overheard_;
};

/// A device with its faults, and the driver on it.
class Soak {
 public:
  explicit Soak(IrFormat format)
      : period_steps_(format == IrFormat::full ? 2 : 1),
        device_(bus_.add({.info = {}, .firmware = {}, .link = {}, .kernel = KernelOptions{}},
                         walking_dot)),
        overheard_{.wanted = data_report_id(format)} {
    reader_.emplace(open(), 0, WiimoteSettings{.format = format});
  }

  void break_something() {
    const std::size_t which = static_cast<std::size_t>(
        random_.uniform(0, 0.999 * static_cast<double>(std::size(kFaults))));
    fault_ = &kFaults[which];
    settled_ = 0;
    fault_->act(*this);
  }

  /// The dots of the time up to `end`, as they come.
  void run_until(Time end) {
    while (clock_.now() < end) {
      clock_.sleep_until(std::min(end, clock_.now() + milliseconds(5)));
      while (const auto observation = reader_->next(clock_.now())) take(*observation);
      if (reader_->gone() && device_.connected()) reader_->reconnect(open(), clock_.now());
    }
  }
  void run(Duration length) { run_until(clock_.now() + length); }
  void mend() {
    if (std::exchange(silent_, false)) device_.stay_silent(false);
    if (std::exchange(away_, false)) device_.plug_in();
  }
  void heal() {
    bring_acknowledgements_back();
    mend();
  }

  Time now() const { return clock_.now(); }
  const WiimoteReader& reader() const { return *reader_; }
  int dots() const { return dots_; }
  int wrong() const { return wrong_; }
  int missed() const { return missed_; }
  int settled() const { return settled_; }
  /// What was longer without a dot than its fault explains.
  const std::vector<std::string>& too_long() const { return too_long_; }

 private:
  struct Fault {
    const char* name;
    Duration hole;  ///< as long as it lasts
    void (*act)(Soak& soak);
  };
  static const Fault kFaults[10];

  std::unique_ptr<HidDevice> open() {
    return std::make_unique<OverhearingDevice>(bus_.open(bus_.path(0)), overheard_);
  }
  void send_garbage() {
    device_.send_garbage(3);
    garbage_until_ = now() + kGarbage;
  }
  void lose_acknowledgements() {
    device_.lose_acknowledgements(0.5);
    acknowledges_ = false;
    lossy_ = true;
  }
  void bring_acknowledgements_back() {
    device_.lose_acknowledgements(0);
    acknowledges_ = true;
  }
  void take(const Observation& observation) {
    if (observation.arrival < garbage_until_) return;  // random bytes may be dots
    if (observation.dots.size() > 1) ++wrong_;
    if (observation.dots.size() != 1) return;
    const auto step = step_of(observation.dots[0]);
    if (!step) ++wrong_;
    if (dots_++ && step) compare(*step, observation.arrival - last_);
    last_ = observation.arrival;
    last_step_ = step.value_or(0);
  }
  void compare(int step, Duration gap) {
    const int advance = (step - last_step_ + kCycle) % kCycle;
    const int reads = std::exchange(overheard_.reads, 0);
    const bool next = advance <= period_steps_ * (1 + reads + std::exchange(reads_before_, reads));
    if (std::exchange(overheard_.disturbed, false)) settled_ = 0;
    if (settled_ >= kSettled && !next) ++missed_;
    settled_ = next ? settled_ + 1 : 0;
    judge(gap);
  }
  void judge(Duration gap) {
    const Duration recovery = std::exchange(lossy_, !acknowledges_) ? kHardRecovery : kRecovery;
    if (gap <= (fault_ ? fault_->hole : Duration{}) + recovery) return;
    too_long_.emplace_back(fault_ ? fault_->name : "no fault");
    too_long_.back() += ": " + std::to_string(gap / milliseconds(1)) + " ms";
  }

  int period_steps_;
  ManualClock clock_;
  EmulatedHidBus bus_{clock_};
  EmulatedDevice& device_;
  Overheard overheard_;
  std::optional<WiimoteReader> reader_;
  Random random_{5};
  const Fault* fault_ = nullptr;
  bool plugged_ = false, silent_ = false, away_ = false;
  bool acknowledges_ = true, lossy_ = false;  // now; at any time since the last dot
  int dots_ = 0, wrong_ = 0, missed_ = 0, settled_ = 0;
  int reads_before_ = 0;  // the last dot: the second half of a sample may have made room for them
  std::vector<std::string> too_long_;
  Time last_{};
  int last_step_ = 0;
  Time garbage_until_{};
};

const Soak::Fault Soak::kFaults[] = {
    {"status", {}, [](Soak& soak) { soak.device_.send_status(); }},
    {"battery read", {}, [](Soak& soak) { soak.device_.read_battery(); }},
    {"camera opened", {}, [](Soak& soak) { soak.device_.open_camera_node(); }},
    {"camera closed", {}, [](Soak& soak) { soak.device_.close_camera_node(); }},
    {"extension", {}, [](Soak& soak) { soak.device_.plug_extension(soak.plugged_ ^= true); }},
    {"garbage", kGarbage, [](Soak& soak) { soak.send_garbage(); }},
    {"acknowledgements lost", {}, [](Soak& soak) { soak.lose_acknowledgements(); }},
    {"acknowledgements back", {}, [](Soak& soak) { soak.bring_acknowledgements_back(); }},
    {"silence", kBroken, [](Soak& soak) { soak.device_.stay_silent(soak.silent_ = true); }},
    {"unplugged", kBroken, [](Soak& soak) { soak.device_.unplug(), soak.away_ = true; }},
};

void soak_for(Soak& soak, Duration length) {
  soak.run(seconds(3));
  for (const Time end = soak.now() + length; soak.now() < end;) {
    soak.break_something();
    soak.run(kBroken);
    soak.mend();
    soak.run(seconds(1) - kBroken);
  }
  soak.heal();
  soak.run(seconds(30));
  EXPECT_EQ(soak.wrong(), 0);
  EXPECT_EQ(soak.missed(), 0) << "outside of recoveries";
  EXPECT_GT(soak.settled(), 400) << "the last seconds are without faults";
  EXPECT_THAT(soak.too_long(), ::testing::IsEmpty());
  EXPECT_EQ(soak.reader().session().health().trouble, "");
  EXPECT_GT(soak.dots(), vindu::seconds(length) * 30);
}

TEST(WiimoteSoak, ComesThroughAFaultEverySecondOfADayAndRecoversFromEachOfThem) {
  Soak soak(IrFormat::extended);
  soak.run(seconds(3));
  const std::size_t memory_before = resident_bytes();
  soak_for(soak, std::chrono::hours(24));
  EXPECT_LT(resident_bytes(), memory_before + kGrowth_bytes);
}

TEST(WiimoteSoak, ComesThroughTheSameInTheFullFormat) {
  Soak soak(IrFormat::full);
  soak_for(soak, std::chrono::hours(2));
}

}  // namespace
}  // namespace vindu
