// wall.toml: what a good file means.
#include "core/site.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/core/files.h"
#include "tests/core/matchers.h"

namespace vindu {
namespace {

using ::testing::HasSubstr;
using testing::IsNearPoint;
using testing::IsNearRigid;
using testing::TextFile;
using ::testing::ThrowsMessage;

const std::string kGrid =
    "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 2\nheight_m = 1\n"
    "tile_width_px = 100\ntile_height_px = 50\n";

Site site_of(const std::string& text) { return read_site(TextFile(text).path()); }

TEST(Site, OfTheThesisIsReadFromItsFile) {
  const Site site = read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  EXPECT_EQ(site.wall.tiles.size(), 28u);
  EXPECT_EQ(site.wall.find("tile-6-3")->host, "tile-6-3");
  EXPECT_DOUBLE_EQ(site.wall.grid.width_m, 5.185);
  ASSERT_EQ(site.cameras.size(), 2u);
  EXPECT_EQ(site.cameras[1].name, "right");
  EXPECT_EQ(site.cameras[1].source, CameraSource::emulated);
  EXPECT_THAT(site.cameras[1].room_from_camera, IsNearRigid(look_at({1, 2.3, 5}, {0, 1.65, 2}), 0));
  EXPECT_THAT(site.heads.front().eye_in_head, IsNearPoint(Vec3(0, -0.10, -0.19), 0));
}

TEST(Site, OfAWallAloneHasTheDefaults) {
  const Site site = site_of(kGrid);
  EXPECT_EQ(site.wall.tiles.size(), 2u);
  EXPECT_EQ(site.wall.tiles[1].host, "tile-1-0");
  EXPECT_THAT(site.wall.room_from_wall, IsNearRigid(room_from_wall_at(1.55, 0), 0));
  EXPECT_DOUBLE_EQ(site.rate_hz, 60);
  EXPECT_THAT(site.viewer.default_eye_in_wall, IsNearPoint(Vec3(0, 0.10, 2.0), 0));
  EXPECT_EQ(site.heads.front().leds_in_head.size(), 3u);
  EXPECT_TRUE(site.cameras.empty());
  EXPECT_TRUE(site.scene.model.empty());
  EXPECT_EQ(site.scene.place, Placement::fit);
}

TEST(Site, TakesEveryFieldOfTheWall) {
  const Site site = site_of(kGrid +
                            "bezel_x_mm = 8\nbezel_y_mm = 9\ncurve_deg = 20\nhosts = \"pc{x}\"\n"
                            "mirror = true\nrotate_deg = 270\nrate_hz = 120\n"
                            "centre_height_m = 1.2\ntilt_deg = -5\n");
  EXPECT_DOUBLE_EQ(site.wall.grid.bezel_x_mm, 8);
  EXPECT_DOUBLE_EQ(site.wall.grid.bezel_y_mm, 9);
  EXPECT_DOUBLE_EQ(site.wall.grid.curve_deg, 20);
  EXPECT_EQ(site.wall.tiles[1].host, "pc1");
  EXPECT_EQ(site.wall.tiles[1].mount, (TileMount{.mirror = true, .rotate_deg = 270}));
  EXPECT_DOUBLE_EQ(site.rate_hz, 120);
  EXPECT_THAT(site.wall.room_from_wall, IsNearRigid(room_from_wall_at(1.2, -5), 0));
}

TEST(Site, TakesExceptionsForSingleTiles) {
  const Site site = site_of(kGrid +
                            "mirror = true\n[[tile]]\nname = \"tile-1-0\"\nhost = \"spare\"\n"
                            "monitor = \"HDMI-1\"\nrotate_deg = 90\nlower_left_m = [0, -0.5, 0.1]\n"
                            "lower_right_m = [1, -0.5, 0.2]\nupper_left_m = [0, 0.5, 0.1]\n");
  const Tile& tile = *site.wall.find("tile-1-0");
  EXPECT_EQ(tile.host, "spare");
  EXPECT_EQ(tile.monitor, "HDMI-1");
  EXPECT_EQ(tile.mount, (TileMount{.mirror = true, .rotate_deg = 90}));
  EXPECT_THAT(tile.corners.lower_right_in_wall, IsNearPoint(Vec3(1, -0.5, 0.2), 0));
  EXPECT_EQ(site.wall.find("tile-0-0")->host, "tile-0-0");
}

TEST(Site, TakesViewerHeadAndScene) {
  const Site site = site_of(kGrid +
                            "[viewer]\ndefault_eye_m = [0.1, 0.2, 3]\ndisplay_latency_ms = 25\n"
                            "[head]\nleds_m = [[0, 0, 0]]\neye_m = [0, -0.1, -0.2]\n"
                            "[scene]\nmodel = \"models/a.glb\"\nplace = \"life-size\"\n");
  EXPECT_THAT(site.viewer.default_eye_in_wall, IsNearPoint(Vec3(0.1, 0.2, 3), 0));
  EXPECT_DOUBLE_EQ(site.viewer.display_latency_ms, 25);
  ASSERT_EQ(site.heads.front().leds_in_head.size(), 1u);
  EXPECT_THAT(site.heads.front().eye_in_head, IsNearPoint(Vec3(0, -0.1, -0.2), 0));
  EXPECT_EQ(site.scene.place, Placement::life_size);
}

TEST(Site, TakesAHelmetOfOneLedAndALensOf120Degrees) {
  const Site site = site_of(kGrid +
                            "[head]\nleds_m = [[0, 0, 0]]\n[tracking]\nmode = \"position\"\n"
                            "[[camera]]\nname = \"wide\"\nsource = \"video\"\nfile = \"a.avi\"\n"
                            "width_px = 640\nfocal_px = 184\nposition_m = [0, 3, 2]\n"
                            "pitch_deg = 90\n");
  EXPECT_EQ(site.heads.front().leds_in_head.size(), 1u);
  EXPECT_DOUBLE_EQ(site.cameras[0].intrinsics.fx_px, 184);
}

TEST(Site, FindsTheModelBesideItsFile) {
  const TextFile file(kGrid + "[scene]\nmodel = \"models/a.glb\"\n");
  const std::filesystem::path expected =
      std::filesystem::path(file.path()).parent_path() / "models/a.glb";
  EXPECT_EQ(read_site(file.path()).scene.model, expected.string());
  EXPECT_EQ(site_of(kGrid + "[scene]\nmodel = \"/models/a.glb\"\n").scene.model, "/models/a.glb");
}

TEST(Site, TakesEveryFieldOfACamera) {
  const Site site = site_of(kGrid +
                            "[[camera]]\nname = \"ceiling\"\nsource = \"wiimote\"\n"
                            "address = \"00:1F:32:00:00:01\"\nposition_m = [0, 3, 2]\n"
                            "heading_deg = -37\npitch_deg = 60\nroll_deg = 5\nfocal_px = 800\n"
                            "focal_aspect = 1.1\ncentre_px = [320, 240]\n"
                            "distortion = [0.1, -0.2, 0.01, 0.02, 0.3]\n");
  ASSERT_EQ(site.cameras.size(), 1u);
  const CameraConfig& camera = site.cameras[0];
  EXPECT_EQ(name_of(camera.source), "wiimote");
  EXPECT_EQ(camera.address, "00:1F:32:00:00:01");
  EXPECT_THAT(
      camera.room_from_camera,
      IsNearRigid(camera_from_thesis_angles({0, 3, 2}, radians(-37), radians(60), radians(5)), 0));
  EXPECT_DOUBLE_EQ(camera.intrinsics.fx_px, 800);
  EXPECT_DOUBLE_EQ(camera.intrinsics.fy_px, 880);
  EXPECT_DOUBLE_EQ(camera.intrinsics.cx_px, 320);
  EXPECT_EQ(camera.intrinsics.distortion, (std::array{0.1, -0.2, 0.01, 0.02, 0.3}));
}

TEST(Site, TakesEveryFieldOfAVideoCamera) {
  const Site site = site_of(kGrid +
                            "[[camera]]\nname = \"a\"\nsource = \"video\"\n"
                            "device = \"/dev/video2\"\nwidth_px = 1280\nheight_px = 720\n"
                            "rate_hz = 120\nexposure = 20\ngain = 5\nthreshold = 90\n"
                            "min_area_px = 2\nmax_area_px = 400\nmax_dots = 8\n"
                            "position_m = [0, 1, 4]\npitch_deg = 90\n");
  const VideoConfig& video = site.cameras[0].video;
  EXPECT_EQ(name_of(site.cameras[0].source), "video");
  EXPECT_EQ(video.device, "/dev/video2");
  EXPECT_EQ(video.file, "");
  EXPECT_EQ(video.width_px, 1280);
  EXPECT_EQ(video.height_px, 720);
  EXPECT_EQ(video.rate_hz, 120);
  EXPECT_EQ(video.exposure, 20);
  EXPECT_EQ(video.gain, 5);
  EXPECT_EQ(video.blobs.threshold, 90);
  EXPECT_EQ(video.blobs.min_area_px, 2);
  EXPECT_EQ(video.blobs.max_area_px, 400);
  EXPECT_EQ(video.blobs.max_dots, 8);
}

TEST(Site, TakesAVideoFileBesideItselfAndThePicturesMiddleForItsCentre) {
  const TextFile file(kGrid +
                      "[[camera]]\nname = \"a\"\nsource = \"video\"\nfile = \"walk.avi\"\n"
                      "position_m = [0, 1, 4]\npitch_deg = 90\n");
  const CameraConfig camera = read_site(file.path()).cameras[0];
  const std::filesystem::path expected =
      std::filesystem::path(file.path()).parent_path() / "walk.avi";
  EXPECT_EQ(camera.video.file, expected.string());
  EXPECT_EQ(camera.video.rate_hz, std::nullopt);
  EXPECT_EQ(camera.video.exposure, std::nullopt);
  EXPECT_DOUBLE_EQ(camera.intrinsics.cx_px, 319.5);
  EXPECT_DOUBLE_EQ(camera.intrinsics.cy_px, 239.5);
}

TEST(Site, LetsAnEmulatedCameraStandInForAnyOther) {
  const Site site = site_of(kGrid +
                            "[[camera]]\nname = \"a\"\nsource = \"emulated\"\n"
                            "address = \"00:1F:32:00:00:01\"\ndevice = \"/dev/video0\"\n"
                            "threshold = 90\nposition_m = [0, 1, 4]\npitch_deg = 90\n");
  EXPECT_EQ(site.cameras[0].source, CameraSource::emulated);
  EXPECT_DOUBLE_EQ(site.cameras[0].intrinsics.cx_px, 512);
}

TEST(Site, TakesACameraWithOneAngleOnlyAsHorizontal) {
  const Site site = site_of(kGrid +
                            "[[camera]]\nname = \"a\"\nsource = \"wiimote\"\n"
                            "position_m = [0, 1, 4]\nheading_deg = 0\n");
  EXPECT_THAT(site.cameras[0].room_from_camera.rotation * Vec3::UnitZ(),
              IsNearPoint(Vec3(0, 0, -1), 1e-12));
}

TEST(Site, TakesSixteenCamerasAndRefusesOneMore) {
  std::string text = kGrid;
  const auto add = [&](int number) {
    text += "[[camera]]\nname = \"" + std::to_string(number) +
            "\"\nsource = \"emulated\"\nposition_m = [0, 2, 5]\nlook_at_m = [0, 1.6, 2]\n";
  };
  for (int number = 1; number <= 16; ++number) add(number);
  EXPECT_EQ(site_of(text).cameras.size(), 16u);
  add(17);
  EXPECT_THAT([&] { site_of(text); },
              ThrowsMessage<Error>(HasSubstr("one camera too many; 16 are tracked at most")));
}

TEST(Site, IsOfOneMachineUnlessAMasterIsNamed) {
  const Site alone = site_of(kGrid);
  EXPECT_EQ(alone.cluster.name, "wall");
  EXPECT_EQ(alone.cluster.interface, "lo");
  EXPECT_EQ(alone.cluster.keys, "");
  EXPECT_EQ(alone.cluster.lock, FrameLock::barrier);
  EXPECT_EQ(site_of(kGrid + "[cluster]\nmaster = \"node0\"\n").cluster.interface, "");
}

TEST(Site, ReadsHowItsProcessesFindEachOther) {
  const ClusterConfig cluster =
      site_of(kGrid +
              "[cluster]\nname = \"left\"\nmaster = \"10.77.0.1\"\ninterface = \"eth1\"\n"
              "multicast = false\ndomain = 7\nlock = \"timed\"\nswap_group = true\n"
              "keys = \"site/keys\"\n")
          .cluster;
  EXPECT_EQ(cluster.name, "left");
  EXPECT_EQ(cluster.master, "10.77.0.1");
  EXPECT_EQ(cluster.interface, "eth1");
  EXPECT_FALSE(cluster.multicast);
  EXPECT_EQ(cluster.domain, 7);
  EXPECT_EQ(cluster.lock, FrameLock::timed);
  EXPECT_TRUE(cluster.swap_group);
  EXPECT_TRUE(cluster.keys.ends_with("site/keys"));
}

TEST(Site, ReadsHowFarTheEyeIsFromTheHand) {
  EXPECT_EQ(site_of(kGrid).touch.eye_distance_m, 2);
  EXPECT_EQ(site_of(kGrid + "[touch]\neye_distance_m = 0.8\n").touch.eye_distance_m, 0.8);
  EXPECT_THROW(site_of(kGrid + "[touch]\neye_distance_m = 0\n"), Error);
}

TEST(Placement, IsKnownByItsName) {
  EXPECT_EQ(placement_from("fit"), Placement::fit);
  EXPECT_EQ(placement_from("life-size"), Placement::life_size);
  EXPECT_EQ(placement_from("as-is"), Placement::as_is);
  EXPECT_EQ(placement_from("life_size"), std::nullopt);
}

}  // namespace
}  // namespace vindu
