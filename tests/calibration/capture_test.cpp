// What a calibration reads from a recording is what the cameras saw.
#include "tracker/calibration/capture.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "tests/calibration/emulated_capture.h"
#include "tracker/recording_devices.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

using namespace testing;

TEST(Capture, OfARecordingHasItsDotsAndTheVertical) {
  const Site site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}});
  const std::string file =
      ::testing::TempDir() + "vindu-capture-" + std::to_string(::getpid()) + ".vrec";
  std::size_t seen = 0;
  {
    ManualClock clock;
    EmulatedRoomOptions options;
    options.body = wand({0, 0.15, 0.5});
    const EmulatedRoom room(site, clock, options);
    RecordingWriter writer(file, {.program = "test",
                                  .wall_file = "",
                                  .wall_text = "",
                                  .devices = {{0, "camera-0"}, {1, "camera-1"}}});
    std::vector<WiimoteReader> readers;
    for (int i = 0; i < 2; ++i)
      readers.emplace_back(std::make_unique<RecordingHidDevice>(
                               room.connect(static_cast<std::size_t>(i)), writer, i),
                           i);
    for (int step = 1; step < 300; ++step) {
      const Time now{from_seconds(0.01 * step)};
      for (WiimoteReader& reader : readers)
        while (reader.next(now)) ++seen;
      clock.sleep_until(now);
    }
  }
  const Capture capture = read_capture(file, site);
  EXPECT_GT(seen, 300u);
  EXPECT_EQ(capture.observations.size(), seen);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(capture.up_in_camera[i]);
    const Vec3 up = site.cameras[i].room_from_camera.rotation * *capture.up_in_camera[i];
    EXPECT_GT(up.y(), std::cos(radians(1)));
  }
  std::filesystem::remove(file);
}

TEST(Capture, LeavesOutTheVerticalOfWhatIsMoved) {
  EXPECT_TRUE(up_in_camera({{0, 0, 1}, {0, 0.01, 1}}));
  EXPECT_FALSE(up_in_camera({{0, 0, 1}, {0, 0.5, 0.9}}));
  EXPECT_FALSE(up_in_camera({{0, 0, 1.5}, {0, 0, 1.5}}));
  EXPECT_FALSE(up_in_camera({}));
}

}  // namespace
}  // namespace vindu
