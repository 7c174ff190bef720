// One joint, robust least-squares fit of a head's pose to all dots of all cameras. How many dots
// which camera sees does not matter: what they do not fix, the prior does; the information says
// which was which, and the thesis' three modes (3.2) are levels of it.
#pragma once

#include <optional>
#include <span>

#include "core/pose.h"
#include "tracker/camera_model.h"

namespace vindu {

/// A dot that is said to be one LED.
struct LedSighting {
  int camera = 0;  ///< index in the list of cameras
  Vec3 led_in_head = Vec3::Zero();
  Vec2 raw_px = Vec2::Zero();
  double sigma_px = 1;
};

using Jacobian26 = Eigen::Matrix<double, 2, 6>;

/// Where an LED's dot is and how it moves with the head: pixels for metres and radians in room, the
/// rotation about the head's origin. Empty when the camera cannot see that point.
struct DotOfLed {
  Vec2 raw_px = Vec2::Zero();
  Jacobian26 d_raw_d_pose;
};
std::optional<DotOfLed> dot_of_led(const CameraModel& camera, const Rigid3& room_from_head,
                                   const Vec3& led_in_head);

/// What is known of a pose beforehand. Zero information: nothing.
struct PosePrior {
  Rigid3 room_from_head;
  Mat6 information = Mat6::Zero();  ///< inverse covariance; position, rotation; both in room
};

/// How heads are held by and large: upright, facing the wall. Of pitch, yaw and roll in room.
inline const Vec3 kFacingSigma_rad = {radians(25), radians(50), radians(20)};

struct PoseFitOptions {
  double huber_sigmas = 2;  ///< residuals beyond count linearly (Huber 1964)
  int max_iterations = 20;
  double converged = 1e-7;  ///< a step, in metres and radians, that ends them
};

struct PoseFit {
  Rigid3 room_from_head;
  Mat6 dot_information = Mat6::Zero();  ///< of the dots alone; robust weights included
  Mat6 information = Mat6::Zero();      ///< with the prior's
  double cost = 0;                      ///< robust, in sigmas squared; the prior's included
  double rms_px = 0;                    ///< of the dots' distances from where they should be
};

/// Levenberg-Marquardt from a start. Empty when an LED would be where its camera cannot see it, or
/// the numbers are degenerate: no dots and no prior.
std::optional<PoseFit> fit_pose(std::span<const CameraModel> cameras,
                                std::span<const LedSighting> sightings, const Rigid3& start,
                                const PosePrior& prior = {}, const PoseFitOptions& options = {});

/// What dots alone fix. Position: to 50 mm in every direction, for a known rotation; else it is a
/// bearing. A direction of rotation counts as fixed to 15 degrees: all three make six_dof, one or
/// two hybrid, none position. No information at all: lost.
TrackingLevel level_of(const Mat6& dot_information);

}  // namespace vindu
