#include "app/cameras.h"

#include <fmt/format.h>

#include <algorithm>

#include "tracker/ir_camera/ir_camera.h"
#include "tracker/wiimote/find.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {
namespace {

CameraState state_of(const LiveWiimote& wiimote) {
  const LiveWiimoteState state = wiimote.state();
  return {.name = wiimote.name(),
          .connected = state.connected,
          .device = fmt::format("{} ({:04x}:{:04x}), {}", state.device.name, state.device.vendor_id,
                                state.device.product_id, label_of(state.device)),
          .gaps = state.health.gaps,
          .counts = counts_text(state),
          .trouble = trouble_text(state)};
}

}  // namespace

WiimoteSettings wiimote_settings(const CameraConfig& camera, int number) {
  return {.format = camera.dot_format, .sensitivity = camera.sensitivity, .player = number + 1};
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

std::string json_of(const GapCounts& gaps) {
  std::string text;
  for (std::size_t cause = 0; cause < gaps.size(); ++cause)
    if (gaps[cause].gaps)
      text += fmt::format(R"({}"{}":{{"count":{},"longest_ms":{:.1f},"total_ms":{:.1f}}})",
                          text.empty() ? "" : ",", name_of(static_cast<GapCause>(cause)),
                          gaps[cause].gaps, milliseconds(gaps[cause].longest),
                          milliseconds(gaps[cause].total));
  return "{" + text + "}";
}

std::vector<CameraState> Cameras::states() const {
  std::vector<CameraState> states;
  for (const auto& state : states_) states.push_back(state());
  return states;
}

std::unique_ptr<ObservationSource> Cameras::open(const CameraConfig& camera, int number,
                                                 const EmulatedRoom& room) {
  if (camera.source == CameraSource::video) return open_video(camera, number);
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

std::unique_ptr<ObservationSource> Cameras::open_video(const CameraConfig& camera, int number) {
  auto video = make_ir_camera(camera, number, clock_);
  const bool is_file = !camera.video.file.empty();
  CameraState state{.name = camera.name,
                    .device = is_file ? camera.video.file : camera.video.device,
                    .gaps = {},
                    .counts = {},
                    .trouble = {}};
  states_.emplace_back([video = video.get(), is_file, state]() mutable {
    state.connected = !video->gone();
    state.trouble = state.connected ? "" : is_file ? "the video has ended" : "the camera is gone";
    return state;
  });
  return video;
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
  states_.emplace_back([wiimote = wiimote.get()] { return state_of(*wiimote); });
  return wiimote;
}

}  // namespace vindu::app
