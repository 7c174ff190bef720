#include "simulator/person.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vindu {
namespace {

constexpr int kLegs = 48;
constexpr double kMinimumJerkPeak = 1.875;  // largest speed over mean speed
constexpr double kSteps_hz = 1.8;
constexpr double kBob_m = 0.010;
// The head turns about the top of the neck, below and behind the eyes.
const Vec3 kNeckFromEye_in_head = {0, -0.12, 0.09};

double minimum_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

// Its speed, scaled to a peak of 1.
double walking_share(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return 16 * u * u * (1 - u) * (1 - u);
}

// Up and down again once, at rest at both ends.
double bump(double u) {
  const double sine = std::sin(kPi * std::clamp(u, 0.0, 1.0));
  return sine * sine;
}

Vec3 anywhere(Random& random, const Vec3& least, const Vec3& largest) {
  const double x = random.uniform(least.x(), largest.x());
  const double y = random.uniform(least.y(), largest.y());
  return {x, y, random.uniform(least.z(), largest.z())};
}

}  // namespace

double Person::Sway::at(double t_s) const {
  return amplitude * std::sin(2 * kPi * rate_hz * t_s + phase_rad);
}

Person::Person(const HeadConfig& head, const Rigid3& room_from_wall, const PersonOptions& options)
    : head_(head), wall_from_room_(inverse(room_from_wall)), options_(options) {
  assert(options_.peak_walk_m_s > 0);
  assert((options_.least_eye_in_room.array() <= options_.largest_eye_in_room.array()).all());
  Random random(options_.seed);
  plan_sway(random);
  plan_stops(random, room_from_wall);
  plan_ways(random);
}

void Person::plan_sway(Random& random) {
  const auto sway = [&](double amplitude, double rate_hz) {
    return Sway{amplitude, rate_hz * random.uniform(0.9, 1.1), random.uniform(0, 2 * kPi)};
  };
  sway_x_ = sway(0.006, 0.23), sway_y_ = sway(0.002, 0.31), sway_z_ = sway(0.008, 0.27);
  sway_yaw_ = sway(radians(1.5), 0.37), sway_pitch_ = sway(radians(1.2), 0.29);
  sway_roll_ = sway(radians(1.5), 0.19);
}

void Person::plan_stops(Random& random, const Rigid3& room_from_wall) {
  for (int i = 0; i < kLegs; ++i) {
    Leg leg;
    leg.eye_from_in_room =
        anywhere(random, options_.least_eye_in_room, options_.largest_eye_in_room);
    const double look_x_m = random.normal(0.35);
    leg.look_from_in_room = room_from_wall * Vec3(look_x_m, random.normal(0.2), 0);
    leg.pause_s = random.uniform(0.4, 3.0);
    const double aside = random.uniform(-1, 1);
    if (leg.pause_s > 1.4 && std::abs(aside) > 0.5) leg.glance_rad = aside * radians(30);
    legs_.push_back(leg);
  }
}

void Person::plan_ways(Random& random) {
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    Leg& leg = legs_[i];
    const Leg& next = legs_[(i + 1) % legs_.size()];
    leg.eye_to_in_room = next.eye_from_in_room;
    leg.look_to_in_room = next.look_from_in_room;
    const double way_m = (leg.eye_to_in_room - leg.eye_from_in_room).norm();
    const double peak_m_s = options_.peak_walk_m_s * random.uniform(0.5, 1.0);
    leg.walk_s = std::max(1.0, kMinimumJerkPeak * way_m / peak_m_s);
    leg.start_s = period_s_;
    period_s_ += leg.pause_s + leg.walk_s;
  }
}

const Person::Leg& Person::leg_at(double wrapped_s) const {
  return *std::prev(std::ranges::upper_bound(legs_, wrapped_s, {}, &Leg::start_s));
}

Vec3 Person::eye_of_walk_in_room(const Leg& leg, double into_leg_s, double t_s) const {
  const double u = (into_leg_s - leg.pause_s) / leg.walk_s;
  const Vec3 sway_m(sway_x_.at(t_s), sway_y_.at(t_s), sway_z_.at(t_s));
  const double bob_m = kBob_m * walking_share(u) * std::sin(2 * kPi * kSteps_hz * t_s);
  return leg.eye_from_in_room + minimum_jerk(u) * (leg.eye_to_in_room - leg.eye_from_in_room) +
         sway_m + Vec3(0, bob_m, 0);
}

// Yaw about +y, then pitch about the turned x, then roll about the line of sight. The head turns
// only a part of the way to what is looked at: the eyes do the rest.
Quat Person::rotation_towards(const Vec3& look_in_room, const Vec3& eye_in_room, double glance_rad,
                              double t_s) const {
  const Vec3 way = look_in_room - eye_in_room;
  const double yaw_rad = 0.7 * std::atan2(-way.x(), -way.z()) + glance_rad + sway_yaw_.at(t_s);
  const double pitch_rad =
      0.7 * std::atan2(way.y(), std::hypot(way.x(), way.z())) + sway_pitch_.at(t_s);
  return Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitY()) *
              Eigen::AngleAxisd(pitch_rad, Vec3::UnitX()) *
              Eigen::AngleAxisd(sway_roll_.at(t_s), Vec3::UnitZ()));
}

Rigid3 Person::room_from_head(Time time) const {
  const double t_s = std::max(0.0, seconds(time - options_.start));
  const double wrapped_s = std::fmod(t_s, period_s_);
  const Leg& leg = leg_at(wrapped_s);
  const double into_leg_s = wrapped_s - leg.start_s;
  const double u = (into_leg_s - leg.pause_s) / leg.walk_s;
  const Vec3 look_in_room =
      leg.look_from_in_room + minimum_jerk(u) * (leg.look_to_in_room - leg.look_from_in_room);
  const Vec3 eye_in_room = eye_of_walk_in_room(leg, into_leg_s, t_s);
  const double glance_rad = leg.glance_rad * bump(into_leg_s / leg.pause_s);
  const Quat rotation = rotation_towards(look_in_room, eye_in_room, glance_rad, t_s);
  const Vec3 neck_in_room = eye_in_room + kNeckFromEye_in_head;  // as if facing the wall
  const Vec3 neck_in_head = head_.eye_in_head + kNeckFromEye_in_head;
  return {rotation, neck_in_room - rotation * neck_in_head};
}

Vec3 Person::eye_in_wall(Time time) const {
  return wall_from_room_ * (room_from_head(time) * head_.eye_in_head);
}

}  // namespace vindu
