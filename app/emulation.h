// The options of every command that may use emulated Wiimotes: what their radio link is like, and
// whether Linux' own driver is at work beside ours.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "simulator/emulated_room.h"

namespace vindu::app {

struct EmulationOptions {
  std::string link = "good";
  bool kernel = false;
};

/// --link good|busy|bad and --kernel; both without effect on real devices.
void add_emulation(CLI::App& app, EmulationOptions& options);

/// A room in which a person walks from now on; person and devices are of that seed.
EmulatedRoomOptions walking_room(const EmulationOptions& options, std::uint64_t seed, Time now);

void apply(const EmulationOptions& options, EmulatedWiimoteOptions& wiimote);

}  // namespace vindu::app
