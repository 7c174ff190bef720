// The options of every command that may use emulated Wiimotes: what their radio link is like, and
// whether Linux' own driver is at work beside ours.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "simulator/emulated_wiimote.h"

namespace vindu::app {

struct EmulationOptions {
  std::string link = "good";
  bool kernel = false;
};

/// --link good|busy|bad and --kernel; both without effect on real devices.
void add_emulation(CLI::App& app, EmulationOptions& options);

void apply(const EmulationOptions& options, EmulatedWiimoteOptions& wiimote);

}  // namespace vindu::app
