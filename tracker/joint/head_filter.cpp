#include "tracker/joint/head_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "tracker/joint/rotation.h"

namespace vindu {
namespace {

constexpr int kPosition = 0, kVelocity = 3, kRotation = 9, kTurning = 12;
constexpr double kReturn_rad_s = 2.5;  // of people's velocities, to zero: 0.4 Hz
constexpr double kPull_s = 0.05;       // what dots pulled by is forgotten with

/// What a velocity and an acceleration have come to after a while, for each unit of them.
struct Course {
  double way_by_velocity_s = 0;
  double way_by_acceleration_s2 = 0;
  double velocity_left = 1;
  double velocity_by_acceleration_s = 0;
  double acceleration_by_velocity_per_s = 0;
  double acceleration_left = 1;

  Vec3 way(const Motion& motion) const {
    return way_by_velocity_s * motion.velocity + way_by_acceleration_s2 * motion.acceleration;
  }
  /// The same rates, and a share of the way.
  Course shortened(double share) const {
    Course course = *this;
    course.way_by_velocity_s *= share;
    course.way_by_acceleration_s2 *= share;
    return course;
  }
  Motion after(const Motion& motion) const {
    return {
        velocity_left * motion.velocity + velocity_by_acceleration_s * motion.acceleration,
        acceleration_by_velocity_per_s * motion.velocity + acceleration_left * motion.acceleration};
  }
};

// Velocities of a second-order Gauss-Markov process (Gelb, "Applied optimal estimation", 1974, 3),
// half critically damped: da/dt = -k a - k^2 v; its integral gives the way. Damped by the caller:
// v(t) = v exp(-t / damping), and no acceleration.
Course course_of(double dt_s, Duration damping) {
  if (damping > Duration::zero()) {
    const double left = std::exp(-dt_s / seconds(damping));
    return {seconds(damping) * (1 - left), 0, left, 0, 0, left};
  }
  constexpr double k = kReturn_rad_s, kDecay = k / 2;
  const double beat = k * std::sqrt(0.75), left = std::exp(-kDecay * dt_s);
  const double cosine = left * std::cos(beat * dt_s), sine = left * std::sin(beat * dt_s) / beat;
  Course course{.velocity_left = cosine + kDecay * sine,
                .velocity_by_acceleration_s = sine,
                .acceleration_by_velocity_per_s = -k * k * sine,
                .acceleration_left = cosine - kDecay * sine};
  course.way_by_velocity_s =
      (k * (1 - course.velocity_left) - course.acceleration_by_velocity_per_s) / (k * k);
  course.way_by_acceleration_s2 =
      (1 - course.acceleration_left - k * course.velocity_by_acceleration_s) / (k * k);
  return course;
}

/// Columns of position, velocity and acceleration, each three, moved on.
void carry(Mat18& covariance, int at, const Course& course) {
  auto place = covariance.middleCols<3>(at), velocity = covariance.middleCols<3>(at + 3),
       acceleration = covariance.middleCols<3>(at + 6);
  place += course.way_by_velocity_s * velocity + course.way_by_acceleration_s2 * acceleration;
  const Eigen::Matrix<double, 18, 3> before = velocity;
  velocity = course.velocity_left * before + course.velocity_by_acceleration_s * acceleration;
  acceleration =
      course.acceleration_by_velocity_per_s * before + course.acceleration_left * acceleration;
}

// Of white jerk over dt (Bar-Shalom, Li & Kirubarajan, "Estimation with applications", 6.2.3).
void add_noise(Mat18& covariance, int at, const Mat3& density, double dt_s) {
  const double dt2 = dt_s * dt_s, dt3 = dt2 * dt_s;
  const double noise[3][3] = {{dt3 * dt2 / 20, dt2 * dt2 / 8, dt3 / 6},
                              {dt2 * dt2 / 8, dt3 / 3, dt2 / 2},
                              {dt3 / 6, dt2 / 2, dt_s}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      covariance.block<3, 3>(at + 3 * i, at + 3 * j) += noise[i][j] * density;
}

/// Zero up to `from`, one from `to` on, without a corner.
double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Rigid3 moved(const Rigid3& pose, const Vec3& way, const Vec3& turn) {
  return {(rotation_of(turn) * pose.rotation).normalized(), pose.translation + way};
}

using Vec18 = Eigen::Matrix<double, 18, 1>;

/// What a measurement changed of the state, and that change's variance.
struct Correction {
  Vec18 step;
  Vec18 variance;
};

/// By N numbers that differ by `surprise` from what the state says. `spread`: its covariance with
/// them; `expected`: theirs, with their noise. With a root of that, what is taken off the
/// covariance is a square, and symmetric. Joseph's form is not needed: nothing is ever measured
/// exactly.
template <int N>
Correction take_in(HeadState& state, const Eigen::Matrix<double, 18, N>& spread,
                   const Eigen::Matrix<double, N, N>& expected,
                   const Eigen::Matrix<double, N, 1>& surprise) {
  using MatN = Eigen::Matrix<double, N, N>;
  const MatN root = expected.llt().matrixL();
  const MatN whiten = root.inverse();
  const Eigen::Matrix<double, 18, N> whitened = spread.lazyProduct(whiten.transpose());
  const Vec18 step = whitened.lazyProduct((whiten * surprise).eval());
  state.covariance.noalias() -= whitened.lazyProduct(whitened.transpose());
  state.room_from_head = moved(state.room_from_head, step.template segment<3>(kPosition),
                               step.template segment<3>(kRotation));
  state.move.velocity += step.template segment<3>(kVelocity);
  state.move.acceleration += step.template segment<3>(kVelocity + 3);
  state.turn.velocity += step.template segment<3>(kTurning);
  state.turn.acceleration += step.template segment<3>(kTurning + 3);
  return {step, whitened.rowwise().squaredNorm()};
}

void pull_by(Pull& pull, const Correction& correction, int at) {
  pull.sum += correction.step.segment<3>(at);
  pull.variance += correction.variance.segment<3>(at);
}

void fade(Pull& pull, double left) {
  pull.sum *= left;
  pull.variance *= left * left;
}

/// Nine parts in ten along the vector: who moves one way does not accelerate in all others alike.
Mat3 mostly_along(const Vec3& vector) {
  constexpr double kAcross = 0.1;
  return kAcross * vector.squaredNorm() * Mat3::Identity() +
         (1 - kAcross) * vector * vector.transpose();
}

/// A rate or an acceleration, less a part of its noise: all of it would keep a start unnoticed for
/// longer.
Vec3 beyond_noise(const HeadState& state, const Vec3& vector, int at) {
  constexpr double kNoise = 0.25;  // of its variance
  const double square = vector.squaredNorm();
  const double beyond = square - kNoise * state.covariance.diagonal().segment<3>(at).sum();
  return beyond > 0 ? Vec3(std::sqrt(beyond / square) * vector) : Vec3(Vec3::Zero());
}

/// In sigmas, beyond what is usual: squares of 2.5, as the mean of three axes.
Vec3 unforeseen(const Pull& pull) {
  constexpr double kUsual = 2.5;
  if (pull.variance.minCoeff() <= 0) return Vec3::Zero();
  const Vec3 sigmas = pull.sum.cwiseQuotient(pull.variance.cwiseSqrt());
  const double square = sigmas.squaredNorm() / 3;
  return square > kUsual ? Vec3(std::sqrt((1 - kUsual / square) / 3) * sigmas) : Vec3(Vec3::Zero());
}

}  // namespace

// Found by trial on simulated heads that rest, sway, walk, start and stop, at up to 1.13 m/s: the
// figures may be halved or doubled for a few per cent. A sine's jerk goes with its speed, and so
// does its square, which a density is, with the speed's.
MotionNoise noise_of_motion(const HeadState& state) {
  constexpr double kRest_m2_s5 = 0.02, kBySpeed_per_s3 = 10;  // and the same in radians
  return {kRest_m2_s5 * Mat3::Identity() +
              kBySpeed_per_s3 * mostly_along(beyond_noise(state, state.move.velocity, kVelocity)),
          kRest_m2_s5 * Mat3::Identity() +
              kBySpeed_per_s3 * mostly_along(beyond_noise(state, state.turn.velocity, kTurning))};
}

MotionNoise noise_of_change(const HeadState& state) {
  constexpr double kByAcceleration_per_s = 4, kByPull_m2_s5 = 6;  // and the same in radians
  const auto by = [&](const Motion& motion, const Pull& pull, int at) -> Mat3 {
    return kByAcceleration_per_s * mostly_along(beyond_noise(state, motion.acceleration, at)) +
           kByPull_m2_s5 * mostly_along(unforeseen(pull));
  };
  return {by(state.move, state.move_pull, kVelocity + 3),
          by(state.turn, state.turn_pull, kTurning + 3)};
}

namespace {

/// Place, rates and covariance, all but the noise.
void follow(HeadState& state, const Course& course, const Course& turning) {
  const Vec3 turn = turning.way(state.turn);
  const Mat3 turned = rotation_of(turn).toRotationMatrix();
  Mat18& covariance = state.covariance;
  for (int side = 0; side < 2; ++side) {  // P F^T, then (P F^T)^T F^T; columns lie together
    if (side == 1) covariance.transposeInPlace();
    auto angles = covariance.middleCols<3>(kRotation);
    angles = angles.lazyProduct(turned.transpose()).eval();
    carry(covariance, kPosition, course);
    carry(covariance, kRotation, turning);
  }
  for (int i = 1; i < covariance.cols(); ++i)  // the same on both sides, to the last bit
    covariance.col(i).head(i) = covariance.row(i).head(i);
  state.room_from_head = moved(state.room_from_head, course.way(state.move), turn);
  state.move = course.after(state.move);
  state.turn = turning.after(state.turn);
}

}  // namespace

void propagate(HeadState& state, Time to, const MotionNoise& noise, const MotionOptions& options) {
  assert(to >= state.time);
  const double dt_s = seconds(to - state.time);
  if (dt_s == 0) return;
  follow(state, course_of(dt_s, options.move_damping), course_of(dt_s, options.turn_damping));
  add_noise(state.covariance, kPosition, noise.move_m2_s5, dt_s);
  add_noise(state.covariance, kRotation, noise.turn_rad2_s5, dt_s);
  for (Pull* pull : {&state.move_pull, &state.turn_pull}) fade(*pull, std::exp(-dt_s / kPull_s));
  state.time = to;
}

std::optional<ExpectedDot> expect_dot(const HeadState& state, const CameraModel& camera,
                                      const Vec3& led_in_head) {
  const auto dot = dot_of_led(camera, state.room_from_head, led_in_head);
  if (!dot) return std::nullopt;
  ExpectedDot expected{.raw_px = dot->raw_px, .d_raw_d_pose = dot->d_raw_d_pose};
  const auto& by_position = dot->d_raw_d_pose.leftCols<3>();
  const auto& by_rotation = dot->d_raw_d_pose.rightCols<3>();
  const auto& covariance = state.covariance;
  const Eigen::Matrix2d mixed =
      by_position * covariance.block<3, 3>(kPosition, kRotation) * by_rotation.transpose();
  expected.covariance_px2 =
      by_position * covariance.block<3, 3>(kPosition, kPosition) * by_position.transpose() +
      by_rotation * covariance.block<3, 3>(kRotation, kRotation) * by_rotation.transpose() + mixed +
      mixed.transpose();
  expected.raw_px_s = by_position * state.move.velocity + by_rotation * state.turn.velocity;
  return expected;
}

void correct(HeadState& state, const ExpectedDot& expected, const Vec2& raw_px,
             const Eigen::Matrix2d& noise_px2) {
  const auto& by_position = expected.d_raw_d_pose.leftCols<3>();
  const auto& by_rotation = expected.d_raw_d_pose.rightCols<3>();
  const Eigen::Matrix<double, 18, 2> spread =
      state.covariance.middleCols<3>(kPosition) * by_position.transpose() +
      state.covariance.middleCols<3>(kRotation) * by_rotation.transpose();
  const Correction correction =
      take_in<2>(state, spread, expected.covariance_px2 + noise_px2, raw_px - expected.raw_px);
  pull_by(state.move_pull, correction, kVelocity);
  pull_by(state.turn_pull, correction, kTurning);
}

// The prior as a measurement of the rotation alone. One that is independent of the last comes each
// kAnew; in between there is the part of one that goes with the time.
void expect_facing(HeadState& state, Duration passed) {
  constexpr Duration kAnew = std::chrono::milliseconds(300);
  if (passed <= Duration::zero()) return;
  const Eigen::Matrix<double, 18, 3> spread = state.covariance.middleCols<3>(kRotation);
  const Mat3 noise = (kFacingSigma_rad.cwiseAbs2() * (1.0 * kAnew / passed)).asDiagonal();
  take_in<3>(state, spread, spread.middleRows<3>(kRotation) + noise,
             -vector_of(state.room_from_head.rotation));
}

void calm_turning(HeadState& state, const Vec3& axis_in_room, double share_left) {
  const Mat3 along = axis_in_room * axis_in_room.transpose();
  const Mat3 kept = Mat3::Identity() - (1 - share_left) * along;
  for (Vec3* rate : {&state.turn.velocity, &state.turn.acceleration}) *rate = kept * *rate;
  Mat18& covariance = state.covariance;
  const Mat3 angles = covariance.block<3, 3>(kRotation, kRotation);
  for (const int at : {kRotation, kTurning, kTurning + 3}) {
    covariance.middleRows<3>(at) = (kept * covariance.middleRows<3>(at)).eval();
    covariance.middleCols<3>(at) = (covariance.middleCols<3>(at) * kept).eval();
  }
  covariance.block<3, 3>(kRotation, kRotation) +=
      (1 - share_left * share_left) * axis_in_room.dot(angles * axis_in_room) * along;
}

void widen(HeadState& state, bool motion_too) {
  const auto add = [&](int at, double place, double rate, double acceleration) {
    auto diagonal = state.covariance.diagonal();
    diagonal.segment<3>(at).array() += place * place;
    if (!motion_too) return;
    diagonal.segment<3>(at + 3).array() += rate * rate;
    diagonal.segment<3>(at + 6).array() += acceleration * acceleration;
  };
  add(kPosition, 0.015, 0.15, 1.5);
  const bool turns = state.covariance(kRotation, kRotation) > 0;
  if (turns) add(kRotation, radians(2), 0.5, 5);
}

HeadState state_of(const PoseFit& fit, Time time) {
  constexpr double kSpeed_m_s = 0.5, kTurning_rad_s = 1.5;
  constexpr double kAcceleration_m_s2 = 2, kAcceleration_rad_s2 = 8;
  HeadState state{.time = time, .room_from_head = fit.room_from_head};
  const Mat6 covariance = fit.information.inverse();
  state.covariance.block<3, 3>(kPosition, kPosition) = covariance.topLeftCorner<3, 3>();
  state.covariance.block<3, 3>(kPosition, kRotation) = covariance.topRightCorner<3, 3>();
  state.covariance.block<3, 3>(kRotation, kPosition) = covariance.bottomLeftCorner<3, 3>();
  state.covariance.block<3, 3>(kRotation, kRotation) = covariance.bottomRightCorner<3, 3>();
  state.covariance.diagonal().segment<3>(kVelocity).setConstant(kSpeed_m_s * kSpeed_m_s);
  state.covariance.diagonal()
      .segment<3>(kVelocity + 3)
      .setConstant(std::pow(kAcceleration_m_s2, 2));
  state.covariance.diagonal().segment<3>(kTurning).setConstant(kTurning_rad_s * kTurning_rad_s);
  state.covariance.diagonal()
      .segment<3>(kTurning + 3)
      .setConstant(std::pow(kAcceleration_rad_s2, 2));
  return state;
}

PoseSample sample_of(const HeadState& state) {
  PoseSample sample{.capture_time = state.time,
                    .level = TrackingLevel::six_dof,
                    .room_from_head = state.room_from_head,
                    .velocity_in_room_m_s = state.move.velocity,
                    .angular_velocity_in_room_rad_s = state.turn.velocity};
  const auto& covariance = state.covariance;
  sample.covariance << covariance.block<3, 3>(kPosition, kPosition),
      covariance.block<3, 3>(kPosition, kRotation), covariance.block<3, 3>(kRotation, kPosition),
      covariance.block<3, 3>(kRotation, kRotation);
  return sample;
}

PoseSample predicted(const HeadState& state, Duration ahead, const AheadOptions& options) {
  const double ahead_s = seconds(std::clamp(ahead, Duration::zero(), options.limit));
  const auto faded = [&](const Vec3& rate, double still) {
    return course_of(ahead_s, Duration::zero())
        .shortened(smooth_step(0.5 * still, 2 * still, rate.norm()));
  };
  HeadState later = state;
  follow(later, faded(state.move.velocity, options.still_m_s),
         faded(state.turn.velocity, options.still_rad_s));
  const MotionNoise noise = noise_of_motion(state);
  add_noise(later.covariance, kPosition, noise.move_m2_s5, ahead_s);
  add_noise(later.covariance, kRotation, noise.turn_rad2_s5, ahead_s);
  return sample_of(later);
}

}  // namespace vindu
