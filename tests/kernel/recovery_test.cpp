// The driver over hidraw against Linux' hid-wiimote, which resets the device and the camera behind
// its back: after each disturbance the stream of true dots must come back by itself. Prints how
// long that took. Runs in QEMU; see run.sh.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include "tests/kernel/played_wiimote.h"
#include "tracker/wiimote/find.h"
#include "tracker/wiimote/hidapi_bus.h"
#include "tracker/wiimote/live.h"

namespace vindu::testing {
namespace {

using namespace std::chrono_literals;

/// After a disturbance the stream is watched so long at least: what the kernel does takes a while.
constexpr Duration kWatch = 800ms;
constexpr Duration kGiveUp = 15s;
constexpr int kSteady = 20;

enum class Seen { all, some, false_dot };

/// All four spots, some of them, or something that is not there.
Seen judge(const DotList& dots) {
  for (const Dot& dot : dots)
    if (std::ranges::find(kDotRows_px, dot.y_px) == std::end(kDotRows_px) ||
        dot.x_px != dots[0].x_px)
      return Seen::false_dot;
  return dots.size() == std::size(kDotRows_px) ? Seen::all : Seen::some;
}

struct Figures {
  int disturbances = 0;
  int recovered = 0;
  Duration worst_gap{};
};

class Driver : public ::testing::TestWithParam<std::uint16_t> {
 protected:
  void SetUp() override { wiimote_.emplace(GetParam()); }

  /// The longest time without true dots until they are steady again; empty when they never are.
  std::optional<Duration> recover() {
    const Time begin = clock_.now();
    Duration worst{};
    for (int steady = 0; clock_.now() < begin + kGiveUp; clock_.sleep_until(clock_.now() + 5ms)) {
      while (const auto seen = driver_.next(clock_.now())) {
        ++observations_;
        const Seen judged = judge(seen->dots);
        false_dots_ += judged == Seen::false_dot;
        steady = judged == Seen::all ? steady + 1 : 0;
        if (steady == 0) continue;
        if (last_) worst = std::max(worst, Duration(seen->arrival - *last_));
        last_ = seen->arrival;
        if (steady >= kSteady && seen->arrival > begin + kWatch) return worst;
      }
    }
    return std::nullopt;
  }

  /// The kernel asks for single reports, the driver for a stream.
  bool kernel_chose_a_report() {
    return std::ranges::any_of(wiimote_->take_outputs(), [](const Bytes& report) {
      return report[0] == 0x12 && (report[1] & 0x04) == 0;
    });
  }

  void disturb(const std::string& how, const std::function<void()>& act) {
    Figures& figures = figures_[how];
    wiimote_->take_outputs();
    act();
    const auto gap = recover();
    ++figures.disturbances;
    EXPECT_TRUE(kernel_chose_a_report()) << how << ": nothing was disturbed";
    EXPECT_TRUE(gap) << how << ": no steady stream; " << driver_.state().trouble;
    if (!gap) return;
    ++figures.recovered;
    figures.worst_gap = std::max(figures.worst_gap, *gap);
  }

  void disturb_in_every_way() {
    disturb("battery read", [] { EXPECT_GE(battery_percent(), 0); });
    disturb("dots opened", [this] { open_.emplace(input_node(name(" IR")), O_RDONLY); });
    disturb("battery read, dots open", [] { EXPECT_GE(battery_percent(), 0); });
    disturb("dots closed", [this] { open_.reset(); });
    disturb("battery read", [] { EXPECT_GE(battery_percent(), 0); });
    disturb("accelerometer opened",
            [this] { open_.emplace(input_node(name(" Accelerometer")), O_RDONLY); });
    disturb("accelerometer closed", [this] { open_.reset(); });
    disturb("extension plugged", [this] { wiimote_->plug_extension(true); });
    disturb("battery read", [] { EXPECT_GE(battery_percent(), 0); });
    disturb("extension unplugged", [this] { wiimote_->plug_extension(false); });
    disturb("dots opened and closed", [] { OpenFile(input_node(name(" IR")), O_RDONLY); });
    disturb("unplugged, plugged", [this] {
      wiimote_.reset();
      clock_.sleep_until(clock_.now() + 300ms);
      wiimote_.emplace(GetParam());
    });
  }

  static LiveWiimoteOptions driver_options() {
    LiveWiimoteOptions options;
    options.name = "camera";
    options.address = kAddress;
    return options;
  }

  static std::string name(const std::string& part) { return "Nintendo Wii Remote" + part; }

  void print() const {
    fmt::print("{:26} {:>6} {:>9} {:>12}\n", "disturbance", "times", "recovered", "worst gap ms");
    for (const auto& [how, figures] : figures_)
      fmt::print("{:26} {:6} {:9} {:12.0f}\n", how, figures.disturbances, figures.recovered,
                 milliseconds(figures.worst_gap));
    fmt::print("{} observations; gaps as the driver counts them:", observations_);
    const GapCounts gaps = driver_.state().health.gaps;
    for (std::size_t cause = 0; cause < kGapCauses; ++cause)
      fmt::print(" {} {} (longest {:.0f} ms)", name_of(static_cast<GapCause>(cause)),
                 gaps[cause].gaps, milliseconds(gaps[cause].longest));
    fmt::print("\n");
  }

  MonotonicClock clock_;
  std::optional<PlayedWiimote> wiimote_;
  std::unique_ptr<HidBus> bus_ = make_hidapi_bus(clock_);
  WiimoteClaims claims_;
  LiveWiimote driver_{*bus_, clock_, claims_, driver_options()};
  std::optional<OpenFile> open_;
  std::optional<Time> last_;
  std::map<std::string, Figures> figures_;
  std::uint64_t observations_ = 0;
  int false_dots_ = 0;
};

TEST_P(Driver, FindsItAndSeesItsDots) {
  ASSERT_TRUE(recover());

  const LiveWiimoteState state = driver_.state();
  EXPECT_TRUE(state.connected);
  EXPECT_EQ(state.device.address, kAddress);
  EXPECT_EQ(kind_of(state.device), GetParam() == 0x0330 ? WiimoteKind::tr : WiimoteKind::classic);
  EXPECT_EQ(find_wiimotes(*bus_).size(), 1u);
  EXPECT_EQ(false_dots_, 0);
}

TEST_P(Driver, BringsTheDotsBackAfterEveryDisturbance) {
  ASSERT_TRUE(recover());
  const int rounds = GetParam() == 0x0306 ? 5 : 1;

  for (int round = 0; round < rounds; ++round) disturb_in_every_way();

  print();
  int recovered = 0;
  for (const auto& [how, figures] : figures_) recovered += figures.recovered;
  fmt::print("recovered {} of {}\n", recovered, 12 * rounds);
  EXPECT_EQ(recovered, 12 * rounds);
  EXPECT_EQ(false_dots_, 0);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, Driver, ::testing::Values(0x0306, 0x0330));

}  // namespace
}  // namespace vindu::testing
