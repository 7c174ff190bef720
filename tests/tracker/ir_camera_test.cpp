// Infrared cameras as sources: video files that the test writes, a live camera that is played, and
// what is said when neither can be opened.
#include "tracker/ir_camera/ir_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/error.h"
#include "tests/tracker/ir_pictures.h"
#include "tracker/camera_model.h"
#include "tracker/tracker.h"

namespace vindu {
namespace {

using namespace std::chrono_literals;

using ::testing::HasSubstr;
using testing::IrPicture;

class IrCameras : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  CameraConfig config_of(const std::string& name) const {
    CameraConfig config;
    config.name = "ceiling";
    config.source = CameraSource::video;
    config.video.file = path(name);
    config.video.width_px = 160;
    config.video.height_px = 120;
    return config;
  }

  std::string complaint_of(const CameraConfig& config) const {
    try {
      ManualClock clock;
      make_ir_camera(config, 0, clock);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

 private:
  std::string folder_ = ::testing::TempDir() + "vindu-video-" + std::to_string(::getpid());
};

cv::Mat picture_of(const std::vector<std::uint8_t>& pixels, int width_px) {
  return cv::Mat(pixels, true).reshape(1, static_cast<int>(pixels.size()) / width_px);
}

/// A spot that moves by (2.25, 1.5) px a picture, lossless, at 50 pictures a second.
double x_of(int picture) { return 20 + 2.25 * picture; }
double y_of(int picture) { return 30 + 1.5 * picture; }

void write_moving_spot(const std::string& file, int count, bool sequence = false) {
  cv::VideoWriter writer;
  if (!sequence)
    writer.open(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 50, {160, 120},
                false);
  for (int i = 0; i < count; ++i) {
    const auto pixels = IrPicture(160, 120).add({x_of(i), y_of(i), 1.5, 220}).bytes();
    if (sequence)
      cv::imwrite(cv::format(file.c_str(), i), picture_of(pixels, 160));
    else
      writer << picture_of(pixels, 160);
  }
}

std::vector<Observation> all_of(ObservationSource& camera, Time until) {
  std::vector<Observation> all;
  while (const auto observation = camera.next(until)) all.push_back(*observation);
  return all;
}

TEST_F(IrCameras, OfAFileDeliverItsDotsAtTheTimesOfItsPictures) {
  write_moving_spot(path("spot.avi"), 20);
  ManualClock clock;
  clock.sleep_until(Time{5s});
  const auto camera = make_ir_camera(config_of("spot.avi"), 3, clock);
  const auto seen = all_of(*camera, Time{10s});
  ASSERT_EQ(seen.size(), 20u);
  for (int i = 0; i < 20; ++i) {
    const Observation& observation = seen[static_cast<std::size_t>(i)];
    EXPECT_EQ(observation.camera, 3);
    EXPECT_LT(std::chrono::abs(observation.arrival - Time{5s + i * 20ms}), 1us);
    ASSERT_EQ(observation.dots.size(), 1u);
    EXPECT_NEAR(observation.dots[0].x_px, x_of(i), 0.03);
    EXPECT_NEAR(observation.dots[0].y_px, y_of(i), 0.03);
  }
  EXPECT_TRUE(camera->gone());
  EXPECT_EQ(camera->counts().pictures, 20u);
  EXPECT_EQ(camera->counts().stamped, 20u);
}

TEST_F(IrCameras, OfAFileAreReadUpToTheTimeThatIsAskedForAndPacedByTheClock) {
  write_moving_spot(path("spot.avi"), 20);
  ManualClock clock;
  const auto camera = make_ir_camera(config_of("spot.avi"), 0, clock);
  EXPECT_EQ(all_of(*camera, Time{90ms}).size(), 5u);
  EXPECT_EQ(clock.now(), Time{90ms});
  EXPECT_EQ(all_of(*camera, Time{90ms}).size(), 0u);
  EXPECT_FALSE(camera->gone());
  ASSERT_TRUE(camera->next(Time{1s}));
  EXPECT_LT(std::chrono::abs(clock.now() - Time{100ms}), 1us);
}

TEST_F(IrCameras, OfAFileMayRunAtAnotherRate) {
  write_moving_spot(path("spot.avi"), 5);
  CameraConfig config = config_of("spot.avi");
  config.video.rate_hz = 100;
  ManualClock clock;
  const auto seen = all_of(*make_ir_camera(config, 0, clock), Time{1s});
  ASSERT_EQ(seen.size(), 5u);
  EXPECT_EQ(seen[4].arrival, Time{40ms});
}

TEST_F(IrCameras, ReadASequenceOfPicturesWhenTheyKnowItsRate) {
  write_moving_spot(path("spot-%03d.png"), 7, true);
  CameraConfig config = config_of("spot-%03d.png");
  EXPECT_THAT(complaint_of(config), HasSubstr("without times; write rate_hz"));
  config.video.rate_hz = 50;
  ManualClock clock;
  const auto seen = all_of(*make_ir_camera(config, 0, clock), Time{1s});
  ASSERT_EQ(seen.size(), 7u);
  EXPECT_EQ(seen[6].arrival, Time{120ms});
  EXPECT_NEAR(seen[6].dots[0].x_px, x_of(6), 0.03);
}

TEST_F(IrCameras, EndWhereAFileIsTorn) {
  write_moving_spot(path("spot.avi"), 50);
  std::filesystem::resize_file(path("spot.avi"), std::filesystem::file_size(path("spot.avi")) / 2);
  ManualClock clock;
  const auto camera = make_ir_camera(config_of("spot.avi"), 0, clock);
  const auto seen = all_of(*camera, Time{1s});
  EXPECT_TRUE(camera->gone());
  ASSERT_GT(seen.size(), 3u);
  EXPECT_LT(seen.size(), 50u);
  EXPECT_NEAR(seen[3].dots[0].x_px, x_of(3), 0.03);
}

TEST_F(IrCameras, SayWhatIsWrongAndWhatToDo) {
  std::ofstream(path("words.avi")) << "no video";
  write_moving_spot(path("spot.avi"), 2);
  EXPECT_THAT(complaint_of(config_of("none.avi")),
              ::testing::AllOf(HasSubstr("camera ceiling: there is no file"), HasSubstr("; give")));
  EXPECT_THAT(complaint_of(config_of("words.avi")), HasSubstr("is no video that FFmpeg reads; "));
  EXPECT_THAT(complaint_of(config_of("no-%d.png")), HasSubstr("names no pictures; "));
  CameraConfig config = config_of("spot.avi");
  config.video.width_px = 640;
  EXPECT_THAT(complaint_of(config), HasSubstr("of 160 x 120 pixels, not 640 x 120; write"));
  config.video.file = "";
  config.video.device = "987";
  EXPECT_THAT(complaint_of(config), HasSubstr("camera ceiling: there is no /dev/video987; plug"));
  config.video.device = "/dev/null";
  EXPECT_THAT(complaint_of(config), HasSubstr("/dev/null is no V4L2 camera"));
}

/// Both cameras of the thesis' wall as video cameras, and what they see of a head that walks.
struct Walk {
  Site site = read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");

  Walk() {
    for (CameraConfig& camera : site.cameras) {
      camera.source = CameraSource::video;
      camera.lag_ms = 0;
      camera.video.width_px = 640;
      camera.video.height_px = 480;
      camera.intrinsics = {.fx_px = 830, .fy_px = 830, .cx_px = 319.5, .cy_px = 239.5};
      camera.intrinsics.distortion = {-0.05, 0.01, 0, 0, 0};
    }
  }
  static Rigid3 room_from_head(int picture) {
    return {Quat::Identity(), {-0.3 + 0.02 * picture, 1.7, 2.0 + 0.01 * picture}};
  }
  void write(std::size_t camera, const std::string& file, int count) {
    cv::VideoWriter writer(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 60,
                           {640, 480}, false);
    const CameraModel model(site.cameras[camera]);
    for (int i = 0; i < count; ++i) {
      IrPicture picture(640, 480);
      for (const Vec3& led : site.heads.front().leds_in_head) {
        const auto at = model.project(model.camera_from_room() * (room_from_head(i) * led));
        picture.add({at->x(), at->y(), 1.8, 200});
      }
      writer << picture_of(picture.add_noise(2, static_cast<unsigned>(i)).bytes(), 640);
    }
    site.cameras[camera].video.file = file;
  }
};

TEST_F(IrCameras, OfTwoFilesShowTheTrackerAWalkingHead) {
  constexpr int kPictures = 30;
  Walk walk;
  walk.write(0, path("left.avi"), kPictures);
  walk.write(1, path("right.avi"), kPictures);
  ManualClock clock;
  const auto left = make_ir_camera(walk.site.cameras[0], 0, clock);
  const auto right = make_ir_camera(walk.site.cameras[1], 1, clock);
  Tracker tracker(walk.site.cameras, walk.site.heads, walk.site.wall.room_from_wall);
  for (int i = 0; i < kPictures; ++i) {
    const auto a = left->next(Time{1s}), b = right->next(Time{1s});
    ASSERT_TRUE(a && b);
    tracker.absorb(*a);
    tracker.absorb(*b);
    const auto pose = tracker.track(a->arrival, a->arrival);
    if (i < 10) continue;  // found, and its motion known
    ASSERT_TRUE(pose && pose->level == TrackingLevel::six_dof) << i;
    const Vec3 error = pose->room_from_head.translation - Walk::room_from_head(i).translation;
    EXPECT_LT(error.norm(), 0.003) << i;
  }
}

/// A camera that is played: what its reads give, one after the other, then nothing for ever.
class PlayedInput final : public VideoInput {
 public:
  explicit PlayedInput(std::vector<VideoStatus> reads, std::optional<Duration> age = {})
      : reads_(std::move(reads)), age_(age) {}

  VideoRead read() override {
    if (next_ == reads_.size()) {
      std::this_thread::sleep_for(1ms);
      return {};
    }
    VideoRead read{reads_[next_++], {pixels_.data(), 40, 30, 40}, {}};
    if (age_) read.stamp = std::chrono::steady_clock::now().time_since_epoch() - *age_;
    return read;
  }

 private:
  std::vector<VideoStatus> reads_;
  std::optional<Duration> age_;
  std::vector<std::uint8_t> pixels_ = IrPicture(40, 30).add({20, 15, 1.5, 200}).bytes();
  std::size_t next_ = 0;
};

using enum VideoStatus;

std::vector<VideoStatus> times(std::size_t count, VideoStatus status) {
  return std::vector<VideoStatus>(count, status);
}

Time soon() { return std::chrono::steady_clock::now() + 20s; }

TEST(LiveCamera, DeliversEachPictureByItsDriversTime) {
  const auto open = [] { return std::make_unique<PlayedInput>(times(3, picture), 50ms); };
  ::testing::internal::CaptureStderr();
  const auto camera = make_live_camera(open, {}, 2);
  for (int i = 0; i < 3; ++i) {
    const auto seen = camera->next(soon());
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->camera, 2);
    EXPECT_EQ(seen->dots.size(), 1u);
    EXPECT_GE(std::chrono::steady_clock::now() - seen->arrival, 50ms);
  }
  EXPECT_EQ(camera->counts().stamped, 3u);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              ::testing::HasSubstr("pictures have the times that the driver gives them"));
  EXPECT_FALSE(camera->next(std::chrono::steady_clock::now()));
  EXPECT_FALSE(camera->gone());
}

TEST(LiveCamera, TakesTheTimeOfArrivalWhereTheDriversClockIsAnother) {
  const Time before = std::chrono::steady_clock::now();
  const auto open = [] { return std::make_unique<PlayedInput>(times(1, picture), 30min); };
  ::testing::internal::CaptureStderr();
  const auto camera = make_live_camera(open, {}, 0);
  const auto seen = camera->next(soon());
  ASSERT_TRUE(seen);
  EXPECT_GE(seen->arrival, before);
  EXPECT_EQ(camera->counts().stamped, 0u);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              ::testing::HasSubstr("pictures have those of their arrival"));
}

TEST(LiveCamera, IsTriedAgainUntilItComesBack) {
  std::atomic<int> tries = 0;
  std::atomic<bool> plugged_in = false;  // again
  const auto open = [&]() -> std::unique_ptr<VideoInput> {
    const bool first = tries++ == 0;
    if (!first && !plugged_in) throw Error({"there is no camera", "", ""});
    return std::make_unique<PlayedInput>(std::vector{picture, first ? ended : picture});
  };
  const auto camera = make_live_camera(open, {}, 0, 1ms);
  ASSERT_TRUE(camera->next(soon()));
  while (tries < 4) std::this_thread::yield();
  EXPECT_TRUE(camera->gone());
  EXPECT_FALSE(camera->next(soon()));  // does not wait for what is not there
  plugged_in = true;
  while (camera->gone()) std::this_thread::yield();
  EXPECT_TRUE(camera->next(soon()));
  EXPECT_TRUE(camera->next(soon()));
  EXPECT_EQ(camera->counts().returns, 1u);
}

TEST(LiveCamera, KeepsTheNewestWhenNobodyAsks) {
  const auto open = [] { return std::make_unique<PlayedInput>(times(200, picture)); };
  const auto camera = make_live_camera(open, {}, 0);
  while (camera->counts().pictures < 200) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(all_of(*camera, std::chrono::steady_clock::now()).size(), 64u);
  EXPECT_EQ(camera->counts().discarded, 136u);
}

TEST(LiveCamera, StopsWhileItIsUnpluggedOrSilent) {
  std::atomic<bool> there = true;
  const auto open = [&there]() -> std::unique_ptr<VideoInput> {
    if (!there.exchange(false)) throw Error({"there is no camera", "", ""});
    return std::make_unique<PlayedInput>(times(1, ended));
  };
  auto unplugged = make_live_camera(open, {}, 0, 1h);
  while (!unplugged->gone()) std::this_thread::yield();
  unplugged.reset();
  auto silent = make_live_camera(
      [] { return std::make_unique<PlayedInput>(std::vector<VideoStatus>{}); }, {}, 0);
  silent.reset();
}

TEST(LiveCamera, ThatCannotBeOpenedAtFirstSaysSo) {
  const auto open = []() -> std::unique_ptr<VideoInput> {
    throw Error({"there is no camera", "live", "plug it in"});
  };
  EXPECT_THROW(make_live_camera(open, {}, 0), Error);
}

TEST(DriverTime, IsTakenOnlyFromTheLastSecond) {
  const Time arrival{100s};
  EXPECT_EQ(driver_time(99950ms, arrival), Time{99950ms});
  EXPECT_EQ(driver_time(100001ms, arrival), std::nullopt);
  EXPECT_EQ(driver_time(98900ms, arrival), std::nullopt);
  EXPECT_EQ(driver_time(0ms, arrival), std::nullopt);
  EXPECT_EQ(driver_time({}, arrival), std::nullopt);
}

}  // namespace
}  // namespace vindu
