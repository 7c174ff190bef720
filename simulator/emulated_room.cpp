#include "simulator/emulated_room.h"

#include <cassert>
#include <fstream>
#include <iterator>

#include "renderer/resources.h"

namespace vindu {
namespace {

constexpr Duration kBatteryReadEvery = std::chrono::seconds(10);

std::vector<std::uint8_t> memory_image() {
  std::ifstream file(find_asset("wiimote/eeprom.bin"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

EmulatedDeviceOptions device_options(const EmulatedWiimoteOptions& wiimote, std::uint64_t seed,
                                     const CameraConfig& camera) {
  EmulatedDeviceOptions options;
  options.info.address = camera.address;
  options.seed = seed;
  options.link = wiimote.link;
  options.ring = wiimote.ring;
  if (wiimote.kernel)
    options.kernel = KernelOptions{.battery_read_every = kBatteryReadEvery, .seed = seed};
  options.firmware.eeprom = memory_image();
  options.firmware.camera_already_on = wiimote.camera_already_on;
  Random random(seed ^ 0x5851f42d4c957f2dULL);
  options.firmware.phase = from_seconds(random.uniform(0, seconds(options.firmware.report_period)));
  return options;
}

/// Each in a part of the width that the first would have alone.
PersonOptions person_options(const PersonOptions& first, std::size_t which, std::size_t people) {
  PersonOptions options = first;
  options.seed += 0x9e3779b97f4a7c15ULL * which;
  const double width_m = first.largest_eye_in_room.x() - first.least_eye_in_room.x();
  const auto edge_m = [&](std::size_t part) {
    return first.least_eye_in_room.x() +
           width_m * static_cast<double>(part) / static_cast<double>(people);
  };
  options.least_eye_in_room.x() = edge_m(which);
  options.largest_eye_in_room.x() = edge_m(which + 1);
  return options;
}

void press(const std::vector<ButtonPress>& presses, Time time, SensorView& view) {
  for (const ButtonPress& press : presses) {
    if (time < press.from || time >= press.until) continue;
    view.buttons_1 |= press.buttons_1;
    view.buttons_2 |= press.buttons_2;
  }
}

}  // namespace

EmulatedRoom::EmulatedRoom(const Site& site, Clock& clock, const EmulatedRoomOptions& options)
    : bus_(std::make_unique<EmulatedHidBus>(clock)) {
  std::vector<LedBody> bodies = options.body ? std::vector{*options.body} : std::vector<LedBody>{};
  for (std::size_t i = 0; i < options.people; ++i) {
    const HeadConfig& head = site.heads.at(i);
    people_.push_back(std::make_unique<Person>(head, site.wall.room_from_wall,
                                               person_options(options.person, i, options.people)));
    if (!options.body)
      bodies.push_back(helmet_body(head, [person = people_.back().get()](Time time) {
        return person->room_from_head(time);
      }));
  }
  const LedBody first = bodies.front();
  bodies.erase(bodies.begin());
  for (std::size_t i = 0; i < site.cameras.size(); ++i) {
    const std::uint64_t seed = options.wiimote.seed + 0x9e3779b97f4a7c15ULL * (i + 1);
    EmulatedSensor sensor(site.cameras[i], first, options.wiimote.noise_px, seed,
                          options.wiimote.glints, options.wiimote.false_dots, bodies);
    const Duration late = i < options.late.size() ? options.late[i] : Duration{};
    const auto presses = i == 0 ? options.presses : std::vector<ButtonPress>{};
    EmulatedDeviceOptions device = device_options(options.wiimote, seed, site.cameras[i]);
    if (options.wiimote.one_adapter && site.cameras.size() > 1)
      device.link.shared = AdapterShare{.place = static_cast<int>(i),
                                        .of = static_cast<int>(site.cameras.size()),
                                        .seed = options.wiimote.seed,
                                        .begin = clock.now()};
    bus_->add(std::move(device), [sensor, late, presses](Time time) mutable {
      SensorView view = sensor.view(time - late);
      press(presses, time, view);
      return view;
    });
  }
}

std::unique_ptr<HidDevice> EmulatedRoom::connect(std::size_t camera) const {
  assert(camera < bus_->size());
  return bus_->open(bus_->path(camera));
}

}  // namespace vindu
