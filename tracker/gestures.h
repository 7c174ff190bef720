// What a tracked head says: a nod, a shake, and that it keeps looking at something. Found in the
// stream of poses alone, one sample after the other.
//
// Yes and no are cyclic, symmetric movements, in which they differ from all other movements of a
// listener's head (Hadar, Steiner & Clifford Rose 1985, Journal of Nonverbal Behavior 9, 214-228);
// so a gesture is a row of swings of the same size to and fro about one axis, not a position.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.h"

namespace vindu {

enum class Gesture { nod, shake, look };

constexpr std::string_view name_of(Gesture gesture) {
  constexpr std::string_view names[] = {"nod", "shake", "look"};
  return names[static_cast<int>(gesture)];
}

struct GestureEvent {
  Gesture gesture = Gesture::nod;
  int object = 0;         ///< whose head
  Time time{};            ///< capture time of the sample that completed it
  double confidence = 0;  ///< 0 to 1: how clearly it was one; not a probability
  std::string target;     ///< of a look: the thing's name
};

/// A thing that can be looked at: a sphere around it.
struct LookTarget {
  std::string name;
  Vec3 centre_in_wall = Vec3::Zero();
  double radius_m = 0;
};

struct GestureOptions {
  /// Of each swing of a nod or shake, from one turning point to the next: more than the head of
  /// somebody who walks pitches with each step.
  double least_swing_deg = 6;
  double least_rate_hz = 0.8;  ///< of swings to and fro
  double largest_rate_hz = 4;
  double dwell_s = 0.8;        ///< of a look
  double dwell_pause_s = 0.2;  ///< that a look may stray off its thing
  double dwell_grows = 1.3;    ///< radius of a thing while it is looked at, over its own
};

/// An angle as the swings between its turning points. Bound to one thread.
class Zigzag {
 public:
  struct Swing {
    double size_rad = 0;    ///< with sign
    double crossing_s = 0;  ///< when it passed its middle: half a period after that of the last one
  };

  void absorb(double time_s, double angle_rad, double hysteresis_rad);
  /// The oldest first; the last is under way.
  const std::deque<Swing>& swings() const { return swings_; }

 private:
  struct Sample {
    double time_s = 0;
    double angle_rad = 0;
  };
  double crossing_s() const;

  std::deque<Sample> recent_;
  Sample turn_, extreme_;  // where the swing under way began, and as far as it has come
  std::deque<Swing> swings_;
};

/// Of one person: feed it the samples of one object. Sans input and output; bound to one thread.
class GestureDetector {
 public:
  GestureDetector(const Vec3& eye_in_head, const Rigid3& room_from_wall,
                  std::vector<LookTarget> targets = {}, const GestureOptions& options = {});

  /// At most one event a sample. Samples below hybrid do not know where the head points and are
  /// passed over, as are those that are not newer than the last; after a gap all begins anew. One
  /// that does not know one of both angles, as its covariance says, is passed over for that angle.
  std::optional<GestureEvent> absorb(const PoseSample& sample);

 private:
  /// How far the head is turned about one axis: low-passed twice.
  struct Angle {
    double began_s = -1e300;  // times are of CLOCK_MONOTONIC
    double newest_s = began_s;
    double once_rad = 0;
    double twice_rad = 0;
    Zigzag zigzag;

    void absorb(double now_s, double angle_rad, double hysteresis_rad);
    bool known(double now_s) const;
  };
  struct Look {
    std::size_t target = 0;
    double since_s = 0;
    double last_on_s = since_s;
    double closeness = 0;  // sum over its samples: 1 for the thing's middle, 0 for its edge
    int samples = 0;
    bool told = false;
  };
  struct Hit {
    std::size_t target = 0;
    double closeness = 0;
  };

  void absorb_angles(double now_s, const PoseSample& sample);
  std::optional<GestureEvent> swing_event(double now_s);
  std::optional<GestureEvent> look_event(double now_s, const Vec3& eye_in_wall);
  Vec3 facing_in_room() const;
  std::optional<Hit> looked_at(const Vec3& eye_in_wall) const;

  Vec3 eye_in_head_;
  Rigid3 wall_from_room_;
  std::vector<LookTarget> targets_;
  GestureOptions options_;
  std::optional<Time> last_;
  double quiet_until_s_ = 0;  // the nod or shake that was told goes on
  Angle yaw_, pitch_;
  std::optional<Look> look_;
};

}  // namespace vindu
