// What an emulated Wiimote of the virtual room sees: a body's LEDs and whatever reflects them,
// through its lens. Bytes, registers and arrival times are the emulator's in tracker/wiimote/.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.h"
#include "simulator/led_body.h"
#include "tracker/camera_model.h"
#include "tracker/wiimote/emulator_device.h"

namespace vindu {

/// A bright point of the room: a lamp, the sun in a window frame.
struct Glint {
  Vec3 x_in_room = Vec3::Zero();
  double brightness = 0;  ///< as a cluster's, 1 straight ahead at 1 m
};

struct EmulatedWiimoteOptions {
  std::uint64_t seed = 1;
  double noise_px = 0.3;  ///< sigma of each coordinate, before rounding to whole units
  std::vector<Glint> glints;
  double false_dots = 0;  ///< share of pictures with a bright dot at a random place
  /// True: streams dots as soon as report 0x33 is asked for; false: the host must start its camera.
  bool camera_already_on = false;
  LinkOptions link;
  bool one_adapter = false;  ///< for all of a room, whose links then pause in turn
  bool kernel = false;       ///< hid-wiimote interferes, and the battery is read every 10 s
  std::size_t ring = 0;      ///< reports kept for a slow reader; 0: all, hidraw: 64
};

/// The light on the sensor. Bound to one thread.
class EmulatedSensor {
 public:
  /// `others`: bodies beside the first.
  EmulatedSensor(const CameraConfig& config, LedBody body, double noise_px, std::uint64_t seed,
                 std::vector<Glint> glints = {}, double false_dots = 0,
                 std::vector<LedBody> others = {});
  /// Of a helmet.
  EmulatedSensor(const CameraConfig& config, const HeadConfig& head, double noise_px,
                 std::uint64_t seed, std::vector<Glint> glints = {}, double false_dots = 0)
      : EmulatedSensor(config, helmet_body(head, {}), noise_px, seed, std::move(glints),
                       false_dots) {}

  /// What reaches the Wiimote, of the first body there alone.
  SensorView view(const Rigid3& room_from_body);
  /// Of all bodies where they are at that time.
  SensorView view(Time time);

  /// What a camera on the Wii's sensitivity level 4 makes of it, and an accelerometer that shows
  /// 0x200 at 0 g and 0x268 at 1 g.
  SensorState look(const Rigid3& room_from_body);

 private:
  void add_body(const LedBody& body, const Rigid3& room_from_body, std::vector<SensorSpot>& spots);
  void add_stray_light(std::vector<SensorSpot>& spots);
  void add_spot(const Vec3& x_in_room, double brightness, std::vector<SensorSpot>& spots);

  CameraModel camera_;
  LedBody body_;
  std::vector<LedBody> others_;
  std::vector<Glint> glints_;
  double noise_px_;
  double false_dots_;
  Random random_;
  std::array<double, 3> acceleration_g_;
  EmulatedCamera logic_;
};

}  // namespace vindu
