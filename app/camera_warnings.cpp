#include "app/camera_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/log.h"

namespace vindu::app {
namespace {

/// What was wrong is not over before it has not been so for this time: people move in between.
constexpr Duration kOver = std::chrono::seconds(30);

}  // namespace

bool stands_aside(const CameraHealth& camera) {
  constexpr double kTold_px = 2;
  return camera.aside_px > kTold_px;
}

// Two LEDs leave open how the head turns about their line, and where it is drawn to pulls at their
// size: of helmets of 0.1 to 0.3 m on exact cameras the figure's standard error was 0.8 mm over the
// way from LED to LED, four to five times that of three LEDs. Three LEDs or more stay below 0.4 %.
double size_that_counts(const Site& site) {
  constexpr double kUsual = 0.01, kStandardError_m = 0.0008, kSigmas = 5;
  double counts = kUsual;
  for (const HeadConfig& head : site.heads)
    if (const auto& leds = head.leds_in_head; leds.size() == 2)
      counts = std::max(counts, kSigmas * kStandardError_m / (leds[1] - leds[0]).norm());
  return counts;
}

CameraWarnings::CameraWarnings(const Site& site) : size_that_counts_(size_that_counts(site)) {
  for (const CameraConfig& camera : site.cameras) cameras_.push_back({.name = camera.name});
}

CameraWarnings::Misfit CameraWarnings::misfit_of(const Tracker& tracker) const {
  constexpr double kTold_px = 1.5;
  return {.nothing_fits = tracker.nothing_fits(),
          .contradiction = tracker.disagreement_px() > kTold_px,
          .size = std::abs(tracker.heads_look_larger()) > size_that_counts_};
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

CameraWarnings::Complaint::News CameraWarnings::Complaint::look(bool wrong, Time now) {
  if (wrong) wrong_last_ = now;
  if (wrong && !std::exchange(told_, true)) return News::begins;
  if (!told_ || now - wrong_last_ <= kOver) return News::none;
  told_ = false;
  return News::over;
}

void CameraWarnings::look_at_cameras(const Tracker& tracker, Time now) {
  using News = Complaint::News;
  const auto health = tracker.camera_health();
  for (std::size_t i = 0; i < health.size(); ++i) {
    Camera& camera = cameras_[i];
    const News moved = camera.moved.look(health[i].moved, now);
    const News off = camera.aside.look(stands_aside(health[i]), now);
    if (moved == News::begins)
      log_warning(camera.name,
                  "was moved: its dots do not fit what the others see, and count for less; "
                  "calibrate it again (vindu calibrate)");
    else if (off == News::begins && !camera.moved.told())
      log_warning(camera.name,
                  fmt::format("its dots stand {:.0f} px aside of where the others expect them: it "
                              "was moved a little, or its calibration does not hold; calibrate it "
                              "again (vindu calibrate)",
                              health[i].aside_px));
    const bool over = moved == News::over || off == News::over;
    if (over && !camera.moved.told() && !camera.aside.told())
      log_info(camera.name, "agrees with the others again");
  }
}

void CameraWarnings::look_at_misfit(const Tracker& tracker, Time now) {
  using News = Complaint::News;
  const Misfit misfit = misfit_of(tracker);
  const std::array news = {nothing_fits_.look(misfit.nothing_fits, now),
                           contradiction_.look(misfit.contradiction, now),
                           size_.look(misfit.size, now)};
  if (std::ranges::find(news, News::begins) != news.end())
    log_warning("cameras", text_of(misfit, tracker) +
                               "; calibrate (vindu calibrate wand, vindu calibrate head)");
  if (std::ranges::find(news, News::over) != news.end() && !nothing_fits_.told() &&
      !contradiction_.told() && !size_.told())
    log_info("cameras", "agree with each other and with the heads again");
}

}  // namespace vindu::app
