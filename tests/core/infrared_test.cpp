// Sensitivities by name and by digits, formats by name.
#include "core/infrared.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Sensitivity, HasTheBytesOfItsName) {
  const auto wii_4 = sensitivity_from("wii-4");
  ASSERT_TRUE(wii_4);
  EXPECT_THAT(wii_4->block_1, ElementsAre(0x02, 0, 0, 0x71, 0x01, 0, 0xc8, 0, 0x36));
  EXPECT_THAT(wii_4->block_2, ElementsAre(0x35, 0x03));
}

TEST(Sensitivity, MayBeTypedInDigits) {
  EXPECT_EQ(sensitivity_from("020000710100c80036 3503"), sensitivity_from("wii-4"));
  EXPECT_EQ(sensitivity_from("02 00 00 71 01 00 C8 00 36 35 03"), sensitivity_from("wii-4"));
}

TEST(Sensitivity, IsNothingElse) {
  for (const char* text : {"", "wii-6", "02000071", "020000710100c8003635030",
                           "020000710100c800363g03", "020000710100c8003635-3"})
    EXPECT_FALSE(sensitivity_from(text)) << text;
}

TEST(Sensitivity, NamesWhatThereIs) {
  for (const char* name : {"wii-1", "wii-5", "maximum"}) {
    EXPECT_THAT(sensitivity_names(), HasSubstr(name));
    EXPECT_TRUE(sensitivity_from(name));
  }
}

TEST(IrFormat, HasAName) {
  EXPECT_EQ(ir_format_from("basic"), IrFormat::basic);
  EXPECT_EQ(ir_format_from("extended"), IrFormat::extended);
  EXPECT_EQ(ir_format_from("full"), IrFormat::full);
  EXPECT_FALSE(ir_format_from("Full"));
}

}  // namespace
}  // namespace vindu
