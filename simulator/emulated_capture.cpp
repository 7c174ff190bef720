#include "simulator/emulated_capture.h"

#include "tracker/wiimote/reader.h"

namespace vindu {

Capture watch(const EmulatedRoom& room, std::size_t cameras, ManualClock& clock, double seconds,
              const std::function<bool(const Capture&)>& watching) {
  std::vector<WiimoteReader> readers;
  for (std::size_t i = 0; i < cameras; ++i)
    readers.emplace_back(room.connect(i), static_cast<int>(i));
  Capture capture;
  std::vector<std::vector<Vec3>> readings_g(cameras);
  const Time begin = clock.now();
  for (int step = 1; step <= static_cast<int>(100 * seconds); ++step) {
    const Time now = begin + from_seconds(0.01 * step);
    for (std::size_t i = 0; i < cameras; ++i)
      while (const auto sample = readers[i].next_sample(now)) {
        if (const auto seen = readers[i].observation_of(*sample))
          capture.observations.push_back(*seen);
        const auto& calibration = readers[i].session().health().calibration;
        if (!sample->data.acceleration_raw || !calibration) continue;
        const auto g = acceleration_g(*sample->data.acceleration_raw, *calibration);
        readings_g[i].emplace_back(g[0], g[1], g[2]);
      }
    clock.sleep_until(now);
    if (watching && step % 10 == 0 && !watching(capture)) break;
  }
  for (const auto& of_camera : readings_g) capture.up_in_camera.push_back(up_in_camera(of_camera));
  return capture;
}

HiddenTruth hide_truth(const std::vector<CameraConfig>& cameras, std::uint64_t seed) {
  Random random(seed ^ 0x7472757468ULL);
  const auto about = [&](double reach) { return random.uniform(-reach, reach); };
  HiddenTruth truth{cameras, {}};
  for (CameraConfig& camera : truth.cameras) {
    camera.intrinsics.fx_px *= 1 + about(0.02);
    camera.intrinsics.fy_px = camera.intrinsics.fx_px * (1 + about(0.003));
    camera.intrinsics.cx_px += about(10);
    camera.intrinsics.cy_px += about(10);
    camera.intrinsics.distortion[0] += about(0.03);
    camera.room_from_camera.translation += Vec3(about(0.05), about(0.05), about(0.05));
    const Vec3 axis(about(1), about(1), about(1));
    camera.room_from_camera.rotation =
        camera.room_from_camera.rotation *
        Quat(Eigen::AngleAxisd(radians(about(3)), axis.normalized()));
    truth.late.push_back(from_seconds(1e-3 * random.uniform(0, 6)));
  }
  return truth;
}

}  // namespace vindu
