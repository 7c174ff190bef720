// Input reports against bytes worked out by hand from the published layouts (WiiBrew, "Wiimote").
// Of every data report: bits 6 and 5 of the first button byte are the lowest of x of the
// accelerometer, bit 5 of the second is bit 1 of y and bit 6 bit 1 of z.
#include "tracker/wiimote/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Optional;
using Bytes = std::vector<std::uint8_t>;

template <class Kind>
Kind read_as(const Bytes& bytes) {
  const ParsedReport parsed = parse_report(bytes);
  EXPECT_EQ(parsed.problem, ReportProblem::none);
  return parsed.report ? std::get<Kind>(*parsed.report) : Kind{};
}

std::optional<IrDot> dot(int x_px, int y_px, int size = 0) {
  return IrDot{x_px, y_px, size, std::nullopt};
}

// Buttons Up (b1 = 08) and A (b2 = 08).
// Acceleration (513, 510, 618):
//   513 = 4 * 128 + 1: X = 80, b1 |= 1 << 5 = 20          -> b1 = 28
//   510 = 4 * 127 + 2: Y = 7f, y1 = 1, b2 |= 20
//   618 = 4 * 154 + 2: Z = 9a, z1 = 1, b2 |= 40           -> b2 = 68
// Slot 0, (511, 384) size 3: 511 = 1ff, 384 = 180, 01 01 0011 = 53 -> ff 80 53
// Slot 1 is empty                                                  -> ff ff ff
// Slot 2, (1023, 767) size 15: 3ff, 2ff, 10 11 1111 = bf           -> ff ff bf
// Slot 3, (0, 0) size 1                                            -> 00 00 01
const Bytes kExtended = {0x33, 0x28, 0x68, 0x80, 0x7f, 0x9a, 0xff, 0x80, 0x53,
                         0xff, 0xff, 0xff, 0xff, 0xff, 0xbf, 0x00, 0x00, 0x01};

TEST(WiimoteReport, ReadsExtendedDots) {
  const auto data = read_as<DataReport>(kExtended);
  EXPECT_EQ(data.buttons, 0x0808);
  EXPECT_THAT(data.acceleration_raw, Optional(ElementsAre(513, 510, 618)));
  EXPECT_THAT(*data.slots,
              ElementsAre(dot(511, 384, 3), std::nullopt, dot(1023, 767, 15), dot(0, 0, 1)));
  EXPECT_FALSE(data.camera_silent);
}

TEST(WiimoteReport, HandsTheTrackerTheSlotsThatAreNotEmpty) {
  const auto data = read_as<DataReport>(kExtended);
  EXPECT_THAT(dots_of(*data.slots),
              ElementsAre(Dot{511, 384, 3}, Dot{1023, 767, 15}, Dot{0, 0, 1}));
}

// (255, 1) size 2: 0ff, 001, 00 00 0010 = 02; (511, 0): 1ff, 000, 00 01 0000 = 10;
// (767, 513) size 4: 2ff, 201, 10 10 0100 = a4.
TEST(WiimoteReport, KeepsDotsWhoseLowByteIsFf) {
  const auto data = read_as<DataReport>({0x33, 0, 0, 0x80, 0x80, 0x9a, 0xff, 0x01, 0x02, 0xff, 0x00,
                                         0x10, 0xff, 0x01, 0xa4, 0xff, 0xff, 0xff});
  EXPECT_THAT(*data.slots,
              ElementsAre(dot(255, 1, 2), dot(511, 0), dot(767, 513, 4), std::nullopt));
}

// (5, 768): 05, 00, 11 00 0000 = c0; (255, 1023): ff, ff, 11 00 0010 = c2.
TEST(WiimoteReport, TakesEveryRowFrom768OnAsAnEmptySlot) {
  const auto data = read_as<DataReport>({0x33, 0, 0, 0x80, 0x80, 0x9a, 0x05, 0x00, 0xc0, 0xff, 0xff,
                                         0xc2, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff});
  EXPECT_THAT(dots_of(*data.slots), IsEmpty());
}

// Pair 1: (255, 256) and (512, 767): low bytes ff 00 and 00 ff; y1 = 100 -> 01, x1 = 0ff -> 00,
//         y2 = 2ff -> 10, x2 = 200 -> 10: 01 00 10 10 = 4a           -> ff 00 4a 00 ff
// Pair 2: (1023, 0) and an empty slot: y1 00, x1 11, 11 11 = 3f       -> ff 00 3f ff ff
const Bytes kBasicDots = {0xff, 0x00, 0x4a, 0x00, 0xff, 0xff, 0x00, 0x3f, 0xff, 0xff};

TEST(WiimoteReport, ReadsBasicDotsWithAndWithoutAcceleration) {
  Bytes with = {0x37, 0x20, 0x00, 0x81, 0x80, 0x9a}, without = {0x36, 0x00, 0x80};
  for (Bytes* bytes : {&with, &without})
    bytes->insert(bytes->end(), kBasicDots.begin(), kBasicDots.end());
  with.resize(22, 0xee), without.resize(22, 0xee);  // the extension's
  const auto slots = ElementsAre(dot(255, 256), dot(512, 767), dot(1023, 0), std::nullopt);
  EXPECT_THAT(*read_as<DataReport>(with).slots, slots);
  EXPECT_THAT(read_as<DataReport>(with).acceleration_raw, Optional(ElementsAre(517, 512, 616)));
  EXPECT_THAT(*read_as<DataReport>(without).slots, slots);
  EXPECT_FALSE(read_as<DataReport>(without).acceleration_raw);
  EXPECT_EQ(read_as<DataReport>(without).buttons, 0x0080);
}

// Acceleration (4 * 130, 4 * 120, 4 * 0x9a): X = 82, Y = 78; z bits 7..4 = 1001 in the first: its
// bits 5,4 = 01 -> b1 bits 6,5 = 20, bits 7,6 = 10 -> b2 bits 6,5 = 40; z bits 3..0 = 1010 in the
// second: bits 1,0 = 10 -> b1 = 40, bits 3,2 = 10 -> b2 = 40. Button A in both: b2 |= 08.
// Slot 0, (511, 384) size 3 as above, blob from (62, 47) to (65, 49), intensity 200.
const Bytes kFirstHalf = {0x3e, 0x20, 0x48, 0x82, 0xff, 0x80, 0x53, 62,   47,   65,   49,
                          0,    200,  0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff};
const Bytes kSecondHalf = {0x3f, 0x40, 0x48, 0x78, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
                           0xff, 0xff, 0xff, 0xff, 0xbf, 126,  94,   127,  95,   0,    17};

TEST(WiimoteReport, JoinsTheHalvesOfFullDots) {
  Bytes first_bytes = kFirstHalf;
  first_bytes.push_back(0xff);
  const auto first = read_as<HalfReport>(first_bytes);
  const auto second = read_as<HalfReport>(kSecondHalf);
  const DataReport data = join(first, second);
  EXPECT_FALSE(first.second);
  EXPECT_TRUE(second.second);
  EXPECT_THAT(data.acceleration_raw, Optional(ElementsAre(520, 480, 616)));
  EXPECT_EQ(data.buttons, 0x0008);
  EXPECT_THAT(*data.slots,
              ElementsAre(IrDot{511, 384, 3, Blob{62, 47, 65, 49, 200}}, std::nullopt, std::nullopt,
                          IrDot{1023, 767, 15, Blob{126, 94, 127, 95, 17}}));
}

TEST(WiimoteReport, SaysWhenTheCameraSaysNothing) {
  for (const std::uint8_t fill : {std::uint8_t{0x00}, std::uint8_t{0xff}}) {
    Bytes bytes = {0x33, 0, 0, 0x80, 0x80, 0x9a};
    bytes.resize(18, fill);
    EXPECT_TRUE(read_as<DataReport>(bytes).camera_silent);
    EXPECT_THAT(dots_of(*read_as<DataReport>(bytes).slots), IsEmpty());
    Bytes half = {0x3e, 0, 0, 0x80};
    half.resize(22, fill);
    EXPECT_TRUE(read_as<HalfReport>(half).camera_silent);
  }
}

// Flags 9b = LEDs 1001, camera on, extension, battery low.
TEST(WiimoteReport, ReadsAStatus) {
  EXPECT_EQ(read_as<StatusReport>({0x20, 0x00, 0x08, 0x9b, 0, 0, 0x1e}),
            (StatusReport{.buttons = 0x0008,
                          .battery_low = true,
                          .extension = true,
                          .camera_on = true,
                          .leds = 9,
                          .battery = 0x1e}));
}

TEST(WiimoteReport, ReadsMemoryAndItsErrors) {
  Bytes bytes = {0x21, 0x00, 0x00, 0x30, 0x00, 0x16, 0xa1, 0xa2, 0xa3, 0xa4};
  bytes.resize(22, 0);
  const auto good = read_as<MemoryReport>(bytes);
  bytes[3] = 0xf7;
  const auto bad = read_as<MemoryReport>(bytes);
  EXPECT_EQ(good.address, 0x16);
  EXPECT_EQ(good.size, 4);
  EXPECT_EQ(good.data[3], 0xa4);
  EXPECT_EQ(bad.error, 7);
  EXPECT_EQ(bad.size, 0);
}

TEST(WiimoteReport, ReadsAnAcknowledgement) {
  EXPECT_EQ(read_as<Acknowledgement>({0x22, 0x00, 0x00, 0x16, 0x04}),
            (Acknowledgement{.buttons = 0, .command = 0x16, .error = 4}));
}

TEST(WiimoteReport, ReadsDataWithoutDots) {
  EXPECT_EQ(read_as<DataReport>({0x30, 0x00, 0x80}).buttons, 0x0080);
  EXPECT_FALSE(read_as<DataReport>({0x31, 0, 0, 0x80, 0x80, 0x9a}).slots);
  Bytes extension_only(22, 0xff);
  extension_only[0] = 0x3d;
  EXPECT_EQ(read_as<DataReport>(extension_only).buttons, 0);
}

TEST(WiimoteReport, IgnoresWhatAnAdapterPads) {
  Bytes padded = kExtended;
  padded.resize(32, 0x55);
  EXPECT_EQ(read_as<DataReport>(padded), read_as<DataReport>(kExtended));
}

TEST(WiimoteReport, SaysWhyItRefusesAReport) {
  EXPECT_EQ(parse_report({}).problem, ReportProblem::too_short);
  EXPECT_EQ(parse_report(std::span(kExtended).first(17)).problem, ReportProblem::too_short);
  EXPECT_EQ(parse_report(Bytes{0x12, 0, 0x33}).problem, ReportProblem::unknown_id);
  EXPECT_FALSE(parse_report(Bytes{0x12, 0, 0x33}).report);
}

TEST(WiimoteReport, SurvivesAnyBytesAndStaysInRange) {
  std::mt19937 engine(11);
  std::uniform_int_distribution<int> byte(0, 255), length(0, 64), id(0x20, 0x3f);
  int dots = 0;
  for (int i = 0; i < 200000; ++i) {
    Bytes bytes(static_cast<std::size_t>(i % 2 == 0 ? 22 : length(engine)));
    for (auto& value : bytes) value = static_cast<std::uint8_t>(byte(engine));
    if (!bytes.empty() && i % 3 != 0) bytes[0] = static_cast<std::uint8_t>(id(engine));
    const ParsedReport parsed = parse_report(bytes);
    ASSERT_NE(parsed.report.has_value(), parsed.problem != ReportProblem::none);
    const auto* data = parsed.report ? std::get_if<DataReport>(&*parsed.report) : nullptr;
    if (!data || !data->slots) continue;
    for (const Dot& each : dots_of(*data->slots)) {
      ++dots;
      ASSERT_TRUE(each.x_px >= 0 && each.x_px <= 1023 && each.y_px >= 0 && each.y_px <= 767);
      ASSERT_TRUE(each.size >= 0 && each.size <= 15);
    }
  }
  EXPECT_GT(dots, 1000);
}

}  // namespace
}  // namespace vindu
