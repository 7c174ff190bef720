#include "app/emulation.h"

namespace vindu::app {

void add_emulation(CLI::App& app, EmulationOptions& options) {
  app.add_option("--link", options.link,
                 "Radio of emulated Wiimotes. good: evenly; busy: in bursts, as two on one "
                 "adapter;\nbad: also 5 % lost, and late")
      ->check(CLI::IsMember({"good", "busy", "bad"}))
      ->type_name("good|busy|bad");
  app.add_flag("--kernel", options.kernel,
               "Linux' own driver disturbs emulated Wiimotes; the battery is read every 10 s");
}

void apply(const EmulationOptions& options, EmulatedWiimoteOptions& wiimote) {
  if (options.link == "busy") wiimote.link = two_on_one_adapter();
  if (options.link == "bad") wiimote.link = bad_link();
  wiimote.kernel = options.kernel;
}

EmulatedRoomOptions walking_room(const EmulationOptions& options, std::uint64_t seed, Time now) {
  EmulatedRoomOptions room;
  room.person.seed = room.wiimote.seed = seed;
  room.person.start = now;
  apply(options, room.wiimote);
  return room;
}

}  // namespace vindu::app
