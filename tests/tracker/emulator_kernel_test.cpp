// The model of hid-wiimote against the sequences that Debian's kernel 6.1 wrote to a played device
// (tests/kernel), and its source.
#include "tracker/wiimote/emulator_kernel.h"

#include <gmock/gmock.h>

#include "tests/tracker/emulator_host.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The kernel on a wire without delay to an emulated Wiimote.
class KernelOnAWire : public ::testing::Test {
 protected:
  /// What the kernel writes in this time; memory writes without the zeros that fill them up.
  std::vector<std::string> run(Duration time, bool plus = false) {
    if (!kernel_) kernel_.emplace(KernelOptions{.motion_plus_inside = plus}, now_);
    std::vector<std::string> written;
    for (const Time end = now_ + time; now_ < end; now_ += std::chrono::microseconds(100)) {
      while (auto write = kernel_->next(now_)) {
        Bytes shown = write->bytes;
        if (shown[0] == 0x16) shown.resize(6u + shown[5]);
        written.push_back(to_hex(shown));
        wiimote_.output(write->bytes, now_);
      }
      while (const auto report = wiimote_.next(now_))
        if (answers_) kernel_->input(report->span(), now_);
    }
    return written;
  }
  void start() { run(seconds(1)); }

  Time now_{};
  bool answers_ = true;
  WiimoteEmulator wiimote_{{}, [](Time) { return SensorView{}; }};
  std::optional<HidWiimoteKernel> kernel_;
};

TEST_F(KernelOnAWire, asks_for_the_status_lights_a_led_and_looks_into_the_ports_at_its_start) {
  EXPECT_THAT(run(seconds(1)),
              ElementsAre("15 00", "12 00 30", "11 10", "16 04 a4 00 f0 01 55",
                          "16 04 a6 00 f0 01 55", "17 04 a6 00 fa 00 06", "17 04 a4 00 fa 00 06",
                          "15 00", "15 00", "12 00 30", "12 00 30"));
  EXPECT_EQ(wiimote_.leds(), 1);
}

TEST_F(KernelOnAWire, sets_its_own_mode_after_every_status_report) {
  start();
  wiimote_.output(from_hex("12 04 33"), now_);
  wiimote_.send_status(now_);
  EXPECT_THAT(run(seconds(1)), ElementsAre("12 00 30"));
  EXPECT_EQ(wiimote_.report_mode(), 0x30);
}

TEST_F(KernelOnAWire, asks_for_the_status_when_the_battery_is_read) {
  start();
  kernel_->read_battery(now_);
  EXPECT_THAT(run(seconds(1)), ElementsAre("15 00", "12 00 30"));
}

TEST_F(KernelOnAWire, asks_for_the_status_as_often_as_the_battery_is_read_by_plan) {
  kernel_.emplace(KernelOptions{.motion_plus_inside = true, .battery_read_every = seconds(3)},
                  now_);
  start();
  EXPECT_THAT(run(seconds(6)), ElementsAre("15 00", "12 00 30", "15 00", "12 00 30"));
}

TEST_F(KernelOnAWire, looks_for_a_motion_plus_every_four_seconds) {
  start();
  const std::vector<std::string> look = {"17 04 a4 00 fa 00 06", "16 04 a6 00 f0 01 55",
                                         "17 04 a6 00 fa 00 06"};
  EXPECT_THAT(run(seconds(4)), ::testing::ElementsAreArray(look));
  EXPECT_THAT(run(seconds(4)), ::testing::ElementsAreArray(look));
}

TEST_F(KernelOnAWire, does_not_look_for_a_motion_plus_that_is_inside) {
  run(seconds(1), true);
  EXPECT_THAT(run(seconds(20), true), IsEmpty());
}

TEST_F(KernelOnAWire, rewrites_the_camera_for_who_opens_its_node_and_switches_it_off_afterwards) {
  start();
  kernel_->open_camera_node(now_);
  EXPECT_THAT(run(seconds(1)),
              ElementsAre("13 06", "1a 06", "16 04 b0 00 30 01 01",
                          "16 04 b0 00 00 09 02 00 00 71 01 00 aa 00 64", "16 04 b0 00 1a 02 63 03",
                          "16 04 b0 00 33 01 01", "16 04 b0 00 30 01 08", "12 00 36"));
  kernel_->read_battery(now_);
  EXPECT_THAT(run(milliseconds(500)), ElementsAre("15 00", "12 00 36"));
  kernel_->close_camera_node(now_);
  EXPECT_THAT(run(milliseconds(500)), ElementsAre("13 00", "1a 00", "12 00 30"));
}

TEST_F(KernelOnAWire, chooses_another_report_for_who_opens_the_accelerometer) {
  start();
  kernel_->open_accelerometer_node(now_);
  EXPECT_THAT(run(milliseconds(500)), ElementsAre("12 00 31"));
  kernel_->close_accelerometer_node(now_);
  EXPECT_THAT(run(milliseconds(500)), ElementsAre("12 00 30"));
}

TEST_F(KernelOnAWire, gives_up_a_camera_that_does_not_answer_for_a_second) {
  start();
  answers_ = false;
  kernel_->open_camera_node(now_);
  EXPECT_THAT(run(milliseconds(1500)), ElementsAre("13 06"));
}

TEST_F(KernelOnAWire, looks_into_the_ports_again_when_an_extension_is_plugged) {
  start();
  wiimote_.plug_extension(true, now_);
  EXPECT_THAT(run(seconds(1)),
              ElementsAre("12 00 30", "17 04 a4 00 fa 00 06", "16 04 a4 00 f0 01 55",
                          "16 04 a4 00 fb 01 00", "16 04 a6 00 f0 01 55", "17 04 a6 00 fa 00 06",
                          "17 04 a4 00 fa 00 06", "15 00", "12 00 30"));
}

}  // namespace
}  // namespace vindu
