// Report 0x33, parsed and written, against bytes worked out by hand from the published layout:
//   33 b1 b2 X Y Z, then per slot: x7..0  y7..0  [y9 y8 x9 x8 s3 s2 s1 s0]; b1 bits 6,5 are x1,x0
//   of the accelerometer, b2 bit 5 is y1 and bit 6 is z1.
#include "tracker/wiimote/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tracker/wiimote/emulator.h"

namespace vindu {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Bytes = std::array<std::uint8_t, 18>;

// Buttons Up (b1 = 08) and A (b2 = 08).
// Acceleration (513, 510, 618):
//   513 = 4 * 128 + 1: X = 80, b1 |= 1 << 5 = 20          -> b1 = 28
//   510 = 4 * 127 + 2: Y = 7f, y1 = 1, b2 |= 20
//   618 = 4 * 154 + 2: Z = 9a, z1 = 1, b2 |= 40           -> b2 = 68
// Slot 0, (511, 384) size 3: 511 = 1ff, 384 = 180, 01 01 0011 = 53 -> ff 80 53
// Slot 1 is empty                                                  -> ff ff ff
// Slot 2, (1023, 767) size 15: 3ff, 2ff, 10 11 1111 = bf           -> ff ff bf
// Slot 3, (0, 0) size 1                                            -> 00 00 01
constexpr Bytes kThreeDots = {0x33, 0x28, 0x68, 0x80, 0x7f, 0x9a, 0xff, 0x80, 0x53,
                              0xff, 0xff, 0xff, 0xff, 0xff, 0xbf, 0x00, 0x00, 0x01};

// No button; acceleration (512, 512, 616): X = 80, Y = 80, Z = 616 / 4 = 154 = 9a.
// Slot 0, (255, 1) size 2: 0ff, 001, 00 00 0010 = 02     -> ff 01 02
// Slot 1, (767, 513) size 4: 2ff, 201, 10 10 0100 = a4   -> ff 01 a4
// Slots 2 and 3 are empty.
constexpr Bytes kDotsWithFullLowByte = {0x33, 0x00, 0x00, 0x80, 0x80, 0x9a, 0xff, 0x01, 0x02,
                                        0xff, 0x01, 0xa4, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff};

TEST(ReportParser, reads_a_report_worked_out_by_hand) {
  const auto parsed = parse_report(kThreeDots);
  ASSERT_TRUE(parsed.report);
  EXPECT_EQ(parsed.report->buttons, 0x0808);
  EXPECT_THAT(parsed.report->acceleration_raw, ElementsAre(513, 510, 618));
  EXPECT_THAT(parsed.report->dots, ElementsAre(Dot{511, 384, 3}, Dot{1023, 767, 15}, Dot{0, 0, 1}));
}

TEST(ReportParser, keeps_dots_whose_low_byte_is_ff) {
  const auto parsed = parse_report(kDotsWithFullLowByte);
  ASSERT_TRUE(parsed.report);
  EXPECT_EQ(parsed.report->buttons, 0);
  EXPECT_THAT(parsed.report->acceleration_raw, ElementsAre(512, 512, 616));
  EXPECT_THAT(parsed.report->dots, ElementsAre(Dot{255, 1, 2}, Dot{767, 513, 4}));
}

TEST(ReportParser, takes_every_row_from_768_on_as_an_empty_slot) {
  Bytes bytes = kDotsWithFullLowByte;
  // (5, 768) size 0: 05, 00, 11 00 0000 = c0; and (255, 1023) size 2: ff, ff, 11 00 0010 = c2.
  bytes[6] = 0x05, bytes[7] = 0x00, bytes[8] = 0xc0;
  bytes[9] = 0xff, bytes[10] = 0xff, bytes[11] = 0xc2;
  const auto parsed = parse_report(bytes);
  ASSERT_TRUE(parsed.report);
  EXPECT_THAT(parsed.report->dots, IsEmpty());
}

TEST(ReportParser, says_why_it_refuses_a_report) {
  const std::span<const std::uint8_t> bytes = kThreeDots;
  std::vector<std::uint8_t> longer(bytes.begin(), bytes.end());
  longer.push_back(0);
  const std::array<std::uint8_t, 7> status = {0x20, 0, 0, 0x18, 0, 0, 0xc0};
  EXPECT_EQ(parse_report({}).problem, ReportProblem::wrong_length);
  EXPECT_EQ(parse_report(bytes.first(17)).problem, ReportProblem::wrong_length);
  EXPECT_EQ(parse_report(longer).problem, ReportProblem::wrong_length);
  EXPECT_EQ(parse_report(status).problem, ReportProblem::wrong_id);
  EXPECT_FALSE(parse_report(status).report);
}

TEST(ReportParser, survives_any_bytes_and_stays_in_range) {
  std::mt19937 engine(11);
  std::uniform_int_distribution<int> byte(0, 255), length(0, 40);
  int read = 0;
  for (int i = 0; i < 200000; ++i) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(i % 2 == 0 ? 18 : length(engine)));
    for (auto& value : bytes) value = static_cast<std::uint8_t>(byte(engine));
    if (!bytes.empty() && i % 3 != 0) bytes[0] = 0x33;
    const auto parsed = parse_report(bytes);
    EXPECT_NE(parsed.report.has_value(), parsed.problem != ReportProblem::none);
    if (!parsed.report) continue;
    ++read;
    for (const Dot& dot : parsed.report->dots) {
      ASSERT_TRUE(dot.x_px >= 0 && dot.x_px <= 1023 && dot.y_px >= 0 && dot.y_px <= 767);
      ASSERT_TRUE(dot.size >= 0 && dot.size <= 15);
    }
  }
  EXPECT_GT(read, 1000);
}

TEST(EmulatedReport, has_the_bytes_worked_out_by_hand) {
  SensorState state;
  state.buttons_1 = 0x08;
  state.buttons_2 = 0x08;
  state.acceleration_raw = {513, 510, 618};
  state.slots = {SensorDot{511, 384, 3}, std::nullopt, SensorDot{1023, 767, 15},
                 SensorDot{0, 0, 1}};
  EXPECT_EQ(encode_report_0x33(state), kThreeDots);
  state = {};
  state.acceleration_raw = {512, 512, 616};
  state.slots = {SensorDot{255, 1, 2}, SensorDot{767, 513, 4}};
  EXPECT_EQ(encode_report_0x33(state), kDotsWithFullLowByte);
}

TEST(EmulatedReport, is_read_back_for_every_column_and_every_row) {
  for (int x = 0; x < 1024; ++x) {
    const int y = x % 768, size = x % 16;
    SensorState state;
    state.slots[static_cast<std::size_t>(x % 4)] = SensorDot{x, y, size};
    const auto parsed = parse_report(encode_report_0x33(state));
    ASSERT_TRUE(parsed.report);
    ASSERT_THAT(parsed.report->dots,
                ElementsAre(Dot{static_cast<double>(x), static_cast<double>(y), size}));
  }
}

}  // namespace
}  // namespace vindu
