#include "simulator/emulated_wiimote.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

constexpr double kFalseDot = 0.2;  // as bright as a cluster straight ahead at 2.2 m
constexpr double kNone = 1e-6;     // of brightness: no light at all

// A resting accelerometer shows 1 g upwards. Its axes: x left, y back, z up.
std::array<double, 3> resting_acceleration_g(const Rigid3& camera_from_room) {
  const Vec3 up_in_camera = camera_from_room.rotation * Vec3::UnitY();
  return {-up_in_camera.x(), -up_in_camera.z(), -up_in_camera.y()};
}

}  // namespace

EmulatedSensor::EmulatedSensor(const CameraConfig& config, LedBody body, double noise_px,
                               std::uint64_t seed, std::vector<Glint> glints, double false_dots,
                               std::vector<LedBody> others)
    : camera_(config),
      body_(std::move(body)),
      others_(std::move(others)),
      glints_(std::move(glints)),
      noise_px_(noise_px),
      false_dots_(false_dots),
      random_(seed),
      acceleration_g_(resting_acceleration_g(camera_.camera_from_room())) {
  logic_.start(3);
}

void EmulatedSensor::add_spot(const Vec3& x_in_room, double brightness,
                              std::vector<SensorSpot>& spots) {
  if (brightness < kNone) return;
  const auto raw_px = camera_.project(camera_.camera_from_room() * x_in_room);
  if (!raw_px) return;
  const double x_px = raw_px->x() + random_.normal(noise_px_);
  const double y_px = raw_px->y() + random_.normal(noise_px_);
  spots.push_back({x_px, y_px, brightness});
}

void EmulatedSensor::add_body(const LedBody& body, const Rigid3& room_from_body,
                              std::vector<SensorSpot>& spots) {
  const Vec3 camera_in_body = inverse(room_from_body) * camera_.room_from_camera().translation;
  for (std::size_t led = 0; led < body.leds_in_body.size(); ++led)
    add_spot(room_from_body * body.leds_in_body[led], body.brightness(led, camera_in_body), spots);
}

void EmulatedSensor::add_stray_light(std::vector<SensorSpot>& spots) {
  const Vec3 camera_in_room = camera_.room_from_camera().translation;
  for (const Glint& glint : glints_)
    add_spot(glint.x_in_room, glint.brightness / (glint.x_in_room - camera_in_room).squaredNorm(),
             spots);
  if (false_dots_ > 0 && random_.uniform(0, 1) < false_dots_)
    spots.push_back(
        {random_.uniform(0, kWiimoteWidth_px), random_.uniform(0, kWiimoteHeight_px), kFalseDot});
}

SensorView EmulatedSensor::view(Time time) {
  SensorView view{.acceleration_g = acceleration_g_, .spots = {}};
  add_body(body_, body_.room_from_body(time), view.spots);
  for (const LedBody& other : others_) add_body(other, other.room_from_body(time), view.spots);
  add_stray_light(view.spots);
  return view;
}

SensorView EmulatedSensor::view(const Rigid3& room_from_body) {
  SensorView view{.acceleration_g = acceleration_g_, .spots = {}};
  add_body(body_, room_from_body, view.spots);
  add_stray_light(view.spots);
  return view;
}

SensorState EmulatedSensor::look(const Rigid3& room_from_body) {
  constexpr double kZero_raw = 0x200, kGravity_raw = 0x68;  // WiiBrew's typical values
  const SensorView view = this->view(room_from_body);
  SensorState state;
  for (std::size_t axis = 0; axis < 3; ++axis)
    state.acceleration_raw[axis] =
        static_cast<int>(std::lround(kZero_raw + kGravity_raw * view.acceleration_g[axis]));
  state.slots = logic_.track(view.spots);
  return state;
}

}  // namespace vindu
