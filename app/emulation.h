// The options of every command that may use emulated Wiimotes: what their radio link is like,
// whether Linux' own driver is at work beside ours, and which buttons are pressed.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "simulator/emulated_room.h"

namespace vindu::app {

struct EmulationOptions {
  std::string link = "good";
  bool kernel = false;
  std::vector<std::string> presses;
};

/// --link good|busy|bad, --kernel, --press BUTTON@SECONDS; without effect on real devices.
void add_emulation(CLI::App& app, EmulationOptions& options);

/// A room in which a person walks from now on; person and devices are of that seed.
EmulatedRoomOptions walking_room(const EmulationOptions& options, std::uint64_t seed, Time now);

/// Presses count from `now` on.
void apply(const EmulationOptions& options, Time now, EmulatedRoomOptions& room);

}  // namespace vindu::app
