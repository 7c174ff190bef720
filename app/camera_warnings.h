// What people should do something about: a camera that was moved, cameras that contradict each
// other or the heads. Said when it becomes so, and when it is over.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/tracker.h"

namespace vindu::app {

class CameraWarnings {
 public:
  explicit CameraWarnings(const Site& site);

  /// Once a frame.
  void look(const Tracker& tracker, Time now);
  /// What contradicts what, and why that may be: "left and right contradict each other by 5 px:
  /// ..." Empty where all agree, more or less.
  std::string misfit(const Tracker& tracker) const;

 private:
  enum class Misfit { none, nothing_fits, contradiction, size };

  Misfit misfit_of(const Tracker& tracker) const;
  std::string text_of(Misfit misfit, const Tracker& tracker) const;

  std::vector<std::string> names_;  // of the cameras, as the next
  std::vector<bool> moved_;
  Time looked_{};
  Misfit told_ = Misfit::none;
};

}  // namespace vindu::app
