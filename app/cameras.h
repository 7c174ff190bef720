// The cameras that a site names, opened: Wiimotes of this machine, emulated ones, video cameras and
// files, in any mixture. Everything above sees observations alone.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/site.h"
#include "simulator/emulated_room.h"
#include "tracker/observation_source.h"
#include "tracker/wiimote/live.h"

namespace vindu::app {

struct CamerasOptions {
  /// A thread for each Wiimote, emulated or not, as in daily use. Without, an emulated one is read
  /// by whoever asks for its observations: under a manual clock runs are bit-equal.
  bool threads = true;
  /// What the reports of a Wiimote pass through on their way to the driver.
  std::function<std::unique_ptr<HidDevice>(std::unique_ptr<HidDevice>, int camera)> tap;
};

/// How a camera is that may go and come back.
struct CameraState {
  std::string name;
  bool connected = false;
  std::string device;             ///< the last one, for people
  std::optional<GapCounts> gaps;  ///< of a Wiimote's stream
  std::string counts;             ///< of what else its driver had to do
  std::string trouble;            ///< now; empty when there is none
};

/// Number, longest and total of the gaps of each cause, as a JSON object.
std::string json_of(const GapCounts& gaps);

/// Room and clock must outlive this. Bound to one thread.
class Cameras {
 public:
  /// Throws Error for what cannot be opened. A Wiimote that is not there yet is waited for.
  Cameras(const Site& site, const EmulatedRoom& room, Clock& clock,
          const CamerasOptions& options = {});

  /// In the order of the site's cameras.
  const std::vector<std::unique_ptr<ObservationSource>>& sources() const { return sources_; }
  /// Of all but emulated Wiimotes without a thread.
  std::vector<CameraState> states() const;

 private:
  std::unique_ptr<ObservationSource> open(const CameraConfig& camera, int number,
                                          const EmulatedRoom& room);
  std::unique_ptr<ObservationSource> open_video(const CameraConfig& camera, int number);
  std::unique_ptr<ObservationSource> open_live(HidBus& bus, const std::string& address,
                                               const CameraConfig& camera, int number);

  Clock& clock_;
  CamerasOptions options_;
  WiimoteClaims claims_;
  std::unique_ptr<HidBus> bus_;  // of this machine, once a camera needs it
  std::vector<std::unique_ptr<ObservationSource>> sources_;
  std::vector<std::function<CameraState()>> states_;  // of some of the sources
};

/// The simulated person is what the cameras see: nothing else moves the eye.
bool all_emulated(const Site& site);

/// What the wall file says of a Wiimote.
WiimoteSettings wiimote_settings(const CameraConfig& camera, int number);

}  // namespace vindu::app
