// What people should do something about: a camera that was moved, cameras that contradict each
// other. Said when it becomes so, and when it is over.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/tracker.h"

namespace vindu::app {

/// What contradicts what, and why that may be: "left and right contradict each other by 5 px: ...".
/// Empty where all agree, more or less.
std::string misfit_text(const Site& site, const Tracker& tracker);

/// The site must outlive it.
class CameraWarnings {
 public:
  explicit CameraWarnings(const Site& site) : site_(site), moved_(site.cameras.size(), false) {}

  /// Once a frame.
  void look(const Tracker& tracker, Time now);

 private:
  const Site& site_;
  Time looked_{};
  std::vector<bool> moved_;
  bool misfit_ = false;  // that was told
};

}  // namespace vindu::app
