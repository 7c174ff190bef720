#include "simulator/emulated_room.h"

#include <cassert>

namespace vindu {

EmulatedRoom::EmulatedRoom(const Site& site, Clock& clock, const EmulatedRoomOptions& options)
    : cameras_(site.cameras),
      head_(site.head),
      clock_(clock),
      options_(options),
      person_(site.head, site.wall.room_from_wall, options.person) {}

std::unique_ptr<HidDevice> EmulatedRoom::connect(std::size_t camera) const {
  assert(camera < cameras_.size());
  EmulatedWiimoteOptions options = options_.wiimote;
  options.seed += 0x9e3779b97f4a7c15ULL * (camera + 1);
  return std::make_unique<EmulatedWiimote>(cameras_[camera], head_, person_, clock_, options);
}

}  // namespace vindu
