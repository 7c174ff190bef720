// Ties calibrated cameras to the wall: somebody holds one LED to known points of the wall, one
// after the other; what the cameras triangulate there tells how the room must be moved.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/calibration/capture.h"
#include "tracker/point_fit.h"

namespace vindu {

/// A corner of a tile, to be touched.
struct WallTarget {
  std::string name;  ///< "upper left corner of tile-3-1"
  std::string tile;
  Vec3 x_in_wall = Vec3::Zero();
};

/// Tile corners that at least two cameras see, where the site has them: `count` of them, as far
/// from each other as may be. Fewer where there are no more.
std::vector<WallTarget> choose_targets(const Site& site, int count);

/// An LED held still for at least 0.8 s, seen by two cameras or more.
struct Touch {
  Vec3 x_in_room = Vec3::Zero();
  double gap_mm = 0;  ///< by which the cameras' rays pass each other
  double since_s = 0;
};

/// In the order of time; a place is held once, however long. Pictures with several dots are left
/// out.
std::vector<Touch> find_touches(const Capture& capture, const std::vector<CameraConfig>& cameras);

/// How far somebody has come who touches the targets in their order.
struct TouchProgress {
  std::vector<Touch> touches;  ///< of the first targets
  double held = 0;             ///< 0 to 1: how long the LED has been still at the next one
  std::string remark;          ///< why what is seen now, or what was held last, does not count; ""
};

/// A touch counts when its distances from those before are the targets' distances, to 60 mm and
/// 3 %; another one changes nothing.
TouchProgress follow_touches(const Capture& capture, const std::vector<CameraConfig>& cameras,
                             const std::vector<WallTarget>& targets);

struct WallFit {
  Rigid3 room_from_before;           ///< what the cameras' poses are to be moved by
  double rms_mm = 0;                 ///< of the touches from their targets, after it
  double scale = 1;                  ///< of the targets' distances over the touches'
  std::vector<double> residuals_mm;  ///< of each touch
  std::vector<Vec3> targets_in_room{};

  /// Of a point that moves with the cameras, by the touches' errors alone.
  double sigma_mm_at(const Vec3& x_in_room) const {
    return expected_error(targets_in_room, rms_mm, x_in_room);
  }
};

/// The touches in the order of the targets. Throws Error for fewer than three, for points on a
/// line, and for touches that are no such points.
WallFit fit_wall(const std::vector<Touch>& touches, const std::vector<WallTarget>& targets,
                 const Rigid3& room_from_wall);

}  // namespace vindu
