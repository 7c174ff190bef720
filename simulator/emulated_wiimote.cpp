#include "simulator/emulated_wiimote.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

// Below this a dot does not stand out: a cluster seen straight on is lost beyond 8 m.
constexpr double kFaintest = 1.0 / 64;
constexpr double kGravityRaw = 0x68;  // counts per g (WiiBrew: 0x200 at rest, 0x268 at 1 g)

bool in_picture(const Vec2& raw_px) {
  return raw_px.x() > -0.5 && raw_px.x() < kWiimoteWidth_px - 0.5 && raw_px.y() > -0.5 &&
         raw_px.y() < kWiimoteHeight_px - 0.5;
}

int rounded(double value, int largest) {
  return static_cast<int>(std::clamp(std::lround(value), 0L, static_cast<long>(largest)));
}

// The blob's diameter goes with the root of its light: 3 at 3 m, as a bright LED's.
int size_of(double brightness) { return std::max(1, rounded(9 * std::sqrt(brightness), 15)); }

// A resting accelerometer shows 1 g upwards. Its axes: x left, y back, z up.
std::array<int, 3> resting_acceleration(const Rigid3& camera_from_room) {
  const Vec3 up_in_camera = camera_from_room.rotation * Vec3::UnitY();
  const Vec3 up_in_wiimote(-up_in_camera.x(), -up_in_camera.z(), -up_in_camera.y());
  std::array<int, 3> raw;
  for (int i = 0; i < 3; ++i)
    raw[static_cast<std::size_t>(i)] = rounded(0x200 + kGravityRaw * up_in_wiimote[i], 1023);
  return raw;
}

}  // namespace

EmulatedSensor::EmulatedSensor(const CameraConfig& config, const HeadConfig& head, double noise_px,
                               std::uint64_t seed)
    : camera_(config), helmet_(head), noise_px_(noise_px), random_(seed) {}

std::vector<EmulatedSensor::Spot> EmulatedSensor::four_brightest(
    const Rigid3& room_from_head) const {
  const Rigid3 camera_from_head = camera_.camera_from_room() * room_from_head;
  const Vec3 camera_in_head = inverse(camera_from_head).translation;
  std::vector<Spot> spots;
  for (std::size_t led = 0; led < helmet_.clusters().size(); ++led) {
    const LedCluster& cluster = helmet_.clusters()[led];
    const double brightness = helmet_.brightness(cluster, camera_in_head);
    const auto raw_px = camera_.project(camera_from_head * cluster.x_in_head);
    if (brightness >= kFaintest && raw_px && in_picture(*raw_px))
      spots.push_back({led, *raw_px, brightness});
  }
  std::ranges::stable_sort(spots, std::ranges::greater{}, &Spot::brightness);
  if (spots.size() > 4) spots.resize(4);
  return spots;
}

void EmulatedSensor::assign_slots(const std::vector<Spot>& spots) {
  for (auto& slot : led_of_slot_)
    if (slot && std::ranges::find(spots, *slot, &Spot::led) == spots.end()) slot.reset();
  for (const Spot& spot : spots) {
    if (std::ranges::find(led_of_slot_, std::optional(spot.led)) != led_of_slot_.end()) continue;
    *std::ranges::find(led_of_slot_, std::optional<std::size_t>()) = spot.led;
  }
}

SensorState EmulatedSensor::look(const Rigid3& room_from_head) {
  const auto spots = four_brightest(room_from_head);
  assign_slots(spots);
  SensorState state;
  state.acceleration_raw = resting_acceleration(camera_.camera_from_room());
  for (std::size_t slot = 0; slot < led_of_slot_.size(); ++slot) {
    if (!led_of_slot_[slot]) continue;
    const Spot& spot = *std::ranges::find(spots, *led_of_slot_[slot], &Spot::led);
    const double x_px = spot.raw_px.x() + random_.normal(noise_px_);
    const double y_px = spot.raw_px.y() + random_.normal(noise_px_);
    state.slots[slot] = SensorDot{rounded(x_px, kWiimoteWidth_px - 1),
                                  rounded(y_px, kWiimoteHeight_px - 1), size_of(spot.brightness)};
  }
  return state;
}

EmulatedWiimote::EmulatedWiimote(const CameraConfig& config, const HeadConfig& head,
                                 const Person& person, Clock& clock,
                                 const EmulatedWiimoteOptions& options)
    : person_(person),
      clock_(clock),
      options_(options),
      sensor_(config, head, options.noise_px, options.seed),
      timing_(options.seed ^ 0x5851f42d4c957f2dULL) {}

bool EmulatedWiimote::write(std::span<const std::uint8_t> report) {
  if (report.empty() || report[0] < 0x10 || report[0] > 0x1a) return false;
  if (report[0] != 0x12 || report.size() < 3) return true;
  const bool wanted = report[1] % 8 / 4 == 1 && report[2] == 0x33;
  if (wanted && !streaming_) {
    sample_ = clock_.now() + from_seconds(timing_.uniform(0, seconds(options_.period)));
    arrival_ = sample_ + options_.transport_delay;
  }
  streaming_ = wanted;
  return true;
}

// In order, as one link delivers.
void EmulatedWiimote::plan_next_sample() {
  sample_ += options_.period;
  const Duration jitter = from_seconds(timing_.uniform(0, seconds(options_.transport_jitter)));
  arrival_ = std::max(arrival_, sample_ + options_.transport_delay + jitter);
}

HidRead EmulatedWiimote::read(std::span<std::uint8_t> buffer, Time until) {
  if (!streaming_ || arrival_ > until) {
    clock_.sleep_until(until);
    return {HidStatus::nothing, 0, {}};
  }
  clock_.sleep_until(arrival_);
  const auto bytes = encode_report_0x33(sensor_.look(person_.room_from_head(sample_)));
  const std::size_t size = std::min(bytes.size(), buffer.size());
  std::ranges::copy_n(bytes.begin(), static_cast<std::ptrdiff_t>(size), buffer.begin());
  const HidRead read{HidStatus::report, size, arrival_};
  plan_next_sample();
  return read;
}

}  // namespace vindu
