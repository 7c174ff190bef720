// The emulator's model of hid-wiimote against hid-wiimote itself: the same happens to both, and
// they write the same. Runs in QEMU; see run.sh.
#include <fcntl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "tests/kernel/played_wiimote.h"
#include "tracker/wiimote/emulator_kernel.h"

namespace vindu::testing {
namespace {

using namespace std::chrono_literals;

/// Such a Wiimote with the model beside it, in a time of its own.
class Modelled {
 public:
  explicit Modelled(std::uint16_t product_id)
      : wiimote_(PlayedWiimote::options(product_id), four_spots),
        now_(MonotonicClock().now()),
        kernel_({.motion_plus_inside = product_id == 0x0330}, now_) {}

  /// What the model writes within a second, but for its polls.
  std::vector<std::string> written() {
    const Time until = now_ + 1s;
    for (; now_ <= until; now_ = std::min(kernel_.next_event(), wiimote_.next_event())) {
      while (const auto write = kernel_.next(now_)) {
        if (!is_motion_plus_poll(hex({write->bytes.begin(), write->bytes.end()})))
          reports_.push_back(hex({write->bytes.begin(), write->bytes.end()}));
        wiimote_.output(write->bytes, write->at);
      }
      while (const auto report = wiimote_.next(now_)) kernel_.input(report->span(), report->at);
    }
    now_ = until;
    return std::exchange(reports_, {});
  }

  HidWiimoteKernel& kernel() { return kernel_; }
  WiimoteEmulator& wiimote() { return wiimote_; }
  Time now() const { return now_; }

 private:
  WiimoteEmulator wiimote_;
  Time now_;
  HidWiimoteKernel kernel_;
  std::vector<std::string> reports_;
};

class KernelModel : public ::testing::TestWithParam<std::uint16_t> {
 protected:
  void SetUp() override {
    ASSERT_NE(input_node("Nintendo Wii Remote IR"), "");
    real_at_start_ = written_to(real_);
    model_at_start_ = model_.written();
  }

  void expect_same(const std::string& after) {
    const auto real = written_to(real_);
    EXPECT_FALSE(real.empty()) << "after " << after;
    EXPECT_EQ(model_.written(), real) << "after " << after;
  }

  PlayedWiimote real_{GetParam()};
  Modelled model_{GetParam()};
  std::vector<std::string> real_at_start_, model_at_start_;
};

TEST_P(KernelModel, WritesWhatTheKernelWritesAtItsStart) {
  EXPECT_EQ(model_at_start_, real_at_start_);
}

TEST_P(KernelModel, WritesWhatTheKernelWritesForItsUsers) {
  model_.kernel().read_battery(model_.now());
  battery_percent();
  expect_same("the battery was read");

  model_.kernel().open_camera_node(model_.now());
  std::optional<OpenFile> dots(std::in_place, input_node("Nintendo Wii Remote IR"), O_RDONLY);
  expect_same("the dots were opened");

  model_.kernel().open_accelerometer_node(model_.now());
  std::optional<OpenFile> accelerometer(std::in_place,
                                        input_node("Nintendo Wii Remote Accelerometer"), O_RDONLY);
  expect_same("the accelerometer was opened too");

  model_.kernel().close_camera_node(model_.now());
  dots.reset();
  expect_same("the dots were closed");

  model_.kernel().close_accelerometer_node(model_.now());
  accelerometer.reset();
  expect_same("the accelerometer was closed");
}

TEST_P(KernelModel, WritesWhatTheKernelWritesForAnExtension) {
  for (const bool plugged : {true, false}) {
    model_.wiimote().plug_extension(plugged, model_.now());
    real_.plug_extension(plugged);
    expect_same(plugged ? "an extension was plugged" : "it was unplugged");
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, KernelModel, ::testing::Values(0x0306, 0x0330));

}  // namespace
}  // namespace vindu::testing
