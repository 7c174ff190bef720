// The bundle adjustment of the wand calibration, and the covariance of what it finds. Private to
// the wand calibration and its tests.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "core/rigid3.h"
#include "core/site.h"
#include "tracker/calibration/lens.h"
#include "tracker/calibration/wand_views.h"

namespace vindu {

struct AdjustedCamera {
  Rigid3 world_from_camera;
  Lens lens = Lens::Zero();
  double lag_ms = 0;  ///< against the first camera
  LensPrior prior;
  double sigma_px = 1;  ///< of a dot's coordinate
};

/// Of the wand: its middle, and the unit vector from its first LED to its last, in world.
using WandPose = Eigen::Matrix<double, 6, 1>;

struct WandWorld {
  std::vector<AdjustedCamera> cameras;
  std::vector<WandPose> poses;  ///< one a moment
  std::vector<double> leds_m;   ///< from the wand's middle
};

enum class Free {
  poses_only,  ///< of the wand; cameras as they are
  places,      ///< cameras' poses and lags too
  everything,  ///< and their lenses
};

/// Moments that are `used` and not held out (for poses_only: all used), by their used dots; the
/// first camera's pose and lag stay. Robust: Huber's loss.
void adjust(const std::vector<WandMoment>& moments, Free free, WandWorld& world,
            double huber_sigma = 1.5);

/// Of one dot, in pixels, as it is measured less as it is modelled; large where it cannot be seen.
Vec2 residual_px(const WandWorld& world, const WandPose& pose, const WandMoment& moment,
                 const WandView& view, std::size_t led);

/// What a dot's motion within the uncertainty of its time adds to the camera's sigma.
double sigma_px(const AdjustedCamera& camera, const WandView& view, std::size_t led);

/// One sigma of a camera's parameters: position in world, rotation (all axes together), lens, lag.
struct CameraSigma {
  Vec3 position_m = Vec3::Zero();
  double rotation_rad = 0;
  Lens lens = Lens::Zero();
  double lag_ms = 0;
};

enum class SigmaBy {
  noise,  ///< the Cramér-Rao bound: the dots scatter by the cameras' sigmas and nothing is wrong
  residuals,  ///< the same, or what quarters of the capture contradict each other by, where that is
              ///< more: a camera was moved meanwhile, a wand bends
};

/// At this world; the priors count as measurements. Infinite where the dots do not fix something.
std::vector<CameraSigma> sigmas_of(const std::vector<WandMoment>& moments, const WandWorld& world,
                                   SigmaBy by);

}  // namespace vindu
