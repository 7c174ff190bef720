// Calibration files: laid over the wall file's values, written without loss, the version before
// kept.
#include "core/calibration.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "tests/core/matchers.h"

namespace vindu {
namespace {

using ::testing::HasSubstr;
using testing::IsNearPoint;
using testing::IsNearRigid;
using ::testing::ThrowsMessage;

const std::string kWall =
    "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 2\nheight_m = 1\n"
    "tile_width_px = 100\ntile_height_px = 50\n"
    "[[camera]]\nname = \"left\"\nsource = \"emulated\"\nposition_m = [-1, 2, 5]\n"
    "look_at_m = [0, 1.6, 2]\nlag_ms = 4\n"
    "[[camera]]\nname = \"right\"\nsource = \"emulated\"\nposition_m = [1, 2, 5]\n"
    "look_at_m = [0, 1.6, 2]\n";

class CalibrationFile : public ::testing::Test {
 protected:
  CalibrationFile()
      : folder_(::testing::TempDir() + "vindu-calibration-" + std::to_string(::getpid())) {
    std::filesystem::create_directories(folder_);
    write(kWall);
  }
  ~CalibrationFile() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& text) const { std::ofstream(wall_file()) << text; }
  std::string wall_file() const { return folder_ + "/wall.toml"; }

  const std::string folder_;
};

CameraCalibration some_calibration() {
  CameraCalibration found;
  found.camera = "left";
  found.intrinsics = Intrinsics{1312.123456789012, 1313, 520, 377, {0.03, -0.1, 1e-3, 2e-4, 0.5}};
  found.room_from_camera = {Quat(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized())),
                            {-1.1, 2.0 / 3, 5}};
  found.lag_ms = 1.25;
  found.note = {"wand", "2010-06-01 12:00 UTC", "C:\\waved \"1\".vrec", 0.61, 2.1, 5.2, 0.14};
  return found;
}

TEST_F(CalibrationFile, HoldsInsteadOfTheWallFilesValues) {
  const CameraCalibration found = some_calibration();
  write_calibration(wall_file(), {found});
  const Site site = read_site(wall_file());
  EXPECT_EQ(site.cameras[0].intrinsics, *found.intrinsics);
  EXPECT_THAT(site.cameras[0].room_from_camera, IsNearRigid(*found.room_from_camera, 1e-15));
  EXPECT_EQ(site.cameras[0].lag_ms, 1.25);
  EXPECT_EQ(site.cameras[0].calibration, found.note);
  EXPECT_EQ(site.cameras[1].intrinsics, Intrinsics{});
  EXPECT_FALSE(site.cameras[1].calibration);
}

TEST_F(CalibrationFile, LeavesWhatWasNotCalibrated) {
  CameraCalibration lens_only;
  lens_only.camera = "left";
  lens_only.intrinsics = Intrinsics{1300, 1300, 500, 380, {}};
  write_calibration(wall_file(), {lens_only});
  const Site site = read_site(wall_file());
  EXPECT_EQ(site.cameras[0].lag_ms, 4);
  EXPECT_THAT(site.cameras[0].room_from_camera, IsNearRigid(look_at({-1, 2, 5}, {0, 1.6, 2}), 0));
}

TEST_F(CalibrationFile, KeepsTheVersionBeforeAndOtherCameras) {
  CameraCalibration found = some_calibration();
  write_calibration(wall_file(), {found});
  found.camera = "right";
  write_calibration(wall_file(), {found});
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/calibration/cameras.previous.toml"));
  const Site site = read_site(wall_file());
  EXPECT_TRUE(site.cameras[0].calibration);
  EXPECT_TRUE(site.cameras[1].calibration);
}

TEST_F(CalibrationFile, IsIgnoredWhereTheWallFileSaysSo) {
  CameraCalibration found = some_calibration();
  write_calibration(wall_file(), {found});
  found.camera = "right";
  write_calibration(wall_file(), {found});
  write(kWall + "calibration = false\n[head]\ncalibration = false\n");
  write_calibration(wall_file(),
                    HeadCalibration{.head = {.leds_in_head = {{0.1, 0, 0}}}, .note = {}});
  const Site site = read_site(wall_file());
  EXPECT_TRUE(site.cameras[0].calibration);
  EXPECT_FALSE(site.cameras[1].calibration);
  EXPECT_EQ(site.heads[0].leds_in_head.size(), 3u);
}

TEST_F(CalibrationFile, OfAHeadHoldsItsLedsAndEye) {
  HeadConfig head;
  head.leds_in_head = {{-0.08, 0.01, -0.1}, {0, 0, 0}, {0.1, 0, -0.08}, {0.01, 0.1, -0.05}};
  head.eye_in_head = {0.01, -0.11, -0.2};
  write_calibration(wall_file(), HeadCalibration{head, {"head", "", "", 0.4, 0, 0, 0}});
  const Site site = read_site(wall_file());
  ASSERT_EQ(site.heads[0].leds_in_head.size(), 4u);
  EXPECT_THAT(site.heads[0].leds_in_head[3], IsNearPoint(Vec3(0.01, 0.1, -0.05), 0));
  EXPECT_THAT(site.heads[0].eye_in_head, IsNearPoint(Vec3(0.01, -0.11, -0.2), 0));
  EXPECT_EQ(site.heads[0].calibration->method, "head");
}

TEST_F(CalibrationFile, TravelsWithTheTextOfTheSite) {
  const CameraCalibration found = some_calibration();
  write_calibration(wall_file(), {found});
  const Site site = parse_site(site_text(wall_file()), "elsewhere.toml");
  EXPECT_EQ(site.cameras[0].intrinsics, *found.intrinsics);
}

TEST_F(CalibrationFile, ThatIsDamagedIsRefusedWithFileAndLine) {
  const std::string file = write_calibration(wall_file(), {some_calibration()});
  std::ofstream(file) << "[[calibrated_camera]]\nname = \"left\"\nposition_m = [0, 0, 0]\n"
                         "rotation_xyzw = [1, 1, 1, 1]\n";
  try {
    read_site(wall_file());
    FAIL() << "no complaint";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file + ":4"));
    EXPECT_THAT(error.what(), HasSubstr("rotation_xyzw"));
  }
}

TEST_F(CalibrationFile, ThatHoldsACameraOrAHeadTwiceIsRefusedWithTheLineOfTheSecond) {
  const std::string cameras = write_calibration(wall_file(), {some_calibration()});
  const std::string heads = write_calibration(wall_file(), HeadCalibration{});
  std::ofstream(cameras) << "[[calibrated_camera]]\nname = \"left\"\nlag_ms = 1\n"
                            "[[calibrated_camera]]\nname = \"left\"\nlag_ms = 2\n";
  EXPECT_THAT([&] { read_site(wall_file()); },
              ThrowsMessage<Error>(HasSubstr(cameras + ":5: calibrated_camera[1].name: \"left\" is "
                                                       "calibrated twice")));
  std::filesystem::remove(cameras);
  const std::string head = "[[calibrated_head]]\nname = \"head\"\nleds_m = [[0, 0, 0]]\n";
  std::ofstream(heads) << head << head;
  EXPECT_THAT([&] { read_site(wall_file()); }, ThrowsMessage<Error>(HasSubstr(heads + ":5: ")));
}

TEST_F(CalibrationFile, OfAnUnknownCameraIsLeftOut) {
  CameraCalibration found = some_calibration();
  found.camera = "attic";
  write_calibration(wall_file(), {found});
  EXPECT_FALSE(read_site(wall_file()).cameras[0].calibration);
}

}  // namespace
}  // namespace vindu
