// vindu wiimote emulate, as far as it gets without /dev/uhid; what it does with one is seen in
// tests/kernel.
#include <filesystem>

#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

using EmulateCommand = AppTest;

TEST_F(EmulateCommand, IsCalledWrongWithACountOrAProductThatThereIsNot) {
  for (const auto& [option, value] : {std::pair{"--count", "0"}, {"--product", "0307"}}) {
    const ProcessResult result = vindu({"wiimote", "emulate", option, value});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(option));
  }
}

TEST_F(EmulateCommand, NeedsCamerasInTheWallFile) {
  const std::string wall = write("wall.toml", R"([wall]
columns = 1
rows = 1
width_m = 1
height_m = 1
tile_width_px = 100
tile_height_px = 100
)");

  const ProcessResult result = vindu({"wiimote", "emulate", "--wall", wall});

  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr(wall), HasSubstr("[[camera]]")));
}

TEST_F(EmulateCommand, RunsOrSaysHowToGetUhid) {
  const ProcessResult result = vindu({"wiimote", "emulate", "--seconds", "0.1"});

  const bool can = result.exit_code == 0 && std::filesystem::exists("/dev/uhid");
  EXPECT_TRUE(can || result.err.find("/dev/uhid") != std::string::npos) << result.err;
}

}  // namespace
}  // namespace vindu
