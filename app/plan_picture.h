// The picture of a plan: the room from above, twice (level of tracking, error of the eye), and from
// the side, with wall, cameras and their fields of view, to scale.
#pragma once

#include "app/plan_study.h"
#include "renderer/image.h"

namespace vindu::app {

struct PlanText {
  std::string title;
  std::string subtitle;
};

/// `study` must be of this area.
Image plan_picture(const Site& site, const WalkingArea& area, const Study& study,
                   const PlanText& text);

}  // namespace vindu::app
