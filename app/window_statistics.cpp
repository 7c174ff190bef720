#include "app/window_statistics.h"

#include "app/common.h"

namespace vindu::app {

void WindowStatistics::drew(const DrawCount& count, Duration draw) {
  count_ = count;
  statistics_.drew(count, draw, timer_.newest());
}

void WindowStatistics::showed(const FrameRecord& record) {
  const Duration after_tick = record.parts.motion_to_photon() - record.parts[Part::capture_age];
  statistics_.showed(record.tick + after_tick, record.parts);
}

bool WindowStatistics::on() {
  if (window_.take_presses(WindowKey::f1) % 2 == 1) on_ = !on_;
  return on_;
}

void WindowStatistics::draw_over(const SceneRenderer& renderer) {
  if (!on()) return;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const SizePx size = window_.size();
  const int margin = size.width / 100;
  panel_.draw(statistics_.page("Vindu", host_name(), count_),
              {margin, margin, {size.width - 2 * margin, size.height - 2 * margin}}, renderer);
}

}  // namespace vindu::app
