// The page that a wall shows while somebody holds an LED to points of it, one after the other. It
// is a value, and what a tile shows of it follows from the page and the tile's corners alone: tiles
// of one process or of many agree, rings that lie across a seam meet there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/rigid3.h"

namespace vindu {

constexpr std::size_t kMostTouchPoints = 20;  ///< of a page that a running wall shows

struct TouchPage {
  struct Point {
    Vec3 x_in_wall = Vec3::Zero();
    std::string tile{};  ///< the one that says what to do here

    bool operator==(const Point&) const = default;
  };
  std::vector<Point> points{};  ///< in the order in which they are touched
  std::size_t done = 0;         ///< so many are
  double held = 0;              ///< 0 to 1: how long the LED has been at the next one
  std::string remark{};         ///< why what is seen does not count; or ""
  double ring_m = 0.1;          ///< radius of the mark about the next point

  bool operator==(const TouchPage&) const = default;
};

}  // namespace vindu
