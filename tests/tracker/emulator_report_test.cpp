// Reports of the emulated Wiimote, byte by byte. Every expected report is worked out by hand from
// the layouts of WiiBrew; none comes from an encoder.
#include <gmock/gmock.h>

#include "tests/tracker/emulator_host.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Up and A; x 513, y 510, z 618 of 10 bits with zeros of 512 and 104 to the g; dots of size 4 at
// (255, 1), of size 3 at (511, 384) and of size 2 at (767, 513), the brightest first.
SensorView three_dots() {
  return {0x08,
          0x08,
          {1.0 / 104, -2.0 / 104, 106.0 / 104},
          {{255, 1, 16.0 / 81}, {511, 384, 9.0 / 81}, {767, 513, 4.0 / 81}}};
}

EmulatorOptions camera_on() {
  EmulatorOptions options;
  options.camera_already_on = true;
  return options;
}

/// Asks for a stream right after a sample: one report answers, then come those of the samples.
std::vector<std::string> stream(EmulatorHost& host, const std::string& mode, int reports) {
  const Duration into_period = host.now.time_since_epoch() % milliseconds(10);
  host.run(milliseconds(11) - into_period);
  host.send("12 04 " + mode);
  return host.run(milliseconds(10 * reports - 2));
}

struct Case {
  std::string mode, camera_mode, report;
};

class EmulatedReports : public ::testing::TestWithParam<Case> {};

TEST_P(EmulatedReports, have_the_bytes_worked_out_by_hand) {
  EmulatorHost host(camera_on());
  host.view = three_dots();
  host.answer(write_of("b0 00 33", GetParam().camera_mode));
  EXPECT_THAT(stream(host, GetParam().mode, 1), ElementsAre(GetParam().report));
}

INSTANTIATE_TEST_SUITE_P(
    , EmulatedReports,
    ::testing::Values(
        Case{"30", "03", "30 08 08"},
        // 513 = 0x201: 80 and 01, 510 = 0x1fe: 7f and 1., 618 = 0x26a: 9a and 1.
        Case{"31", "03", "31 28 68 80 7f 9a"}, Case{"32", "03", "32 08 08" + times(8, "ff")},
        // (0x0ff, 0x001) 4, (0x1ff, 0x180) 3: 01 01 0011, (0x2ff, 0x201) 2: 10 10 0010
        Case{"33", "03", "33 28 68 80 7f 9a ff 01 04 ff 80 53 ff 01 a2 ff ff ff"},
        Case{"34", "03", "34 08 08" + times(19, "ff")},
        Case{"35", "03", "35 28 68 80 7f 9a" + times(16, "ff")},
        // high bits y1 x1 y2 x2: 00 00 01 01, 10 10 11 11
        Case{"36", "01", "36 08 08 ff 01 05 ff 80 ff 01 af ff ff" + times(9, "ff")},
        Case{"37", "01", "37 28 68 80 7f 9a ff 01 05 ff 80 ff 01 af ff ff" + times(6, "ff")},
        Case{"3d", "03", "3d" + times(21, "ff")}),
    [](const auto& tested) { return "mode_" + tested.param.mode; });

TEST(EmulatedReport, of_full_dots_is_a_pair_that_shares_out_the_accelerometer) {
  EmulatorHost host(camera_on());
  host.view = three_dots();
  host.answer(write_of("b0 00 33", "05"));
  // z = 0x9a: 1001 in the first, high two bits in the second button byte; 1010 in the second. Then
  // the dots as in 0x33, each with its box in sensor pixels, a zero, and the area.
  EXPECT_THAT(stream(host, "3e", 4),
              ElementsAre("3e 28 48 80 ff 01 04 1d 00 21 02 00 08 ff 80 53 3e 2f 41 32 00 09",
                          "3f 48 48 7f ff 01 a2 5e 3f 60 41 00 04" + times(9, "ff"),
                          "3e 28 48 80 ff 01 04 1d 00 21 02 00 08 ff 80 53 3e 2f 41 32 00 09",
                          "3f 48 48 7f ff 01 a2 5e 3f 60 41 00 04" + times(9, "ff")));
}

TEST(EmulatedReport, both_of_a_pair_show_one_sample) {
  EmulatorHost host(camera_on());
  host.view = three_dots();
  host.answer(write_of("b0 00 33", "05"));
  ASSERT_THAT(stream(host, "3e", 1), ElementsAre(::testing::StartsWith("3e")));
  host.view = {};
  EXPECT_THAT(host.run(milliseconds(10)),
              ElementsAre("3f 48 48 7f ff 01 a2 5e 3f 60 41 00 04" + times(9, "ff")));
}

TEST(EmulatedReport, holds_ones_when_the_cameras_mode_is_another) {
  EmulatorHost host(camera_on());
  host.view = three_dots();
  EXPECT_THAT(stream(host, "37", 1), ElementsAre("37 28 68 80 7f 9a" + times(16, "ff")));
  EXPECT_THAT(stream(host, "3e", 1), ElementsAre("3e 28 48 80" + times(18, "ff")));
  host.answer(write_of("b0 00 33", "01"));
  EXPECT_THAT(stream(host, "33", 1), ElementsAre("33 28 68 80 7f 9a" + times(12, "ff")));
}

TEST(EmulatedReport, shows_dots_only_after_every_step_of_the_start_up) {
  const std::vector<std::string> steps = {"13 06",
                                          "1a 06",
                                          write_of("b0 00 30", "01"),
                                          write_of("b0 00 00", "02 00 00 71 01 00 aa 00 64"),
                                          write_of("b0 00 1a", "63 03"),
                                          write_of("b0 00 33", "03"),
                                          write_of("b0 00 30", "08")};
  for (std::size_t missing = 0; missing <= steps.size(); ++missing) {
    EmulatorHost host;
    host.view = three_dots();
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (i != missing) host.answer(steps[i]);
    const std::string report = stream(host, "33", 1).at(0);
    if (missing >= 2 && missing <= 4) continue;  // then dots come, or not, as may be
    const std::string dots =
        missing == steps.size() ? " ff 01 03 ff 80 53 ff 01 a2 ff ff ff" : times(12, "ff");
    EXPECT_EQ(report, "33 28 68 80 7f 9a" + dots) << missing;
  }
}

TEST(EmulatedReport, follows_a_request_at_once_and_then_only_changes_unless_it_is_continuous) {
  EmulatorHost host;
  host.run(milliseconds(11));
  EXPECT_THAT(host.answer("12 00 30"), ElementsAre("30 00 00"));
  EXPECT_THAT(host.run(milliseconds(200)), IsEmpty());
  host.view.buttons_2 = 0x80;
  EXPECT_THAT(host.run(milliseconds(200)), ElementsAre("30 00 80"));
  host.send("12 04 30");
  EXPECT_THAT(host.run(milliseconds(200)), SizeIs(21));
}

TEST(EmulatedReport, with_an_unknown_id_is_not_taken_as_a_request) {
  EmulatorHost host;
  host.send("12 04 30");
  host.run(milliseconds(50));
  for (const char* id : {"00", "2f", "38", "3c", "40", "ff"})
    EXPECT_TRUE(host.send(std::string("12 02 ") + id));
  EXPECT_THAT(host.run(milliseconds(100)), ::testing::AllOf(SizeIs(10), Each("30 00 00")));
}

TEST(EmulatedReport, comes_two_hundred_times_a_second_on_a_fast_link) {
  EmulatorOptions options;
  options.report_period = milliseconds(5);
  EmulatorHost host(options);
  host.send("12 04 31");
  EXPECT_THAT(host.run(milliseconds(1000)),
              SizeIs(::testing::AllOf(::testing::Ge(200u), ::testing::Le(202u))));
}

TEST(EmulatedStatus, says_battery_lamps_and_camera_and_stops_the_stream) {
  EmulatorHost host(camera_on());
  host.send("11 50");
  host.send("12 04 33");
  host.run(milliseconds(51));
  EXPECT_THAT(host.answer("15 00"), ElementsAre("20 00 00 58 00 00 c0"));
  EXPECT_THAT(host.run(milliseconds(500)), IsEmpty());
  EXPECT_EQ(host.emulator.report_mode(), 0x30);
  host.send("12 04 33");
  EXPECT_THAT(host.run(milliseconds(100)), SizeIs(11));
}

TEST(EmulatedStatus, comes_unasked_when_an_extension_is_plugged_or_unplugged) {
  EmulatorHost host;
  host.send("12 04 30");
  host.run(milliseconds(51));
  host.emulator.plug_extension(true, host.now);
  EXPECT_THAT(host.run(milliseconds(500)), ElementsAre("20 00 00 02 00 00 c0"));
  EXPECT_THAT(host.answer("17 04 a4 00 fa 00 06"),
              ElementsAre("21 00 00 50 00 fa 00 00 a4 20 00 00" + times(10, "00")));
  host.emulator.plug_extension(false, host.now);
  EXPECT_THAT(host.run(milliseconds(500)), ElementsAre("20 00 00 00 00 00 c0"));
}

TEST(EmulatedStatus, warns_of_a_low_battery_and_a_dead_one_says_nothing) {
  EmulatorHost host;
  host.emulator.set_battery(0x20);
  EXPECT_THAT(host.answer("15 00"), ElementsAre("20 00 00 00 00 00 20"));
  host.emulator.set_battery(0x1f);
  EXPECT_THAT(host.answer("15 00"), ElementsAre("20 00 00 01 00 00 1f"));
  host.send("12 04 30");
  host.emulator.set_battery(0);
  EXPECT_FALSE(host.send("15 00"));
  EXPECT_THAT(host.run(milliseconds(500)), IsEmpty());
}

TEST(EmulatedAcknowledgement, comes_when_it_is_asked_for_but_never_for_rumble) {
  EmulatorHost host;
  EXPECT_THAT(host.answer("11 12"), ElementsAre("22 00 00 11 00"));
  EXPECT_THAT(host.answer("11 10"), IsEmpty());
  EXPECT_THAT(host.answer("13 06"), ElementsAre("22 00 00 13 00"));
  EXPECT_THAT(host.answer("1a 06"), ElementsAre("22 00 00 1a 00"));
  EXPECT_THAT(host.answer("14 02"), ElementsAre("22 00 00 14 00"));
  EXPECT_THAT(host.answer("19 06"), ElementsAre("22 00 00 19 00"));
  EXPECT_THAT(host.answer("10 02"), IsEmpty());
  EXPECT_THAT(host.answer("12 02 30"), ElementsAre("22 00 00 12 00", "30 00 00"));
}

TEST(EmulatedAcknowledgement, carries_the_buttons_of_the_moment) {
  EmulatorHost host;
  host.view.buttons_1 = 0x1f;
  host.view.buttons_2 = 0x9f;
  EXPECT_THAT(host.answer("11 02"), ElementsAre("22 1f 9f 11 00"));
}

TEST(EmulatedWiimote, rumbles_as_the_last_output_report_says_whichever_it_was) {
  EmulatorHost host;
  host.send("10 01");
  EXPECT_TRUE(host.emulator.rumbling());
  host.send("11 81");
  EXPECT_TRUE(host.emulator.rumbling());
  EXPECT_EQ(host.emulator.leds(), 8);
  host.send("15 00");
  EXPECT_FALSE(host.emulator.rumbling());
}

TEST(EmulatedWiimote, ignores_reports_of_the_wrong_length_and_refuses_other_ids) {
  EmulatorHost host;
  EXPECT_TRUE(host.send("11"));
  EXPECT_TRUE(host.send("11 12 00"));
  EXPECT_TRUE(host.send("16 04 b0 00 30 01 01"));
  EXPECT_FALSE(host.send(""));
  EXPECT_FALSE(host.send("0f 00"));
  EXPECT_FALSE(host.send("1b 00"));
  EXPECT_THAT(host.run(milliseconds(200)), IsEmpty());
  EXPECT_EQ(host.emulator.leds(), 0);
}

}  // namespace
}  // namespace vindu
