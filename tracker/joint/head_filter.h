// An error-state Kalman filter of one head: pose and velocity, moved on in time and corrected by
// single dots of any camera, each at the time it was captured (SCAAT: Welch & Bishop 1997). Values
// and functions; who calls them keeps the order of time.
#pragma once

#include <optional>

#include "core/pose.h"
#include "tracker/joint/pose_fit.h"

namespace vindu {

using Mat18 = Eigen::Matrix<double, 18, 18>;

/// Rates of something that moves, in room.
struct Motion {
  Vec3 velocity = Vec3::Zero();      ///< metres or radians a second
  Vec3 acceleration = Vec3::Zero();  ///< a second squared
};

/// Which way dots have pulled a rate lately: the sum of their corrections of it, which fades, and
/// what variance that has while the motion is as expected. Corrections differ in sign then
/// (innovations are white: Kailath 1968); those of a motion that goes on unforeseen add up.
struct Pull {
  Vec3 sum = Vec3::Zero();
  Vec3 variance = Vec3::Zero();
};

/// The error is (position, velocity, acceleration, rotation vector, angular velocity, angular
/// acceleration), all in room; metres, radians, seconds.
struct HeadState {
  Time time{};
  Rigid3 room_from_head;
  Motion move{};
  Motion turn{};
  Pull move_pull{};  ///< of the velocity
  Pull turn_pull{};  ///< of the angular velocity
  Mat18 covariance = Mat18::Zero();
};

/// White jerk, as its spectral density, in room.
struct MotionNoise {
  Mat3 move_m2_s5 = 2 * Mat3::Identity();
  Mat3 turn_rad2_s5 = 8 * Mat3::Identity();
};

/// How hard a head that moves like this may be accelerating: little at rest, more the faster it
/// moves, most of it that way. One fixed value serves either a still head or a fast one.
MotionNoise noise_of_motion(const HeadState& state);

/// What else there is of it where dots enough tell: more the harder the head accelerates, and the
/// more dots pull one way.
MotionNoise noise_of_change(const HeadState& state);

struct MotionOptions {
  Duration move_damping = Duration::zero();  ///< velocity dies out with this time constant; 0: not
  Duration turn_damping = Duration::zero();
};

/// To a later time, with velocities that are drawn back to zero. Earlier times are an error of the
/// caller (assert).
void propagate(HeadState& state, Time to, const MotionNoise& noise,
               const MotionOptions& options = {});

/// Where the filter expects an LED's dot, and how well it knows.
struct ExpectedDot {
  Vec2 raw_px = Vec2::Zero();
  Jacobian26 d_raw_d_pose;
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  ///< of the head's uncertainty alone
  Vec2 raw_px_s = Vec2::Zero();                              ///< how fast it moves
};

/// Empty when the camera cannot see that point.
std::optional<ExpectedDot> expect_dot(const HeadState& state, const CameraModel& camera,
                                      const Vec3& led_in_head);

/// Takes in a dot that was captured at the state's time. `noise_px2`: covariance of the dot.
void correct(HeadState& state, const ExpectedDot& expected, const Vec2& raw_px,
             const Eigen::Matrix2d& noise_px2);

/// Takes in, after so long a time, that heads are held as kFacingSigma_rad says: what dots leave
/// open of the rotation is drawn there, slowly; what they fix hardly moves.
void expect_facing(HeadState& state, Duration passed);

/// What nobody sees: how the head turns about an axis (a unit vector) dies out but for that share,
/// and so does what its other errors say of the angle.
void calm_turning(HeadState& state, const Vec3& axis_in_room, double share_left);

/// For a head that is found not to be where it should, or set off unforeseen: centimetres and
/// degrees of doubt, and of its motion where that is asked for.
void widen(HeadState& state, bool motion_too);

/// The head at rest where a fit found it: velocities unknown, as fast as people move.
HeadState state_of(const PoseFit& fit, Time time);

/// What others see of it, at the state's own time.
PoseSample sample_of(const HeadState& state);

struct AheadOptions {
  Duration limit = std::chrono::milliseconds(60);  ///< error grows with its square (Azuma & Bishop)
  double still_m_s = 0.02;                         ///< below, motion is noise: nothing is predicted
  double still_rad_s = 0.05;                       ///< 3 degrees a second
};

/// The pose `ahead` of the state's time, and its covariance there: at most the limit, and the
/// motion faded when the head is still.
PoseSample predicted(const HeadState& state, Duration ahead, const AheadOptions& options = {});

}  // namespace vindu
