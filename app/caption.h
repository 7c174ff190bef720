// What a window has to say beside its scene, in the picture's lower left: one line, for a while.
#pragma once

#include <string>

#include "core/clock.h"
#include "renderer/canvas.h"

namespace vindu::app {

class Caption {
 public:
  void say(std::string words, Time until = Time::max());
  /// Empty when there is nothing to say any more.
  const std::string& words(Time now);
  /// Where there is room.
  void draw(Picture& picture, Time now);

 private:
  std::string words_;
  Time until_{};
};

}  // namespace vindu::app
