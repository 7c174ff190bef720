// What a tracker finds, as lines of JSON: poses, gestures, and cameras whose state changed. Used
// live and on recordings, so that both say the same.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/gestures.h"
#include "tracker/tracker.h"

namespace vindu::app {

/// --target NAME,x,y,z,radius, to be given any number of times.
void add_targets(CLI::App& app, std::vector<std::string>& texts);
/// Of texts that the command line has let pass.
std::vector<LookTarget> targets_from(const std::vector<std::string>& texts);

class PoseLines {
 public:
  PoseLines(const Site& site, std::vector<LookTarget> targets);

  /// The lines that are new since the last frame; times are moved by `shift`. A pose is news when
  /// it rests on newer dots or its level changed.
  std::vector<std::string> news(const Tracker& tracker, Duration shift);

  /// Gestures of the last frame.
  const std::vector<GestureEvent>& events() const { return events_; }

 private:
  void add_events(const PoseSample& pose, Duration shift, std::vector<std::string>& lines);
  void add_health(const Tracker& tracker, Time time, Duration shift,
                  std::vector<std::string>& lines);

  const Site& site_;
  std::vector<LookTarget> targets_;
  std::map<int, PoseSample> said_;
  std::map<int, GestureDetector> detectors_;
  std::vector<GestureEvent> events_;
  std::vector<CameraHealth> health_;
};

}  // namespace vindu::app
