// vindu simulate with video files in place of cameras: pictures of a helmet, written by the test,
// make the wall's eye.
#include "tests/app/process.h"
#include "tests/tracker/ir_pictures.h"
#include "tracker/camera_model.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kSmallWall =
    "[wall]\ncolumns = 1\nrows = 1\nwidth_m = 2\nheight_m = 1\n"
    "tile_width_px = 200\ntile_height_px = 100\n";

std::string camera(const std::string& name, double x_m, const std::string& fields) {
  return "[[camera]]\nname = \"" + name + "\"\nsource = \"video\"\n" + fields +
         "\nwidth_px = 320\nheight_px = 240\nfocal_px = 420\nposition_m = [" + std::to_string(x_m) +
         ", 2.3, 5.0]\nlook_at_m = [0, 1.65, 2.0]\n";
}

class VideoCameras : public AppTest {
 protected:
  std::string write_wall(const std::string& left, const std::string& right) const {
    return write("wall.toml", kSmallWall + camera("left", -1, left) + camera("right", 1, right));
  }

  /// What a camera sees of a head that stands still, as pictures in the plainest format there is.
  void write_pictures(const CameraConfig& config, const Site& site, const std::string& name) const {
    const Rigid3 room_from_head{Quat::Identity(), {0.2, 1.7, 2.1}};
    const CameraModel model(config);
    IrPicture picture(320, 240);
    for (const Vec3& led : site.heads.front().leds_in_head) {
      const auto at = model.project(model.camera_from_room() * (room_from_head * led));
      picture.add({at->x(), at->y(), 1.5, 200});
    }
    const auto pixels = picture.bytes();
    const std::string text =
        "P5 320 240 255\n" + std::string(pixels.begin(), pixels.end());  // portable grey map
    for (int i = 0; i < 60; ++i) write(name + "-" + std::to_string(i) + ".pgm", text);
  }

  ProcessResult simulate(const std::string& wall) const {
    return vindu({"simulate", small_model(), "--wall", wall, "--clock", "manual", "--seconds",
                  "0.9", "--json", "--scale", "0.2", "--headless", "--out", path("out")});
  }
};

TEST_F(VideoCameras, TrackTheHeadThatTheirPicturesShow) {
  const std::string wall =
      write_wall("file = \"left-%d.pgm\"\nrate_hz = 60", "file = \"right-%d.pgm\"\nrate_hz = 60");
  const Site site = read_site(wall);
  write_pictures(site.cameras[0], site, "left");
  write_pictures(site.cameras[1], site, "right");
  const ProcessResult result = simulate(wall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\"frames_tracked\": 5"));  // of 54
  EXPECT_THAT(result.out, Not(HasSubstr("eye_error")));         // nobody knows the truth
}

TEST_F(VideoCameras, ThatAreNotThereAreNamedWithWhatToDo) {
  const ProcessResult result = simulate(write_wall("file = \"none.avi\"", "file = \"none.avi\""));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("camera left: there is no file"));
  EXPECT_THAT(result.err, HasSubstr("none.avi; give the path of a video"));
}

TEST_F(VideoCameras, CannotFollowAManualClockWhenTheyAreReal) {
  const ProcessResult result =
      simulate(write_wall("device = \"/dev/video0\"", "device = \"/dev/video2\""));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("camera left: a real camera cannot follow --clock manual; "));
}

}  // namespace
}  // namespace vindu
