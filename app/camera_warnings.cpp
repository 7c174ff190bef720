#include "app/camera_warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/log.h"

namespace vindu::app {

namespace {

/// How far apart the dots that one head should have are, beyond noise.
std::string contradiction_text(const Site& site, double sigma_px) {
  constexpr double kTold_px = 1.5;
  if (sigma_px < kTold_px) return "";
  const std::string who = site.cameras.size() == 2
                              ? site.cameras[0].name + " and " + site.cameras[1].name
                              : "the cameras";
  return fmt::format(
      "{} contradict each other by {:.0f} px: one was moved, or their calibration "
      "does not hold",
      who, sigma_px);
}

std::string size_text(double larger) {
  constexpr double kTold = 0.01;
  if (std::abs(larger) < kTold) return "";
  return fmt::format(
      "heads look {:.1f} % {} than where the cameras see them, and may be off by as "
      "much of their distance: a camera was moved, or a focal length or the head's "
      "leds_m is wrong",
      100 * std::abs(larger), larger > 0 ? "larger" : "smaller");
}

}  // namespace

std::string misfit_text(const Site& site, const Tracker& tracker) {
  if (tracker.nothing_fits())
    return "the cameras see dots enough, but these fit no head of the wall file: its leds_m are "
           "not those of this helmet, or the cameras' poses do not hold";
  const std::string text = contradiction_text(site, tracker.disagreement_px());
  return text.empty() ? size_text(tracker.heads_look_larger()) : text;
}

void CameraWarnings::look(const Tracker& tracker, Time now) {
  if (now - looked_ < std::chrono::seconds(1)) return;
  looked_ = now;
  const auto health = tracker.camera_health();
  for (std::size_t i = 0; i < health.size(); ++i) {
    if (health[i].moved == moved_[i]) continue;
    moved_[i] = health[i].moved;
    if (moved_[i])
      log_warning(site_.cameras[i].name,
                  "was moved: its dots do not fit what the others see, and count for less; "
                  "calibrate it again (vindu calibrate)");
    else
      log_info(site_.cameras[i].name, "agrees with the others again");
  }
  const std::string text = misfit_text(site_, tracker);
  if (text.empty() != misfit_) return;
  misfit_ = !text.empty();
  if (misfit_)
    log_warning("cameras", text + "; calibrate (vindu calibrate wand, vindu calibrate head)");
  else
    log_info("cameras", "agree with each other and with the heads again");
}

}  // namespace vindu::app
