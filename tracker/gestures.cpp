#include "tracker/gestures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vindu {
namespace {

constexpr double kSmoothing_s = 1 / (2 * kPi * 6);  // of each of two low-passes: 6 Hz
constexpr double kGap_s = 0.25;                     // without a sample; longer ones begin anew
constexpr double kSettling_s = 0.3;                 // of a filter that has just found the head
constexpr double kQuiet_s = 1.5;                    // between two gestures
constexpr double kHysteresis = 0.4;                 // of a turning point, in least swings
constexpr double kKnown = 2. / 3;                   // the largest sigma of an angle, the same
constexpr double kRemembered_s = 2;
constexpr std::size_t kSwings = 6;

// A row of swings is a gesture when there are three of about one size, or, as a quick nod, two
// larger ones, down and as far up again. Somebody who glances aside swings twice.
constexpr double kEvenness = 0.5;     // of the first and the third
constexpr double kSteadiness = 0.45;  // of the times from one to the next
constexpr double kOpposition = 0.25;  // of the second to them: the head may turn meanwhile
constexpr double kSmallest = 0.8;     // of the three, in least swings
constexpr double kQuickSwing = 1.5;   // in least swings
constexpr double kQuickEvenness = 0.6;
constexpr double kDominance = 2;  // over the swings about the other axis
constexpr double kClearSwing_rad = radians(15);

using Swings = std::deque<Zigzag::Swing>;

double size_of(const Zigzag::Swing& swing) { return std::abs(swing.size_rad); }

double ratio(double a, double b) { return std::min(a, b) / std::max(a, b); }

struct Row {
  double size_rad = 0;  // of a swing, without the turn of the head as a whole
  double evenness = 0;
  double fullness = 0;  // 1: as many swings as one can ask for
};

/// Whether the newest `count` swings follow each other at a gesture's rate until now.
bool in_rhythm(const Swings& swings, std::size_t count, double now_s,
               const GestureOptions& options) {
  const double longest_s = 0.5 / options.least_rate_hz;
  const double shortest_s = 0.8 * 0.5 / options.largest_rate_hz;
  if (swings.size() < count || now_s - swings.back().crossing_s > longest_s) return false;
  for (std::size_t i = swings.size() - count; i + 1 < swings.size(); ++i) {
    const double half_s = swings[i + 1].crossing_s - swings[i].crossing_s;
    if (half_s > longest_s || half_s < shortest_s) return false;
  }
  return true;
}

/// To, fro and to. A steady turn adds to the first and third what it takes from the second.
std::optional<Row> cyclic_row(const Swings& swings, double now_s, const GestureOptions& options) {
  if (!in_rhythm(swings, 3, now_s, options)) return std::nullopt;
  const double least_rad = radians(options.least_swing_deg);
  const double first = size_of(swings[swings.size() - 3]);
  const double second = size_of(swings[swings.size() - 2]);
  const double third = size_of(swings.back());
  const double outer = 0.5 * (first + third);
  const double half_s = swings[swings.size() - 2].crossing_s - swings[swings.size() - 3].crossing_s;
  const double next_s = swings.back().crossing_s - swings[swings.size() - 2].crossing_s;
  const Row row{0.5 * (outer + second), ratio(first, third) * std::sqrt(ratio(second, outer)), 1};
  const bool fits = row.size_rad >= least_rad &&
                    std::min({first, second, third}) >= kSmallest * least_rad &&
                    ratio(first, third) >= kEvenness && ratio(second, outer) >= kOpposition &&
                    ratio(half_s, next_s) >= kSteadiness;
  return fits ? std::optional(row) : std::nullopt;
}

/// Down, and up again.
std::optional<Row> quick_nod(const Swings& pitch, double now_s, const GestureOptions& options) {
  if (!in_rhythm(pitch, 2, now_s, options) || pitch.back().size_rad < 0) return std::nullopt;
  const double down = size_of(pitch[pitch.size() - 2]), up = size_of(pitch.back());
  const bool fits = std::min(down, up) >= kQuickSwing * radians(options.least_swing_deg) &&
                    ratio(down, up) >= kQuickEvenness;
  return fits ? std::optional(Row{std::min(down, up), ratio(down, up), 0.5}) : std::nullopt;
}

/// Size of the swings to and fro about an axis within the last second; 0: none.
double wavering_rad(const Swings& swings, double now_s) {
  double largest = 0;
  for (std::size_t i = 1; i < swings.size(); ++i)
    if (now_s - swings[i - 1].crossing_s < 1)
      largest = std::max(largest, std::min(size_of(swings[i - 1]), size_of(swings[i])));
  return largest;
}

double confidence_of(const Row& row, double other_rad) {
  const double clear = std::min(1.0, row.size_rad / kClearSwing_rad);
  return (1 - other_rad / row.size_rad) * (0.4 * clear + 0.3 * row.evenness + 0.3 * row.fullness);
}

/// What a pose is off by about an axis, in room; 0 where the pose does not say.
double sigma_about(const Vec3& axis_in_room, const PoseSample& sample) {
  const Mat3 rotation_rad2 = sample.covariance.bottomRightCorner<3, 3>();
  return std::sqrt(axis_in_room.dot(rotation_rad2 * axis_in_room));
}

}  // namespace

// The newest time at which the swing under way had not yet come half of its way.
double Zigzag::crossing_s() const {
  const double middle_rad = 0.5 * (turn_.angle_rad + extreme_.angle_rad);
  const bool up = extreme_.angle_rad > turn_.angle_rad;
  double crossing_s = recent_.front().time_s;
  for (const Sample& sample : recent_) {
    if (sample.time_s > extreme_.time_s) break;
    if (up ? sample.angle_rad <= middle_rad : sample.angle_rad >= middle_rad)
      crossing_s = sample.time_s;
  }
  return crossing_s;
}

void Zigzag::absorb(double time_s, double angle_rad, double hysteresis_rad) {
  const Sample now{time_s, angle_rad};
  if (swings_.empty()) {
    turn_ = extreme_ = now;
    swings_.push_back({});
  }
  recent_.push_back(now);
  while (recent_.front().time_s < time_s - kRemembered_s) recent_.pop_front();
  const double size_rad = extreme_.angle_rad - turn_.angle_rad;
  const double back_rad = std::copysign(1.0, size_rad) * (extreme_.angle_rad - angle_rad);
  if (back_rad <= 0) {
    extreme_ = now;
  } else if (back_rad > hysteresis_rad) {
    turn_ = extreme_;
    extreme_ = now;
    swings_.push_back({});
    if (swings_.size() > kSwings) swings_.pop_front();
  }
  swings_.back() = {extreme_.angle_rad - turn_.angle_rad, crossing_s()};
}

void GestureDetector::Angle::absorb(double now_s, double angle_rad, double hysteresis_rad) {
  if (!(now_s - newest_s <= kGap_s)) *this = {now_s, now_s, angle_rad, angle_rad, {}};
  const double share = 1 - std::exp(-(now_s - newest_s) / kSmoothing_s);
  once_rad += share * std::remainder(angle_rad - once_rad, 2 * kPi);
  twice_rad += share * (once_rad - twice_rad);
  newest_s = now_s;
  if (known(now_s)) zigzag.absorb(now_s, twice_rad, hysteresis_rad);
}

bool GestureDetector::Angle::known(double now_s) const {
  return newest_s - began_s >= kSettling_s && now_s - newest_s <= kGap_s;
}

GestureDetector::GestureDetector(const Vec3& eye_in_head, const Rigid3& room_from_wall,
                                 std::vector<LookTarget> targets, const GestureOptions& options)
    : eye_in_head_(eye_in_head),
      wall_from_room_(inverse(room_from_wall)),
      targets_(std::move(targets)),
      options_(options) {
  assert(options.least_swing_deg > 0 && options.least_rate_hz > 0);
  assert(options.largest_rate_hz > options.least_rate_hz && options.dwell_s > 0);
}

std::optional<GestureEvent> GestureDetector::absorb(const PoseSample& sample) {
  const Rigid3& pose = sample.room_from_head;
  if (sample.level > TrackingLevel::hybrid || (last_ && sample.capture_time <= *last_) ||
      !pose.rotation.coeffs().allFinite() || !pose.translation.allFinite())
    return std::nullopt;
  last_ = sample.capture_time;
  const double now_s = seconds(sample.capture_time.time_since_epoch());
  absorb_angles(now_s, sample);
  auto event = swing_event(now_s);
  if (!event) event = look_event(now_s, wall_from_room_ * (pose * eye_in_head_));
  if (event) {
    event->object = sample.object;
    event->time = sample.capture_time;
  }
  return event;
}

// Turned by a small vector t, the head faces t x facing more: t's parts along these axes are what
// pitch and yaw change by.
void GestureDetector::absorb_angles(double now_s, const PoseSample& sample) {
  const Vec3 facing = sample.room_from_head.rotation * -Vec3::UnitZ();
  const double level = std::hypot(facing.x(), facing.z());
  const Vec3 pitch_axis = facing.cross(Vec3::UnitY()) / level;
  const Vec3 yaw_axis = (Vec3::UnitY() - facing.y() * facing) / (level * level);
  const double least_rad = radians(options_.least_swing_deg);
  const auto absorb = [&](Angle& angle, double angle_rad, const Vec3& axis_in_room) {
    if (sigma_about(axis_in_room, sample) <= kKnown * least_rad)
      angle.absorb(now_s, angle_rad, kHysteresis * least_rad);
  };
  absorb(yaw_, std::atan2(-facing.x(), -facing.z()), yaw_axis);
  absorb(pitch_, std::atan2(facing.y(), level), pitch_axis);
}

std::optional<GestureEvent> GestureDetector::swing_event(double now_s) {
  for (const bool nod : {true, false}) {
    const Zigzag& own = (nod ? pitch_ : yaw_).zigzag;
    const Zigzag& other = (nod ? yaw_ : pitch_).zigzag;
    auto row = cyclic_row(own.swings(), now_s, options_);
    if (!row && nod) row = quick_nod(own.swings(), now_s, options_);
    const double other_rad = wavering_rad(other.swings(), now_s);
    if (!row || row->size_rad < kDominance * other_rad) continue;
    const bool goes_on = now_s < quiet_until_s_;
    quiet_until_s_ = now_s + kQuiet_s;
    if (goes_on) return std::nullopt;
    GestureEvent event;
    event.gesture = nod ? Gesture::nod : Gesture::shake;
    event.confidence = confidence_of(*row, other_rad);
    return event;
  }
  return std::nullopt;
}

Vec3 GestureDetector::facing_in_room() const {
  const double level = std::cos(pitch_.twice_rad);
  return {-level * std::sin(yaw_.twice_rad), std::sin(pitch_.twice_rad),
          -level * std::cos(yaw_.twice_rad)};
}

/// The thing looked at already, while its grown sphere is hit; else the nearest that is hit.
std::optional<GestureDetector::Hit> GestureDetector::looked_at(const Vec3& eye_in_wall) const {
  const Vec3 facing_in_wall = wall_from_room_.rotation * facing_in_room();
  std::optional<Hit> nearest;
  double nearest_m = 0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const LookTarget& target = targets_[i];
    const bool kept = look_ && look_->target == i;
    const Vec3 way = target.centre_in_wall - eye_in_wall;
    const double along_m = way.dot(facing_in_wall);
    const double miss_m = (way - along_m * facing_in_wall).norm();
    const double radius_m = target.radius_m * (kept ? options_.dwell_grows : 1);
    if (along_m <= 0 || miss_m > radius_m || way.norm() <= target.radius_m) continue;
    const Hit hit{i, std::max(0.0, 1 - miss_m / target.radius_m)};
    if (kept) return hit;
    if (!nearest || along_m < nearest_m) nearest = hit, nearest_m = along_m;
  }
  return nearest;
}

std::optional<GestureEvent> GestureDetector::look_event(double now_s, const Vec3& eye_in_wall) {
  const bool known = yaw_.known(now_s) && pitch_.known(now_s);
  const auto hit = known ? looked_at(eye_in_wall) : std::nullopt;
  if (look_ && now_s - look_->last_on_s > options_.dwell_pause_s) look_.reset();
  if (!hit) return std::nullopt;
  if (!look_ || look_->target != hit->target) look_ = Look{hit->target, now_s};
  look_->last_on_s = now_s;
  look_->closeness += hit->closeness;
  ++look_->samples;
  if (look_->told || now_s - look_->since_s < options_.dwell_s) return std::nullopt;
  look_->told = true;
  GestureEvent event;
  event.gesture = Gesture::look;
  event.confidence = 0.5 + 0.5 * look_->closeness / look_->samples;
  event.target = targets_[hit->target].name;
  return event;
}

}  // namespace vindu
