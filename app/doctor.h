// What vindu doctor looks at: one function for each part of a machine or of a wall. What is wrong
// is what they return; they do not throw for it.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"

namespace vindu::app {

enum class Health {
  good,
  note,  ///< not there or not at its best; what needs it will say so
  bad,   ///< to be seen to before this machine does its part
};

constexpr std::string_view name_of(Health health) {
  constexpr std::string_view names[] = {"good", "note", "BAD"};
  return names[static_cast<int>(health)];
}

struct Finding {
  std::string part;  ///< "graphics", "network", ...
  Health health = Health::good;
  std::string what;
  std::string remedy{};  ///< empty: there is none, or `what` ends with it
};

using Findings = std::vector<Finding>;

/// Whether it has what every command needs: its files, and a place to keep packed scenes.
Findings examine_files();
/// Draws with and without a window; opens a small one for a moment where there is a display.
Findings examine_graphics();
/// Wiimotes of this machine and its Bluetooth; video cameras that are plugged in.
Findings examine_cameras();

/// The part of this machine in the wall: its tiles, and whether the master is here.
Findings examine_role(const Site& site);
/// The video devices and files that the wall file names, where its master is this machine.
Findings examine_cameras_of(const Site& site);
/// Interface, names of hosts, keys; and who is heard of the wall.
Findings examine_network(const Site& site);
/// What launch, deploy and status need here for a wall over hosts; nothing for others.
Findings examine_programs(const Site& site);

}  // namespace vindu::app
