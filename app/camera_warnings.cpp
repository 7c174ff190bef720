#include "app/camera_warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/log.h"

namespace vindu::app {

CameraWarnings::CameraWarnings(const Site& site) : moved_(site.cameras.size(), false) {
  for (const CameraConfig& camera : site.cameras) names_.push_back(camera.name);
}

/// What was told stays so until it is clearly less.
CameraWarnings::Misfit CameraWarnings::misfit_of(const Tracker& tracker) const {
  constexpr double kTold_px = 1.5, kTold = 0.01, kOver = 0.7;
  const auto limit = [&](Misfit misfit) { return told_ == misfit ? kOver : 1; };
  if (tracker.nothing_fits()) return Misfit::nothing_fits;
  if (tracker.disagreement_px() > kTold_px * limit(Misfit::contradiction))
    return Misfit::contradiction;
  if (std::abs(tracker.heads_look_larger()) > kTold * limit(Misfit::size)) return Misfit::size;
  return Misfit::none;
}

std::string CameraWarnings::text_of(Misfit misfit, const Tracker& tracker) const {
  const double larger = tracker.heads_look_larger();
  switch (misfit) {
    case Misfit::none:
      return "";
    case Misfit::nothing_fits:
      return "the cameras see dots enough, but these fit no head of the wall file: its leds_m are "
             "not those of this helmet, or the cameras' poses do not hold";
    case Misfit::contradiction:
      return fmt::format(
          "{} contradict each other by {:.0f} px: one was moved, or their "
          "calibration does not hold",
          names_.size() == 2 ? names_[0] + " and " + names_[1] : "the cameras",
          tracker.disagreement_px());
    case Misfit::size:
      return fmt::format(
          "heads look {:.1f} % {} than where the cameras see them, and may be off "
          "by as much of their distance: a camera was moved, or a focal length or "
          "the head's leds_m is wrong",
          100 * std::abs(larger), larger > 0 ? "larger" : "smaller");
  }
  return "";
}

std::string CameraWarnings::misfit(const Tracker& tracker) const {
  return text_of(misfit_of(tracker), tracker);
}

void CameraWarnings::look(const Tracker& tracker, Time now) {
  if (now - looked_ < std::chrono::seconds(1)) return;
  looked_ = now;
  const auto health = tracker.camera_health();
  for (std::size_t i = 0; i < health.size(); ++i) {
    if (health[i].moved == moved_[i]) continue;
    moved_[i] = health[i].moved;
    if (moved_[i])
      log_warning(names_[i],
                  "was moved: its dots do not fit what the others see, and count for less; "
                  "calibrate it again (vindu calibrate)");
    else
      log_info(names_[i], "agrees with the others again");
  }
  const Misfit now_misfit = misfit_of(tracker);
  if (std::exchange(told_, now_misfit) == now_misfit) return;
  if (now_misfit == Misfit::none)
    log_info("cameras", "agree with each other and with the heads again");
  else
    log_warning("cameras", text_of(now_misfit, tracker) +
                               "; calibrate (vindu calibrate wand, vindu calibrate head)");
}

}  // namespace vindu::app
