// What Linux' hid-wiimote really writes to a Wiimote, and when: the facts behind the emulator's
// model of it (HidWiimoteKernel) and behind the driver's way to survive it. Runs in QEMU; see
// run.sh.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>

#include "tests/kernel/played_wiimote.h"

namespace vindu::testing {
namespace {

using ::testing::ElementsAre;

class HidWiimote : public ::testing::Test {
 protected:
  std::vector<std::string> written() { return written_to(wiimote_); }

  void wait_for_its_start() {
    ASSERT_NE(input_node("Nintendo Wii Remote IR"), "");
    written();
  }

  PlayedWiimote wiimote_;
};

TEST_F(HidWiimote, AsksForTheStatusAndLightsALedAtItsStart) {
  ASSERT_NE(input_node("Nintendo Wii Remote IR"), "");

  // In between it maps extension and Motion Plus: polls, and the writes 55 and 00 that wake one.
  EXPECT_THAT(written(), ElementsAre("15 00", "12 00 30", "11 10", "16 04 a4 00 f0 01 55", "15 00",
                                     "15 00", "12 00 30", "12 00 30"));
}

TEST_F(HidWiimote, StopsTheStreamWhenItsBatteryIsRead) {
  wait_for_its_start();

  const int percent = battery_percent();

  EXPECT_EQ(percent, 0xc0 * 100 / 255);
  EXPECT_THAT(written(), ElementsAre("15 00", "12 00 30"));
}

TEST_F(HidWiimote, RewritesTheCameraForWhoOpensItsDotsAndSwitchesItOffAfterwards) {
  wait_for_its_start();
  {
    const OpenFile dots(input_node("Nintendo Wii Remote IR"), O_RDONLY);
    ASSERT_GE(dots.number(), 0);
    EXPECT_THAT(written(), ElementsAre("13 06", "1a 06", "16 04 b0 00 30 01 01",
                                       "16 04 b0 00 00 09 02 00 00 71 01 00 aa 00 64",
                                       "16 04 b0 00 1a 02 63 03", "16 04 b0 00 33 01 01",
                                       "16 04 b0 00 30 01 08", "12 00 36"));
    battery_percent();
    EXPECT_THAT(written(), ElementsAre("15 00", "12 00 36"));
  }

  EXPECT_THAT(written(), ElementsAre("13 00", "1a 00", "12 00 30"));
}

TEST_F(HidWiimote, ChoosesAnotherReportForWhoOpensTheAccelerometer) {
  wait_for_its_start();
  {
    const OpenFile accelerometer(input_node("Nintendo Wii Remote Accelerometer"), O_RDONLY);
    EXPECT_THAT(written(), ElementsAre("12 00 31"));
  }

  EXPECT_THAT(written(), ElementsAre("12 00 30"));
}

TEST_F(HidWiimote, LetsOthersReadAndWriteBesideIt) {
  wait_for_its_start();
  const OpenFile raw("/dev/hidraw0", O_RDWR);

  const std::uint8_t stream[] = {0x12, 0x04, 0x33};
  ASSERT_EQ(::write(raw.number(), stream, sizeof(stream)), 3);

  EXPECT_THAT(written(), ElementsAre("12 04 33"));
  Bytes report(64);
  report.resize(static_cast<std::size_t>(::read(raw.number(), report.data(), report.size())));
  EXPECT_EQ(report.size(), 18u);
}

TEST_F(HidWiimote, ARequestForAReportIsRefusedAtOnce) {
  wait_for_its_start();
  const OpenFile raw("/dev/hidraw0", O_RDWR);
  Bytes report = {0x20, 0, 0, 0, 0, 0, 0};

  const int result = ::ioctl(raw.number(), HIDIOCGINPUT(7), report.data());

  EXPECT_EQ(result, -1);
  EXPECT_EQ(errno, EIO);
}

}  // namespace
}  // namespace vindu::testing
