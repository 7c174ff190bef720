// A V4L2 camera by a real kernel: its virtual video driver vivid plays a webcam, with a test
// pattern whose one bright spot is known, and with a plug that can be pulled. Runs in QEMU; see
// run.sh.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <thread>

#include "core/error.h"
#include "tracker/ir_camera/ir_camera.h"

namespace vindu {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr const char* kDevice = "/dev/video0";
constexpr int kWidth_px = 640, kHeight_px = 480, kRate_hz = 15;

Time soon() { return MonotonicClock().now() + 30s; }

/// The driver's own controls, by the names that `v4l2-ctl --list-ctrls` shows.
class Controls {
 public:
  Controls() : file_(::open(kDevice, O_RDWR | O_CLOEXEC)) {}
  ~Controls() { ::close(file_); }
  Controls(const Controls&) = delete;
  Controls& operator=(const Controls&) = delete;

  void set(const std::string& name, int value) {
    v4l2_control control{find(name).id, value};
    EXPECT_EQ(::ioctl(file_, VIDIOC_S_CTRL, &control), 0) << name;
  }

  void choose(const std::string& name, const std::string& entry) {
    const v4l2_queryctrl found = find(name);
    for (int i = found.minimum; i <= found.maximum; ++i) {
      v4l2_querymenu menu{};
      menu.id = found.id;
      menu.index = static_cast<unsigned>(i);
      if (::ioctl(file_, VIDIOC_QUERYMENU, &menu) == 0 &&
          entry == reinterpret_cast<const char*>(menu.name))
        return set(name, i);
    }
    ADD_FAILURE() << name << " has no " << entry;
  }

 private:
  v4l2_queryctrl find(const std::string& name) {
    v4l2_queryctrl found{};
    found.id = V4L2_CTRL_FLAG_NEXT_CTRL;
    while (::ioctl(file_, VIDIOC_QUERYCTRL, &found) == 0) {
      if (name == reinterpret_cast<const char*>(found.name)) return found;
      found.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
    }
    ADD_FAILURE() << "there is no control " << name;
    return {};
  }

  int file_;
};

class Vivid : public ::testing::Test {
 protected:
  /// A green square in the middle, two fifths of the width, on black, and no text. The stamps at
  /// the ends of its frames lie in the future, as it delivers them at their beginnings.
  void SetUp() override {
    ASSERT_EQ(::access(kDevice, R_OK | W_OK), 0);
    Controls controls;
    controls.choose("Test Pattern", "100% Black");
    controls.choose("OSD Text Mode", "None");
    controls.choose("Timestamp Source", "Start of Exposure");
    controls.set("Show Square", 1);
  }

  static CameraConfig camera() {
    CameraConfig config;
    config.name = "vivid";
    config.source = CameraSource::video;
    config.video.device = kDevice;
    config.video.width_px = kWidth_px;
    config.video.height_px = kHeight_px;
    config.video.rate_hz = kRate_hz;
    config.video.blobs.max_area_px = kWidth_px * kHeight_px;
    return config;
  }

  static std::string complaint_about(const CameraConfig& config) {
    MonotonicClock clock;
    try {
      make_ir_camera(config, 0, clock);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  }

  MonotonicClock clock_;
};

TEST_F(Vivid, ShowsTheSpotOfItsTestPatternAtTheTimesOfTheDriver) {
  constexpr int kPictures = 20;
  const auto vivid = make_ir_camera(camera(), 3, clock_);

  Time before{};
  for (int i = 0; i < kPictures; ++i) {
    const auto seen = vivid->next(soon());
    ASSERT_TRUE(seen) << i;
    EXPECT_EQ(seen->camera, 3);
    EXPECT_GT(seen->arrival, before);
    before = seen->arrival;
    ASSERT_EQ(seen->dots.size(), 1u) << i;
    EXPECT_NEAR(seen->dots[0].x_px, 0.5 * (kWidth_px - 1), 0.5);
    EXPECT_NEAR(seen->dots[0].y_px, 0.5 * (kHeight_px - 1), 0.5);
  }

  const IrCameraCounts counts = vivid->counts();
  EXPECT_GE(counts.pictures, static_cast<std::uint64_t>(kPictures));
  EXPECT_EQ(counts.stamped, counts.pictures);
}

TEST_F(Vivid, SaysThatItTakesNoExposure) {
  CameraConfig config = camera();
  config.video.exposure = 100;

  EXPECT_THAT(complaint_about(config), HasSubstr("does not take exposure = 100; leave it out"));
}

TEST_F(Vivid, SaysWhichSizeItHas) {
  CameraConfig config = camera();
  config.video.width_px = 632;

  EXPECT_THAT(complaint_about(config), HasSubstr("has pictures of"));
}

TEST_F(Vivid, ComesBackByItselfAfterItWasUnplugged) {
  const auto vivid = make_ir_camera(camera(), 0, clock_);
  ASSERT_TRUE(vivid->next(soon()));

  Controls().set("Disconnect", 1);
  for (const Time end = soon(); !vivid->gone() && clock_.now() < end;) vivid->next(soon());
  EXPECT_TRUE(vivid->gone());
  for (const Time end = soon(); vivid->gone() && clock_.now() < end;)
    std::this_thread::sleep_for(50ms);

  EXPECT_EQ(vivid->counts().returns, 1u);
  const auto seen = vivid->next(soon());
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->dots.size(), 1u);
}

}  // namespace
}  // namespace vindu
