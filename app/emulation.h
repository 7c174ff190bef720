// The options of every command that may use emulated Wiimotes: what their radio link is like,
// whether Linux' own driver is at work beside ours, and which buttons are pressed.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulator/emulated_room.h"

namespace vindu::app {

struct EmulationOptions {
  std::string link = "good";
  bool kernel = false;
  std::size_t people = 1;
  std::vector<std::string> presses;
};

/// --link good|busy|bad, --kernel, --people N, --press BUTTON@SECONDS; without effect on real
/// devices.
void add_emulation(CLI::App& app, EmulationOptions& options);

/// Throws CLI::ValidationError (called wrong) for presses that come after a run's end.
void refuse_late_presses(const EmulationOptions& options, const std::optional<double>& seconds);

/// A room in which people walk from now on; they and devices are of that seed. Throws Error for
/// more people than the site has heads.
EmulatedRoomOptions walking_room(const EmulationOptions& options, const Site& site,
                                 std::uint64_t seed, Time now);

/// Presses count from `now` on.
void apply(const EmulationOptions& options, Time now, EmulatedRoomOptions& room);

}  // namespace vindu::app
