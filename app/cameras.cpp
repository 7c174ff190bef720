#include "app/cameras.h"

#include <algorithm>

#include "tracker/camera_model.h"
#include "tracker/ir_camera/ir_camera.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {

WiimoteSettings wiimote_settings(const CameraConfig& camera, int number) {
  return {.format = camera.dot_format, .sensitivity = camera.sensitivity, .player = number + 1};
}

Vec2 picture_size_px(const CameraConfig& camera) {
  if (camera.source == CameraSource::video)
    return Vec2(camera.video.width_px, camera.video.height_px);
  return {kWiimoteWidth_px, kWiimoteHeight_px};
}

bool all_emulated(const Site& site) {
  return std::ranges::all_of(site.cameras, [](const CameraConfig& camera) {
    return camera.source == CameraSource::emulated;
  });
}

Cameras::Cameras(const Site& site, const EmulatedRoom& room, Clock& clock,
                 const CamerasOptions& options)
    : clock_(clock), options_(options) {
  for (const CameraConfig& camera : site.cameras)
    sources_.push_back(open(camera, static_cast<int>(sources_.size()), room));
}

std::vector<CameraState> Cameras::states() const {
  std::vector<CameraState> states;
  for (const LiveWiimote* camera : live_) {
    const LiveWiimoteState state = camera->state();
    states.push_back({camera->name(), state.health.gaps, state.trouble});
  }
  return states;
}

std::unique_ptr<ObservationSource> Cameras::open(const CameraConfig& camera, int number,
                                                 const EmulatedRoom& room) {
  if (camera.source == CameraSource::video) return make_ir_camera(camera, number, clock_);
  if (camera.source == CameraSource::wiimote) {
    if (!bus_) bus_ = make_hidapi_bus(clock_);
    return open_live(*bus_, camera.address, camera, number);
  }
  const auto index = static_cast<std::size_t>(number);
  if (options_.threads) {
    EmulatedHidBus& bus = room.bus();
    return open_live(bus, bus.device(index).options().info.address, camera, number);
  }
  auto device = room.connect(index);
  if (options_.tap) device = options_.tap(std::move(device), number);
  return std::make_unique<WiimoteReader>(std::move(device), number,
                                         wiimote_settings(camera, number));
}

std::unique_ptr<ObservationSource> Cameras::open_live(HidBus& bus, const std::string& address,
                                                      const CameraConfig& camera, int number) {
  LiveWiimoteOptions live{.camera = number,
                          .name = camera.name,
                          .address = address,
                          .path = {},
                          .settings = wiimote_settings(camera, number),
                          .on_sample = {},
                          .tap = {}};
  if (options_.tap)
    live.tap = [tap = options_.tap, number](std::unique_ptr<HidDevice> device) {
      return tap(std::move(device), number);
    };
  auto wiimote = std::make_unique<LiveWiimote>(bus, clock_, claims_, live);
  live_.push_back(wiimote.get());
  return wiimote;
}

}  // namespace vindu::app
