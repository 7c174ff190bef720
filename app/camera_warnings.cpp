#include "app/camera_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "core/log.h"

namespace vindu::app {
namespace {

/// What was wrong is not over before it has not been so for this time: people move in between.
constexpr Duration kOver = std::chrono::seconds(30);

}  // namespace

CameraWarnings::CameraWarnings(const Site& site) {
  for (const CameraConfig& camera : site.cameras) cameras_.push_back({.name = camera.name});
}

CameraWarnings::Misfit CameraWarnings::misfit_of(const Tracker& tracker) const {
  constexpr double kTold_px = 1.5, kTold = 0.01;
  return {.nothing_fits = tracker.nothing_fits(),
          .contradiction = tracker.disagreement_px() > kTold_px,
          .size = std::abs(tracker.heads_look_larger()) > kTold};
}

std::string CameraWarnings::text_of(const Misfit& misfit, const Tracker& tracker) const {
  if (misfit.nothing_fits)
    return "the cameras see dots enough, but these fit no head of the wall file: its leds_m are "
           "not those of this helmet, or the cameras' poses do not hold";
  std::string text;
  if (misfit.contradiction)
    text = fmt::format(
        "{} contradict each other by {:.0f} px: one was moved, or their calibration "
        "does not hold",
        cameras_.size() == 2 ? cameras_[0].name + " and " + cameras_[1].name : "the cameras",
        tracker.disagreement_px());
  const double larger = tracker.heads_look_larger();
  if (misfit.size)
    text += fmt::format(
        "{}heads look {:.1f} % {} than where the cameras see them, and may be off "
        "by as much of their distance: a camera was moved, or a focal length or "
        "the head's leds_m is wrong",
        text.empty() ? "" : "; ", 100 * std::abs(larger), larger > 0 ? "larger" : "smaller");
  return text;
}

std::string CameraWarnings::misfit(const Tracker& tracker) const {
  return text_of(misfit_of(tracker), tracker);
}

void CameraWarnings::look(const Tracker& tracker, Time now) {
  if (now - looked_ < std::chrono::seconds(1)) return;
  looked_ = now;
  look_at_cameras(tracker, now);
  look_at_misfit(tracker, now);
}

void CameraWarnings::look_at_cameras(const Tracker& tracker, Time now) {
  const auto health = tracker.camera_health();
  for (std::size_t i = 0; i < health.size(); ++i) {
    Camera& camera = cameras_[i];
    if (health[i].moved) camera.moved_last = now;
    if (health[i].moved && !camera.moved)
      log_warning(camera.name,
                  "was moved: its dots do not fit what the others see, and count for less; "
                  "calibrate it again (vindu calibrate)");
    if (camera.moved && now - camera.moved_last > kOver)
      log_info(camera.name, "agrees with the others again");
    camera.moved = now - camera.moved_last <= kOver && (camera.moved || health[i].moved);
  }
}

void CameraWarnings::look_at_misfit(const Tracker& tracker, Time now) {
  const Misfit misfit = misfit_of(tracker);
  if (misfit.any()) misfit_last_ = now;
  const bool news = (misfit.nothing_fits && !told_.nothing_fits) ||
                    (misfit.contradiction && !told_.contradiction) || (misfit.size && !told_.size);
  if (news)
    log_warning("cameras", text_of(misfit, tracker) +
                               "; calibrate (vindu calibrate wand, vindu calibrate head)");
  told_.nothing_fits |= misfit.nothing_fits;
  told_.contradiction |= misfit.contradiction;
  told_.size |= misfit.size;
  if (!told_.any() || now - misfit_last_ <= kOver) return;
  log_info("cameras", "agree with each other and with the heads again");
  told_ = {};
}

}  // namespace vindu::app
