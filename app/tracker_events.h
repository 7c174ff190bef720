// What people tell by their heads and by the buttons of the cameras that see them: gestures, looks
// at things, presses of buttons; as events of the bus, too.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "cluster/messages.h"
#include "core/site.h"
#include "tracker/gestures.h"
#include "tracker/tracker.h"

namespace vindu::app {

/// --target NAME,x,y,z,radius, to be given any number of times.
CLI::Option* add_targets(CLI::App& app, std::vector<std::string>& texts);
/// Of texts that the command line has let pass.
std::vector<LookTarget> targets_from(const std::vector<std::string>& texts);

/// The gestures of everybody who is tracked. The site must outlive this.
class HeadGestures {
 public:
  HeadGestures(const Site& site, std::vector<LookTarget> targets);

  /// Those that the tracker's last frame completed.
  std::vector<GestureEvent> news(const Tracker& tracker);

 private:
  const Site& site_;
  std::vector<LookTarget> targets_;
  std::map<int, GestureDetector> detectors_;  // by object
};

/// From the tracker of that host. To keep looking at a thing is to pick it.
EventMessage message_of(const GestureEvent& event, const std::string& host);
EventMessage message_of(const ButtonChange& change, const Site& site, const std::string& host);

}  // namespace vindu::app
