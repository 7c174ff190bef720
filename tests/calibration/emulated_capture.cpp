#include "tests/calibration/emulated_capture.h"

#include "simulator/emulated_capture.h"

namespace vindu::testing {

Capture capture_of(const EmulatedCapture& wanted) {
  ManualClock clock;
  EmulatedRoomOptions options;
  options.body = wanted.body;
  options.late = wanted.late;
  options.wiimote.noise_px = wanted.noise_px;
  options.wiimote.seed = wanted.seed;
  options.wiimote.glints = wanted.glints;
  options.wiimote.link = wanted.link;
  options.wiimote.camera_already_on = true;
  const EmulatedRoom room(wanted.site, clock, options);
  return watch(room, wanted.site.cameras.size(), clock, wanted.seconds);
}

Site true_site(const std::vector<Vec3>& positions_in_room) {
  const Intrinsics lenses[] = {{1312, 1316, 520, 377, {0.03, 0, 0, 0, 0}},
                               {1355, 1351, 503, 392, {-0.02, 0, 0, 0, 0}},
                               {1298, 1300, 515, 390, {0.05, 0, 0, 0, 0}},
                               {1340, 1338, 498, 380, {0.01, 0, 0, 0, 0}}};
  Site site;
  site.wall = single_screen(5.185, 2.238, 1024, 768);
  for (const Vec3& position : positions_in_room) {
    CameraConfig camera;
    camera.name = "camera-" + std::to_string(site.cameras.size());
    camera.intrinsics = lenses[site.cameras.size() % 4];
    camera.room_from_camera = look_at(position, {0, 1.65, 2.0});
    site.cameras.push_back(camera);
  }
  return site;
}

LedBody wand(std::vector<double> leds_m, std::uint64_t seed, double tempo_hz) {
  std::vector<Vec3> leds;
  for (const double along_m : leds_m) leds.emplace_back(along_m - 0.5 * leds_m.back(), 0, 0);
  WaveOptions wave;
  wave.seed = seed;
  wave.tempo_hz = tempo_hz;
  wave.room_from_rest.translation = {0, 1.65, 2.0};
  wave.reach_m = {0.8, 0.6, 0.7};
  return bare_leds(leds, waved(wave));
}

}  // namespace vindu::testing
