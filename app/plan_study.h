// What cameras are worth to somebody who walks before a wall: the bound of every pose of a walking
// area, gathered by place for pictures and by level for figures.
#pragma once

#include <array>
#include <vector>

#include "core/site.h"
#include "tracker/camera_placement.h"

namespace vindu::app {

constexpr int kLevels = 6;

/// Where the eyes may be, and how far the head turns. x and z are of room.
struct WalkingArea {
  Vec2 least_in_room = Vec2::Zero();
  Vec2 largest_in_room = Vec2::Zero();
  std::vector<double> eye_heights_m;  ///< above the floor
  double yaw_deg = 40;                ///< to either side of straight at the wall

  double size_m2() const { return (largest_in_room - least_in_room).prod(); }
};

/// As wide as the wall and 0.6 times as deep, from 0.15 of its width on, and around the default
/// eye; eyes 0.1 m below and above it.
WalkingArea area_before(const Site& site);

/// Poses all over the area, `step_m` apart at most, at each height, with `yaws` headings; those of
/// one place follow each other.
std::vector<Rigid3> poses_in(const WalkingArea& area, double step_m, int yaws,
                             const HeadConfig& head);

struct Cell {
  TrackingLevel level = TrackingLevel::lost;  ///< that half of the headings and heights reach
  double eye_m = 0;                           ///< median; infinite where most have none
  bool always_covered = false;
};

/// Squares over a rectangle of a plan (x, z) or section (z, y), rows along the second coordinate.
struct CellGrid {
  Vec2 least = Vec2::Zero();
  Vec2 largest = Vec2::Zero();
  int columns = 0;
  int rows = 0;
  std::vector<Cell> cells;
};

/// Of the poses at one level; metres and radians, 0 where there is no such pose or no bound.
struct LevelFigures {
  double share = 0;  ///< of all poses
  double eye_median_m = 0;
  double eye_p95_m = 0;
  double lateral_median_m = 0;
  double depth_median_m = 0;
  double rotation_median_rad = 0;
};

struct Study {
  std::vector<CameraConfig> cameras;
  CellGrid plan;
  CellGrid section;                          ///< through the middle of the area
  std::array<LevelFigures, kLevels> levels;  ///< indexed by TrackingLevel
  double covered_share = 0;                  ///< six-dof with a good bound
  double always_covered_m2 = 0;  ///< floor on which that holds for all headings, heights
};

Study study(const std::vector<CameraConfig>& cameras, const HeadConfig& head, const DotNoise& noise,
            const WalkingArea& area, double good_eye_m);

}  // namespace vindu::app
