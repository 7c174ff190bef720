// The room that replaces the real one on a machine without cameras: a person with the helmet, and
// for every emulated camera of the site a Wiimote that watches.
#pragma once

#include <memory>

#include "core/clock.h"
#include "core/site.h"
#include "simulator/emulated_wiimote.h"
#include "simulator/person.h"

namespace vindu {

struct EmulatedRoomOptions {
  PersonOptions person;
  EmulatedWiimoteOptions wiimote;  ///< each device derives its own seed from this one
};

/// The clock must outlive the room, and the room its devices. Connecting is bound to one thread;
/// each device then to its reader's.
class EmulatedRoom {
 public:
  EmulatedRoom(const Site& site, Clock& clock, const EmulatedRoomOptions& options = {});

  /// The truth, for figures and pictures only.
  const Person& person() const { return person_; }

  /// A device that stands where the site's camera stands.
  std::unique_ptr<HidDevice> connect(std::size_t camera) const;

 private:
  std::vector<CameraConfig> cameras_;
  HeadConfig head_;
  Clock& clock_;
  EmulatedRoomOptions options_;
  Person person_;
};

}  // namespace vindu
