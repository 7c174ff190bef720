// How a site's cameras say they are: the devices that they have, and what is wrong with each.
#include "app/cameras.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace vindu::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class CameraStates : public ::testing::Test {
 protected:
  CameraStates() {
    std::string pattern = (fs::temp_directory_path() / "vindu_cameras_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    for (const char* number : {"0", "1"})
      std::ofstream(folder_ / (std::string("eye-") + number + ".pgm")) << "P5 16 16 255\n"
                                                                       << std::string(256, '\0');
  }
  ~CameraStates() override { fs::remove_all(folder_); }

  Site site_of(const std::string& camera) const {
    return parse_site(
        "[wall]\ncolumns = 1\nrows = 1\nwidth_m = 2\nheight_m = 1\n"
        "tile_width_px = 200\ntile_height_px = 100\n"
        "[[camera]]\nname = \"left\"\nposition_m = [0, 2, 5]\nlook_at_m = [0, 1.6, 2]\n" +
            camera,
        (folder_ / "wall.toml").string());
  }

  fs::path folder_;
};

TEST_F(CameraStates, NameAVideoThatHasEnded) {
  ManualClock clock;
  const Site site = site_of(
      "source = \"video\"\nfile = \"eye-%d.pgm\"\nrate_hz = 60\nwidth_px = 16\nheight_px = 16\n"
      "focal_px = 10\n");
  const EmulatedRoom room(site, clock);
  const Cameras cameras(site, room, clock);
  ASSERT_THAT(cameras.states(), SizeIs(1));
  EXPECT_TRUE(cameras.states()[0].connected);
  EXPECT_EQ(cameras.states()[0].trouble, "");
  while (cameras.sources()[0]->next(Time{std::chrono::seconds(1)})) continue;
  EXPECT_FALSE(cameras.states()[0].connected);
  EXPECT_EQ(cameras.states()[0].trouble, "the video has ended");
}

TEST_F(CameraStates, NameTheDeviceThatAWiimoteCameraHas) {
  MonotonicClock clock;
  const Site site = site_of("source = \"emulated\"\nfocal_px = 1335\n");
  const EmulatedRoom room(site, clock);
  const Cameras cameras(site, room, clock);
  while (!cameras.states().at(0).connected)
    clock.sleep_until(clock.now() + std::chrono::milliseconds(5));
  EXPECT_THAT(cameras.states()[0].device,
              HasSubstr("Nintendo RVL-CNT-01 (057e:0306), 00:1f:c5:00:00:00"));
  EXPECT_TRUE(cameras.states()[0].gaps);
}

}  // namespace
}  // namespace vindu::app
