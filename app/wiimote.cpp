// vindu wiimote: the parent of the sub-commands that see to Wiimotes, and what they share.
#include "app/wiimote.h"

#include "app/common.h"
#include "tracker/wiimote/hidapi_bus.h"

namespace vindu::app {

WiimoteBus::WiimoteBus(bool emulated, const EmulationOptions& emulation) {
  EmulatedRoomOptions room;
  apply(emulation, clock_.now(), room);
  if (emulated)
    room_ = std::make_unique<EmulatedRoom>(load_site(""), clock_, room);
  else
    real_ = make_hidapi_bus(clock_);
}

void add_emulated(CLI::App& app, bool& emulated) {
  app.add_flag("--emulated", emulated,
               "Emulated Wiimotes that watch a simulated person, instead of this machine's");
}

void add_wiimote(CLI::App& parent, Action& chosen) {
  CLI::App* app =
      parent.add_subcommand("wiimote", "See to Wiimotes: list, identify, watch, pair, emulate");
  app->require_subcommand(1);
  add_wiimote_list(*app, chosen);
  add_wiimote_identify(*app, chosen);
  add_wiimote_watch(*app, chosen);
  add_wiimote_emulate(*app, chosen);
  add_wiimote_pair(*app, chosen);
  app->footer(
      "\nExamples:\n"
      "  vindu wiimote list\n"
      "  vindu wiimote identify 2\n"
      "  vindu wiimote watch --emulated\n"
      "  vindu wiimote pair\n");
}

}  // namespace vindu::app
