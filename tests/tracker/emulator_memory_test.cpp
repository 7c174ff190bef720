// Memory of the emulated Wiimote: what is where, and every error code, in bytes worked out by hand.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "core/error.h"
#include "tests/tracker/emulator_host.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string failed_read(const std::string& error, const std::string& address) {
  return "21 00 00 f" + error + " " + address + times(16, "00");
}

class EmulatedMemoryTest : public ::testing::Test {
 protected:
  EmulatorHost host;
};

TEST_F(EmulatedMemoryTest, reads_back_what_was_written_to_the_camera) {
  host.answer("13 04");
  EXPECT_THAT(host.answer(write_of("b0 00 1a", "63 03")), ElementsAre("22 00 00 16 00"));
  EXPECT_THAT(host.answer("17 04 b0 00 1a 00 02"),
              ElementsAre("21 00 00 10 00 1a 63 03" + times(14, "00")));
}

TEST_F(EmulatedMemoryTest, answers_a_long_read_in_pieces_of_sixteen) {
  // Zeros 80 80 80, ones 9a 9a 9a, volume 40; 0x80 * 3 + 0x9a * 3 + 0x40 + 0x55 = 0x3e3.
  host.send("17 00 00 00 16 00 14");
  EXPECT_THAT(host.run(milliseconds(30)),
              ElementsAre("21 00 00 f0 00 16 80 80 80 00 9a 9a 9a 00 40 e3 80 80 80 00 9a 9a",
                          "21 00 00 30 00 26 9a 00 40 e3" + times(12, "00")));
}

TEST_F(EmulatedMemoryTest, sends_no_data_reports_while_it_is_being_read) {
  host.send("12 04 30");
  host.run(milliseconds(51));
  host.send("17 00 00 00 00 01 00");  // 16 pieces, 5 ms from one to the next
  EXPECT_THAT(
      host.run(milliseconds(78)),
      ::testing::AllOf(::testing::SizeIs(15), ::testing::Each(::testing::StartsWith("21"))));
  host.run(milliseconds(2));
  EXPECT_THAT(host.run(milliseconds(30)), ::testing::Each("30 00 00"));
}

TEST_F(EmulatedMemoryTest, keeps_what_was_written_to_the_eeprom) {
  host.answer("16 00 00 00 30 02 12 34" + times(14, "00"));
  EXPECT_THAT(host.answer("17 00 00 00 30 00 03"),
              ElementsAre("21 00 00 20 00 30 12 34 00" + times(13, "00")));
}

TEST_F(EmulatedMemoryTest, error_4_a_second_read_while_the_first_is_under_way) {
  host.send("17 00 00 00 16 00 01");
  EXPECT_THAT(host.answer("17 00 00 00 20 00 01"),
              ElementsAre("21 00 00 00 00 16 80" + times(15, "00"), "22 00 00 17 04"));
}

TEST_F(EmulatedMemoryTest, error_6_a_space_that_is_none) {
  EXPECT_THAT(host.answer("17 0c 00 00 16 00 01"), ElementsAre(failed_read("6", "00 16")));
  EXPECT_THAT(host.answer("16 0c 00 00 30 01" + times(16, "00")), ElementsAre("22 00 00 16 06"));
}

TEST_F(EmulatedMemoryTest, error_7_a_chip_that_does_not_answer) {
  EXPECT_THAT(host.answer("17 04 a4 00 fa 00 06"), ElementsAre(failed_read("7", "00 fa")));
  EXPECT_THAT(host.answer("17 04 a6 00 fa 00 06"), ElementsAre(failed_read("7", "00 fa")));
  EXPECT_THAT(host.answer("17 04 b0 00 30 00 01"), ElementsAre(failed_read("7", "00 30")));
  EXPECT_THAT(host.answer(write_of("b0 00 30", "08")), ElementsAre("22 00 00 16 07"));
  EXPECT_THAT(host.answer(write_of("a6 00 f0", "55")), ElementsAre("22 00 00 16 07"));
}

TEST_F(EmulatedMemoryTest, error_8_an_address_outside_the_eeprom_or_the_eeprom_on_the_bus) {
  EXPECT_THAT(host.answer("17 00 00 16 ff 00 01"),
              ElementsAre("21 00 00 00 16 ff 00" + times(15, "00")));
  EXPECT_THAT(host.answer("17 00 00 16 ff 00 02"), ElementsAre(failed_read("8", "16 ff")));
  EXPECT_THAT(host.answer("17 00 00 17 70 00 01"), ElementsAre(failed_read("8", "17 70")));
  EXPECT_THAT(host.answer("16 00 00 16 ff 02" + times(16, "00")), ElementsAre("22 00 00 16 08"));
  EXPECT_THAT(host.answer("17 04 a0 00 00 00 01"), ElementsAre(failed_read("8", "00 00")));
}

TEST_F(EmulatedMemoryTest, ignores_writes_of_no_or_too_many_bytes_and_reads_of_none) {
  host.answer("13 04");
  EXPECT_THAT(host.answer("16 04 b0 00 30 00" + times(16, "08")), IsEmpty());
  EXPECT_THAT(host.answer("16 04 b0 00 30 11" + times(16, "08")), IsEmpty());
  EXPECT_THAT(host.answer("17 04 b0 00 30 00 00"), IsEmpty());
  EXPECT_THAT(host.answer("17 04 b0 00 30 00 01"),
              ElementsAre("21 00 00 00 00 30 00" + times(15, "00")));
}

TEST_F(EmulatedMemoryTest, loses_a_write_that_comes_before_the_acknowledgement_of_the_one_before) {
  host.answer("13 04");
  host.send(write_of("b0 00 33", "03"));
  host.run(milliseconds(3));
  EXPECT_THAT(host.answer(write_of("b0 00 30", "08")), ElementsAre("22 00 00 16 00"));
  EXPECT_THAT(host.answer("17 04 b0 00 30 00 04"),
              ElementsAre("21 00 00 30 00 30 00 00 00 03" + times(12, "00")));
}

TEST_F(EmulatedMemoryTest, takes_early_writes_when_it_is_told_to) {
  EmulatorOptions options;
  options.loses_early_writes = false;
  EmulatorHost lenient(options);
  lenient.answer("13 04");
  lenient.send(write_of("b0 00 33", "03"));
  EXPECT_THAT(lenient.answer(write_of("b0 00 30", "08")),
              ElementsAre("22 00 00 16 00", "22 00 00 16 00"));
}

TEST_F(EmulatedMemoryTest, the_camera_forgets_its_registers_without_power) {
  host.answer("13 04");
  host.answer(write_of("b0 00 33", "03"));
  host.answer("13 00");
  host.answer("13 04");
  EXPECT_THAT(host.answer("17 04 b0 00 33 00 01"),
              ElementsAre("21 00 00 00 00 33 00" + times(15, "00")));
}

TEST_F(EmulatedMemoryTest, a_motion_plus_inside_wakes_in_the_extensions_place) {
  EmulatorOptions options;
  options.motion_plus = true;
  EmulatorHost plus(options);
  EXPECT_THAT(plus.answer("17 04 a6 00 fa 00 06"),
              ElementsAre("21 00 00 50 00 fa 01 00 a6 20 00 05" + times(10, "00")));
  EXPECT_THAT(plus.answer(write_of("a6 00 fe", "04")),
              ElementsAre("22 00 00 16 00", "20 00 00 02 00 00 c0"));
  EXPECT_THAT(plus.answer("17 04 a4 00 fa 00 06"),
              ElementsAre("21 00 00 50 00 fa 01 00 a4 20 04 05" + times(10, "00")));
  EXPECT_THAT(plus.answer("17 04 a6 00 fa 00 06"), ElementsAre(failed_read("7", "00 fa")));
  EXPECT_THAT(plus.answer(write_of("a4 00 f0", "55")),
              ElementsAre("22 00 00 16 00", "20 00 00 00 00 00 c0"));
}

TEST_F(EmulatedMemoryTest, the_accelerometer_shows_what_its_own_calibration_makes_of_gravity) {
  std::ifstream file(VINDU_SOURCE_DIR "/assets/wiimote/eeprom.bin", std::ios::binary);
  EmulatorOptions options;
  options.eeprom = {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EmulatorHost real(options);
  // 84 82 86 30, 9f 9d 9f 02: zeros x 0x213, y 0x208; z at 1 g 0x27e; upright and at rest.
  EXPECT_THAT(real.answer("12 00 31"), ElementsAre("31 60 40 84 82 9f"));
}

TEST_F(EmulatedMemoryTest, refuses_an_image_of_the_wrong_size) {
  EmulatorOptions options;
  options.eeprom.resize(5887);
  EXPECT_THROW(EmulatorHost{options}, Error);
}

}  // namespace
}  // namespace vindu
