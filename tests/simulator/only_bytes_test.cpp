// The truth of the virtual room cannot reach the tracker: whatever it says of a live, emulated head
// it says again, to the last bit, of nothing but recorded bytes and arrival times. (That tracker/
// includes nothing of simulator/ is a check of the layers.)
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "simulator/emulated_room.h"
#include "tracker/recording_devices.h"
#include "tracker/tracker.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

class OnlyBytes : public ::testing::Test {
 protected:
  OnlyBytes()
      : site_(read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml")),
        file_(std::filesystem::path(::testing::TempDir()) /
              ("only_bytes_" + std::to_string(getpid()) + ".vrec")) {}
  ~OnlyBytes() override { std::filesystem::remove(file_); }

  /// What a tracker says of three seconds, frame by frame.
  std::vector<PoseSample> track(Clock& clock, std::vector<std::unique_ptr<HidDevice>> devices) {
    std::vector<WiimoteReader> readers;
    for (std::size_t i = 0; i < devices.size(); ++i)
      readers.emplace_back(std::move(devices[i]), static_cast<int>(i));
    Tracker tracker(site_.cameras, site_.heads, site_.wall.room_from_wall);
    std::vector<PoseSample> poses;
    for (int tick = 1; tick <= 180; ++tick) {
      clock.sleep_until(Time{from_seconds(tick / 60.0)});
      const Time now = clock.now();
      for (WiimoteReader& reader : readers)
        while (const auto seen = reader.next(now)) tracker.absorb(*seen);
      if (const auto pose = tracker.track(now, now + milliseconds(30))) poses.push_back(*pose);
    }
    return poses;
  }

  std::vector<PoseSample> live(const EmulatedRoomOptions& options) {
    RecordingInfo info;
    for (std::size_t i = 0; i < site_.cameras.size(); ++i)
      info.devices.push_back({static_cast<int>(i), site_.cameras[i].name});
    ManualClock clock;
    const EmulatedRoom room(site_, clock, options);
    RecordingWriter writer(file_.string(), info);
    std::vector<std::unique_ptr<HidDevice>> devices;
    for (std::size_t i = 0; i < site_.cameras.size(); ++i)
      devices.push_back(
          std::make_unique<RecordingHidDevice>(room.connect(i), writer, static_cast<int>(i)));
    return track(clock, std::move(devices));
  }

  std::vector<PoseSample> again() {
    ManualClock clock;
    std::vector<std::unique_ptr<HidDevice>> devices;
    for (std::size_t i = 0; i < site_.cameras.size(); ++i)
      devices.push_back(
          std::make_unique<ReplayHidDevice>(file_.string(), static_cast<int>(i), clock));
    return track(clock, std::move(devices));
  }

  Site site_;
  std::filesystem::path file_;
};

/// No tolerance, and no -0 = 0.
bool same_bits(const PoseSample& a, const PoseSample& b) {
  const auto same = [](const auto& x, const auto& y) {
    return std::memcmp(x.data(), y.data(), sizeof(double) * static_cast<std::size_t>(x.size())) ==
           0;
  };
  return a.time == b.time && a.capture_time == b.capture_time && a.level == b.level &&
         same(a.room_from_head.translation, b.room_from_head.translation) &&
         same(a.room_from_head.rotation.coeffs(), b.room_from_head.rotation.coeffs()) &&
         same(a.velocity_in_room_m_s, b.velocity_in_room_m_s) && same(a.covariance, b.covariance);
}

TEST_F(OnlyBytes, AndArrivalsGiveTheSamePosesToTheLastBit) {
  EmulatedRoomOptions options;
  options.wiimote.link = bad_link();
  options.wiimote.false_dots = 0.1;
  const std::vector<PoseSample> of_head = live(options), of_bytes = again();
  EXPECT_GT(of_head.size(), 120u);
  ASSERT_EQ(of_head.size(), of_bytes.size());
  for (std::size_t i = 0; i < of_head.size(); ++i)
    EXPECT_TRUE(same_bits(of_head[i], of_bytes[i])) << "frame " << i;
}

}  // namespace
}  // namespace vindu
