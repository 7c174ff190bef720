// A person who walks to and fro in front of the wall, wearing the tracked helmet: the ground truth
// that the tracker is measured against. Walks from place to place (minimum-jerk, Flash & Hogan
// 1985), stops, sways, bobs with each step, looks at the wall and now and then aside.
#pragma once

#include <cstdint>
#include <vector>

#include "core/clock.h"
#include "core/pose.h"
#include "core/random.h"
#include "core/site.h"

namespace vindu {

struct PersonOptions {
  std::uint64_t seed = 1;
  Time start{};  ///< when the walk begins
  /// Where the eyes go while walking: what the cameras of assets/walls/tromso.toml both see. At the
  /// sides, and when he looks aside, the thesis' method loses him, as it would.
  Vec3 least_eye_in_room = {-0.75, 1.55, 1.30};
  Vec3 largest_eye_in_room = {0.75, 1.72, 2.05};
  double peak_walk_m_s = 0.5;  ///< of the walk alone; steps and turns of the head add to it
};

/// Immutable once made, so thread-safe. Smooth (C1) at all times; still before the start. The walk
/// repeats after some minutes.
class Person {
 public:
  Person(const HeadConfig& head, const Rigid3& room_from_wall, const PersonOptions& options = {});

  Rigid3 room_from_head(Time time) const;
  /// The point between both eyes.
  Vec3 eye_in_wall(Time time) const;

 private:
  // One stop and the way from there: still for pause_s, then walk_s to the next place.
  struct Leg {
    double start_s = 0;
    double pause_s = 0;
    double walk_s = 0;
    Vec3 eye_from_in_room = Vec3::Zero();  // of a head that faces the wall, not swaying
    Vec3 eye_to_in_room = Vec3::Zero();
    Vec3 look_from_in_room = Vec3::Zero();  // a point on the wall
    Vec3 look_to_in_room = Vec3::Zero();
    double glance_rad = 0;  // aside, during the pause
  };

  struct Sway {
    double amplitude = 0;  // metres or radians
    double rate_hz = 0;
    double phase_rad = 0;
    double at(double t_s) const;
  };

  void plan_sway(Random& random);
  void plan_stops(Random& random, const Rigid3& room_from_wall);
  void plan_ways(Random& random);
  const Leg& leg_at(double wrapped_s) const;
  Vec3 eye_of_walk_in_room(const Leg& leg, double into_leg_s, double t_s) const;
  Quat rotation_towards(const Vec3& look_in_room, const Vec3& eye_in_room, double glance_rad,
                        double t_s) const;

  HeadConfig head_;
  Rigid3 wall_from_room_;
  PersonOptions options_;
  std::vector<Leg> legs_;
  double period_s_ = 0;
  Sway sway_x_, sway_y_, sway_z_, sway_yaw_, sway_pitch_, sway_roll_;
};

}  // namespace vindu
