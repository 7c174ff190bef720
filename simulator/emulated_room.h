// The room that replaces the real one on a machine without cameras: people with helmets, and for
// every emulated camera of the site a Wiimote that watches.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "core/site.h"
#include "simulator/emulated_wiimote.h"
#include "simulator/person.h"
#include "tracker/wiimote/emulator_bus.h"

namespace vindu {

/// Of the first camera's Wiimote; bits as in SensorView.
struct ButtonPress {
  std::uint8_t buttons_1 = 0;
  std::uint8_t buttons_2 = 0;
  Time from{};
  Time until{};
};

struct EmulatedRoomOptions {
  PersonOptions person{};
  /// Who walk about, each with the helmet of a [[head]] of the site in their order; at most as
  /// many. Several share the width of the place. None stands in another's light.
  std::size_t people = 1;
  std::optional<LedBody> body{};  ///< seen in place of the person's helmet
  /// By camera: how much later than its picture it shows something, besides the link's delay; those
  /// without an entry: not at all.
  std::vector<Duration> late{};
  std::vector<ButtonPress> presses{};
  EmulatedWiimoteOptions wiimote{};  ///< each device derives its own seed from this one
};

/// The clock must outlive the room, and the room its devices and their handles. Its devices are
/// thread-safe, as far as the clock is; each handle is bound to its reader's thread.
class EmulatedRoom {
 public:
  EmulatedRoom(const Site& site, Clock& clock, const EmulatedRoomOptions& options = {});

  /// The truth, for figures and pictures only.
  std::size_t people() const { return people_.size(); }
  const Person& person(std::size_t which = 0) const { return *people_.at(which); }

  /// Opens the device that stands where the site's camera stands.
  std::unique_ptr<HidDevice> connect(std::size_t camera) const;

  /// All of them, in the order of the site's cameras: to be found as real ones are, or broken.
  EmulatedHidBus& bus() const { return *bus_; }

 private:
  std::vector<std::unique_ptr<Person>> people_;  // stay where they are: the devices look at them
  std::unique_ptr<EmulatedHidBus> bus_;
};

}  // namespace vindu
