// Where to mount N cameras so that a head is known well all over a walking area: places on rails
// and in corners, from several beginnings exchanged one by one while that helps (as Fedorov 1972,
// Theory of Optimal Experiments, chooses measurements), the best then moved and aimed by ever
// smaller steps. The same input gives the same places.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tracker/coverage.h"

namespace vindu {

/// A straight line in room on which cameras can be mounted; both ends equal: one place.
struct Rail {
  Vec3 from_in_room = Vec3::Zero();
  Vec3 to_in_room = Vec3::Zero();
};

struct PlacementTask {
  HeadConfig head;
  std::vector<Rigid3> poses;  ///< room_from_head: what is to be covered
  std::vector<Rail> rails;
  /// Points that cameras may be aimed at to begin with, in room; their height stays as it is.
  std::vector<Vec3> aims_in_room;
  CameraConfig camera;        ///< lens and kind of all cameras
  double good_eye_m = 0.010;  ///< a pose is covered when it is six-dof with this bound or less
  double spacing_m = 0.5;     ///< of places on a rail, to begin with

  /// Throws Error when there is nothing to cover, to aim at or to mount on.
  void validate() const;
};

/// Whether a pose is covered: six-dof, and the eye's bound is good.
bool covered(const PoseBound& bound, double good_eye_m);

/// What the placement maximises, averaged over poses: 1 to 1.1 for a covered one, more the smaller
/// its error; less than 1 for one of a lower level or a larger error, so that the first cameras,
/// which cannot cover anything alone, still have a way up.
double worth(const PoseBound& bound, double good_eye_m);

/// Told how far the search is, 0 to 1.
using SearchProgress = std::function<void(double share)>;

/// Cameras "plan-1" to "plan-N". Throws Error for a task that cannot be done.
std::vector<CameraConfig> place_cameras(const PlacementTask& task, int count, const DotNoise& noise,
                                        const SearchProgress& progress = {});

}  // namespace vindu
