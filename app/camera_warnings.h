// What people should do something about: a camera that was moved, cameras that contradict each
// other or the heads. Said when it becomes so, and when it is over.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/tracker.h"

namespace vindu::app {

/// Whether a camera of three or more stands aside of where the others expect its dots, by more than
/// is usual.
bool stands_aside(const CameraHealth& camera);

/// From which share on heads that look larger or smaller than they should tell that something is
/// wrong. Less is usual, or with helmets of two LEDs what the figure strays by itself.
double size_that_counts(const Site& site);

class CameraWarnings {
 public:
  explicit CameraWarnings(const Site& site);

  /// Once a frame.
  void look(const Tracker& tracker, Time now);
  /// What contradicts what, and why that may be: "left and right contradict each other by 5 px:
  /// ..." Empty where all agree, more or less.
  std::string misfit(const Tracker& tracker) const;

 private:
  /// Of one thing that may be wrong: what is to be told of it.
  class Complaint {
   public:
    enum class News { none, begins, over };
    News look(bool wrong, Time now);
    bool told() const { return told_; }

   private:
    bool told_ = false;
    Time wrong_last_{};
  };
  struct Camera {
    std::string name;
    Complaint moved{}, aside{};
  };
  struct Misfit {
    bool nothing_fits = false, contradiction = false, size = false;
  };

  Misfit misfit_of(const Tracker& tracker) const;
  std::string text_of(const Misfit& misfit, const Tracker& tracker) const;
  void look_at_cameras(const Tracker& tracker, Time now);
  void look_at_misfit(const Tracker& tracker, Time now);

  std::vector<Camera> cameras_;
  double size_that_counts_;
  Time looked_{};
  Complaint nothing_fits_, contradiction_, size_;
};

}  // namespace vindu::app
