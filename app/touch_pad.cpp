#include "app/touch_pad.h"

#include <cmath>

#include "renderer/diagram.h"

namespace vindu::app {
namespace {

constexpr int kLongest_px = 900;

SizePx pad_size(const Wall& wall) {
  const double aspect = wall.grid.height_m / wall.grid.width_m;
  const double width = aspect < 1 ? kLongest_px : kLongest_px / aspect;
  return {static_cast<int>(std::lround(width)), static_cast<int>(std::lround(width * aspect))};
}

}  // namespace

TouchPad::TouchPad(const Wall& wall)
    : wall_(wall),
      window_(make_window({.size = pad_size(wall), .title = "Vindu: the hand before the wall"})),
      renderer_(Style::unlit) {}

bool TouchPad::show() {
  if (const SizePx size = window_->size(); size.width > 0 && size.height > 0) {
    Picture picture(size, Style::unlit);
    picture.write(drawn(size));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.width, size.height);
    renderer_.present(picture, {});
  }
  window_->present();
  return !window_->close_wanted();
}

std::optional<TuioChange> TouchPad::take_change() {
  const Vec2 pointer = window_->pointer();  // -1 to 1, y up
  const Vec2 at(0.5 + 0.5 * pointer.x(), 0.5 - 0.5 * pointer.y());
  const bool inside = at.minCoeff() >= 0 && at.maxCoeff() <= 1;
  if (!inside || hand_ == at) return std::nullopt;
  const EventPhase phase = hand_ ? EventPhase::change : EventPhase::begin;
  hand_ = at;
  return TuioChange{"pointer", phase, 1, at};
}

Image TouchPad::drawn(SizePx size) const {
  Diagram diagram(size, kPaper);
  const WallGrid& grid = wall_.grid;
  const Vec2 whole(size.width, size.height);
  for (int column = 0; column <= grid.columns; ++column) {
    const double x = whole.x() * column / grid.columns;
    diagram.line({x, 0}, {x, whole.y()}, 1, kDim);
  }
  for (int row = 0; row <= grid.rows; ++row) {
    const double y = whole.y() * row / grid.rows;
    diagram.line({0, y}, {whole.x(), y}, 1, kDim);
  }
  const TextStyle style{.height_px = 14, .colour = kDim};
  diagram.text({8, 6}, hand_ ? "the eye is before the dot" : "move the pointer here", style);
  if (hand_) diagram.disc(hand_->cwiseProduct(whole), 9, kVermilion);
  return diagram.image();
}

}  // namespace vindu::app
