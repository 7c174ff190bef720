// What a calibration reads from a recording is what the cameras saw.
#include "tracker/calibration/capture.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
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

/// Share of the steps from picture to picture that are a whole number of periods, to 1 ms.
double even_share(const CameraTrack& track, double period_s) {
  std::size_t even = 0;
  for (std::size_t i = 1; i < track.pictures.size(); ++i) {
    const double steps = (track.pictures[i].t_s - track.pictures[i - 1].t_s) / period_s;
    if (std::abs(steps - std::round(steps)) * period_s < 1e-3) ++even;
  }
  return static_cast<double>(even) / static_cast<double>(track.pictures.size() - 1);
}

TEST(MovingDots, ThatCameInBurstsStandAtTheTimesOfTheirCapture) {
  const EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}),
                               .body = wand({0, 0.15, 0.5}),
                               .seconds = 30,
                               .link = two_on_one_adapter()};
  const Capture capture = capture_of(wanted);
  for (const CameraTrack& track : moving_dots(capture, wanted.site.cameras)) {
    ASSERT_GT(track.pictures.size(), 1000u);
    EXPECT_GT(even_share(track, 0.010), 0.75);  // of arrivals: 0.5
    EXPECT_TRUE(std::ranges::is_sorted(track.pictures, {}, &CameraTrack::Picture::t_s));
  }
}

TEST(MovingDots, ThatCameAtOnceStandAtTheirArrivals) {
  for (const double loss : {0.0, 0.05}) {
    const EmulatedCapture wanted{.site = true_site({{-1, 2.3, 5}, {1, 2.3, 5}}),
                                 .body = wand({0, 0.15, 0.5}),
                                 .seconds = 20,
                                 .link = {.loss = loss}};
    const Capture capture = capture_of(wanted);
    const auto tracks = moving_dots(capture, wanted.site.cameras);
    std::vector<std::size_t> next(tracks.size());
    for (const Observation& seen : capture.observations) {
      const auto camera = static_cast<std::size_t>(seen.camera);
      EXPECT_EQ(tracks[camera].pictures[next[camera]++].t_s,
                seconds(seen.arrival.time_since_epoch()));
    }
  }
}

}  // namespace
}  // namespace vindu
