// Reads one Wiimote: bytes of a HID device in, samples or observations out; starts its camera and
// keeps it going. Whether the device is real, emulated or recorded cannot be told from here.
#pragma once

#include <memory>
#include <optional>

#include "tracker/observation_source.h"
#include "tracker/wiimote/hid_device.h"
#include "tracker/wiimote/session.h"

namespace vindu {

/// Bound to one thread.
class WiimoteReader final : public ObservationSource {
 public:
  /// `camera` is the index in the site's list that the observations carry.
  WiimoteReader(std::unique_ptr<HidDevice> device, int camera,
                const WiimoteSettings& settings = {});

  /// The next sample that arrives no later than `until`, which must not go back; call it until it
  /// is empty. Empty for ever once the device is gone.
  std::optional<WiimoteSample> next_sample(Time until);
  /// The next sample that can have dots, also when there are none in view.
  std::optional<Observation> next(Time until) override;
  /// Empty for samples of reports that carry no dots.
  std::optional<Observation> observation_of(const WiimoteSample& sample) const;

  bool gone() const override { return gone_; }
  /// The device refused twice what was written to it last: it is gone, or the empty slot of an
  /// adapter.
  bool refuses() const { return refuses_; }
  void disconnect() { device_.reset(), gone_ = true; }
  /// Goes on with the device after it was away.
  void reconnect(std::unique_ptr<HidDevice> device, Time now);

  WiimoteSession& session() { return session_; }
  const WiimoteSession& session() const { return session_; }

 private:
  void write_outputs();

  std::unique_ptr<HidDevice> device_;
  int camera_;
  WiimoteSession session_;
  Time now_ = Time::min();  // of the last report, or as long as was waited
  bool gone_ = false;
  bool refuses_ = false;
};

}  // namespace vindu
