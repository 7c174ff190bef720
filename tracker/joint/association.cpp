#include "tracker/joint/association.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tracker/joint/assignment.h"

namespace vindu {
namespace {

/// An LED of a tracked head and where its dot is expected.
struct Column {
  int head = 0;
  int led = 0;
  bool well_seen = false;  ///< the head
  ExpectedDot expected;
};

/// Of dots and columns.
using Pair = std::pair<std::size_t, std::size_t>;

bool vague(const HeadState& state, const AssociationOptions& options) {
  const PoseSample sample = sample_of(state);
  const auto variances = sample.covariance.diagonal();
  return variances.head<3>().sum() > options.lost_at_m * options.lost_at_m ||
         variances.tail<3>().sum() > options.lost_at_rad * options.lost_at_rad;
}

std::ptrdiff_t leds_seen(const HeadTrack& head, Time now, const AssociationOptions& options) {
  return std::ranges::count_if(head.led_seen,
                               [&](Time seen) { return now - seen < options.coasts_after; });
}

/// Whether its distance is seen, and with it how it moves: by two cameras, or by enough LEDs.
bool placed(const HeadTrack& head, Time now, const AssociationOptions& options) {
  const auto lately = [&](Time seen) { return now - seen < options.coasts_after; };
  return std::ranges::count_if(head.seen_by, lately) >= 2 ||
         leds_seen(head, now, options) >= options.leds_that_place;
}

bool well_seen(const HeadTrack& head, Time now, const AssociationOptions& options) {
  return leds_seen(head, now, options) >= 3 && placed(head, now, options);
}

/// Through the two LEDs that alone of more were seen lately, in room: how the head turns about it
/// shows nowhere.
std::optional<Vec3> unseen_axis(const HeadTrack& head, std::span<const Vec3> leds_in_head, Time now,
                                const AssociationOptions& options) {
  std::array<Vec3, 2> seen;
  std::size_t count = 0;
  for (std::size_t led = 0; led < leds_in_head.size(); ++led) {
    if (now - head.led_seen[led] >= options.coasts_after) continue;
    if (count == 2) return std::nullopt;
    seen[count++] = leds_in_head[led];
  }
  if (count < 2 || leds_in_head.size() == 2) return std::nullopt;
  return head.state->room_from_head.rotation * (seen[1] - seen[0]).normalized();
}

/// How hard the head may be accelerating, as far as what is seen of it tells.
MotionNoise motion_noise_of(const HeadTrack& head, std::size_t leds, Time now,
                            const AssociationOptions& options) {
  if (options.fixed_noise) return *options.fixed_noise;
  const bool place_known = placed(head, now, options);
  const auto enough = static_cast<std::ptrdiff_t>(std::min<std::size_t>(leds, 3));
  MotionNoise noise = noise_of_motion(*head.state);
  if (!place_known) noise.move_m2_s5 = options.alone_m2_s5 * Mat3::Identity();
  if (place_known && leds_seen(head, now, options) >= enough) {
    const MotionNoise change = noise_of_change(*head.state);
    noise.move_m2_s5 += change.move_m2_s5;
    noise.turn_rad2_s5 += change.turn_rad2_s5;
  }
  if (well_seen(head, now, options)) {
    const double beyond =
        std::max(0.0, std::min(head.surprise, options.most_surprise) - options.usual_surprise);
    noise.move_m2_s5 += beyond * beyond * options.move_by_surprise_m2_s5 * Mat3::Identity();
    noise.turn_rad2_s5 += beyond * beyond * options.turn_by_surprise_rad2_s5 * Mat3::Identity();
  }
  if (!options.turns) noise.turn_rad2_s5.setZero();
  return noise;
}

void move_on(HeadTrack& head, std::span<const Vec3> leds_in_head, Time to,
             const AssociationOptions& options) {
  if (!head.state) return;
  const MotionNoise noise = motion_noise_of(head, leds_in_head.size(), to, options);
  const bool moves = placed(head, to, options);
  const bool turns = leds_seen(head, to, options) >= 2;
  const Duration passed = to - head.state->time;
  const auto axis = unseen_axis(head, leds_in_head, to, options);
  if (axis && options.turns && passed > Duration::zero())
    calm_turning(*head.state, *axis, std::exp(-seconds(passed) / seconds(options.damping)));
  propagate(*head.state, std::max(to, head.state->time), noise,
            {.move_damping = moves ? Duration::zero() : options.damping,
             .turn_damping = turns ? Duration::zero() : options.damping});
  if (options.turns && !well_seen(head, to, options)) expect_facing(*head.state, passed);
  if (to - head.seen > options.lost_after || vague(*head.state, options)) head.state.reset();
}

/// Pixels, and what the time of capture leaves open for a dot that moves.
Eigen::Matrix2d noise_of(const TimedDots& seen, const ExpectedDot& expected, double factor = 1) {
  const double sigma_px = factor * seen.dot_sigma_px;
  const Vec2 by_time_px = seen.time_sigma_s * expected.raw_px_s;
  return sigma_px * sigma_px * Eigen::Matrix2d::Identity() + by_time_px * by_time_px.transpose();
}

double distance2(const Eigen::Matrix2d& covariance_px2, const Vec2& residual_px) {
  return residual_px.dot(covariance_px2.inverse() * residual_px);
}

std::vector<Column> columns_of(Time captured, const CameraModel& camera,
                               std::span<const std::vector<Vec3>> leds_of_heads,
                               std::span<const HeadTrack> heads,
                               const AssociationOptions& options) {
  std::vector<Column> columns;
  for (std::size_t head = 0; head < heads.size(); ++head) {
    if (!heads[head].state) continue;
    const bool well = well_seen(heads[head], captured, options);
    for (std::size_t led = 0; led < leds_of_heads[head].size(); ++led)
      if (const auto dot = expect_dot(*heads[head].state, camera, leds_of_heads[head][led]))
        columns.push_back({static_cast<int>(head), static_cast<int>(led), well, *dot});
  }
  return columns;
}

/// A known reflection counts only where an LED must be of a head that is well seen: one that is not
/// would stay with the reflection.
bool allowed(const TimedDots& seen, std::size_t dot, const Column& column) {
  constexpr double kMustBe_px = 6;
  return !seen.masked[dot] ||
         (column.well_seen &&
          (raw_px_of(seen.dots[dot]) - column.expected.raw_px).norm() < kMustBe_px);
}

template <class Cost>
CostMatrix costs_of(const TimedDots& seen, const std::vector<Column>& columns, Cost cost) {
  CostMatrix costs(static_cast<Eigen::Index>(seen.dots.size()),
                   static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < seen.dots.size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
          allowed(seen, i, columns[c])
              ? cost(columns[c], raw_px_of(seen.dots[i]) - columns[c].expected.raw_px)
              : kNoPair;
  return costs;
}

double cost_of(const CostMatrix& costs, std::size_t dot, std::size_t column) {
  return costs(static_cast<Eigen::Index>(dot), static_cast<Eigen::Index>(column));
}

/// The surest first.
std::vector<Pair> pairs_of(const CostMatrix& costs, double gate) {
  const std::vector<int> assigned = assign(costs, gate);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < assigned.size(); ++i)
    if (assigned[i] >= 0) pairs.emplace_back(i, static_cast<std::size_t>(assigned[i]));
  std::ranges::sort(pairs, {},
                    [&](const Pair& pair) { return cost_of(costs, pair.first, pair.second); });
  return pairs;
}

/// Whether the dot may as well be that of another LED, the LED's another dot, or two pairs
/// exchanged.
bool disputed(const CostMatrix& costs, const std::vector<Pair>& pairs, const Pair& pair,
              const AssociationOptions& options) {
  const std::size_t dot = pair.first, column = pair.second;
  const double own = cost_of(costs, dot, column);
  const double limit = std::min(options.gate, own + options.clear_by);
  const auto dots = static_cast<std::size_t>(costs.rows()),
             columns = static_cast<std::size_t>(costs.cols());
  for (std::size_t other = 0; other < columns; ++other)
    if (cost_of(costs, dot, other) < limit &&
        std::ranges::find(pairs, other, &Pair::second) == pairs.end())
      return true;
  for (std::size_t other = 0; other < dots; ++other)
    if (cost_of(costs, other, column) < limit &&
        std::ranges::find(pairs, other, &Pair::first) == pairs.end())
      return true;
  return std::ranges::any_of(pairs, [&](const Pair& other) {
    const double here = cost_of(costs, dot, other.second),
                 there = cost_of(costs, other.first, column);
    return other != pair && std::max(here, there) < options.gate &&
           here + there < own + cost_of(costs, other.first, other.second) + options.clear_by;
  });
}

void note(HeadTrack& head, const TimedDots& seen, int led) {
  for (Time* time : {&head.seen, &head.seen_by[static_cast<std::size_t>(seen.camera)],
                     &head.led_seen[static_cast<std::size_t>(led)]})
    *time = std::max(*time, seen.captured);
}

void be_surprised(HeadTrack& head, double square_sigmas) {
  constexpr double kShare = 0.12;  // of one dot in the running mean
  head.surprise += kShare * (square_sigmas - 2 - head.surprise);
}

/// Each correction sharpens what is expected of the next dot, which must still fit.
Association correct_by(const TimedDots& seen, const CameraModel& camera,
                       std::span<const std::vector<Vec3>> leds_of_heads, std::span<HeadTrack> heads,
                       const AssociationOptions& options) {
  constexpr double kNear_px = 6;  // no other LED's dot, as a rule
  const std::vector<Column> columns =
      columns_of(seen.captured, camera, leds_of_heads, heads, options);
  const auto in_sigmas = [&](const Column& column, const Vec2& residual_px) {
    if (residual_px.norm() > options.farthest_px) return kNoPair;
    return distance2(column.expected.covariance_px2 + noise_of(seen, column.expected), residual_px);
  };
  const CostMatrix costs = costs_of(seen, columns, in_sigmas);
  Association result;
  // Dots that lie too far off to correct by count here as well: they say most of a head that sets
  // off, and of a camera that stands aside.
  for (const auto& [i, c] : pairs_of(costs, 2 * options.gate)) {
    const double square = cost_of(costs, i, c);
    be_surprised(heads[static_cast<std::size_t>(columns[c].head)], std::min(square, options.gate));
    const Vec2& expected_px = columns[c].expected.raw_px;
    const Vec2 residual_px = raw_px_of(seen.dots[i]) - expected_px;
    if (square >= options.gate && residual_px.norm() < kNear_px)
      result.aside.push_back({expected_px, residual_px});
  }
  const std::vector<Pair> pairs = pairs_of(costs, options.gate);
  for (const auto& [i, c] : pairs) {
    result.disputed[i] = disputed(costs, pairs, {i, c}, options);
    if (result.disputed[i]) continue;
    const int at_head = columns[c].head, led = columns[c].led;
    HeadTrack& head = heads[static_cast<std::size_t>(at_head)];
    const auto expected =
        expect_dot(*head.state, camera,
                   leds_of_heads[static_cast<std::size_t>(at_head)][static_cast<std::size_t>(led)]);
    if (!expected) continue;
    const Eigen::Matrix2d noise = noise_of(seen, *expected);
    const Vec2 residual = raw_px_of(seen.dots[i]) - expected->raw_px;
    const double square = distance2(expected->covariance_px2 + noise, residual);
    if (square > options.gate) continue;
    const double factor = well_seen(head, seen.captured, options) ? 1 : options.weak;
    correct(*head.state, *expected, raw_px_of(seen.dots[i]),
            noise_of(seen, *expected, factor * seen.distrust));
    note(head, seen, led);
    result.accepted.push_back({i, at_head, led, residual, expected->raw_px_s, square});
  }
  return result;
}

/// Two or more dots that stand as the head's LEDs do, but all aside by the same: it is not where it
/// is believed to be.
bool displaced(const TimedDots& seen, const std::vector<Column>& columns) {
  constexpr double kFarthest_px = 60, kShape_px = 3;
  const auto in_pixels = [](const Column&, const Vec2& residual_px) {
    return residual_px.squaredNorm();
  };
  const auto pairs = pairs_of(costs_of(seen, columns, in_pixels), kFarthest_px * kFarthest_px);
  if (pairs.size() < 2) return false;
  const auto shift_of = [&](const auto& pair) -> Vec2 {
    return raw_px_of(seen.dots[pair.first]) - columns[pair.second].expected.raw_px;
  };
  Vec2 mean = Vec2::Zero();
  for (const auto& pair : pairs) mean += shift_of(pair) / static_cast<double>(pairs.size());
  return std::ranges::all_of(
      pairs, [&](const auto& pair) { return (shift_of(pair) - mean).norm() < kShape_px; });
}

/// Heads of which this camera accepts nothing, though its dots have their shape, are known less
/// well than it seemed. False: there are none.
bool widen_displaced(const TimedDots& seen, const CameraModel& camera,
                     std::span<const std::vector<Vec3>> leds_of_heads, std::span<HeadTrack> heads,
                     const std::vector<AcceptedDot>& accepted, const AssociationOptions& options) {
  bool any = false;
  for (std::size_t head = 0; head < heads.size(); ++head) {
    const auto of_head = [&](const auto& part) { return part.head == static_cast<int>(head); };
    if (!heads[head].state || std::ranges::any_of(accepted, of_head)) continue;
    const std::vector<Column> own = columns_of(
        seen.captured, camera, leds_of_heads.subspan(head, 1), heads.subspan(head, 1), options);
    if (!displaced(seen, own)) continue;
    widen(*heads[head].state, well_seen(heads[head], seen.captured, options));
    any = true;
  }
  return any;
}

}  // namespace

Association associate(const TimedDots& seen, const CameraModel& camera,
                      std::span<const std::vector<Vec3>> leds_of_heads, std::span<HeadTrack> heads,
                      const AssociationOptions& options) {
  for (std::size_t head = 0; head < heads.size(); ++head)
    move_on(heads[head], leds_of_heads[head], seen.captured, options);
  std::vector<HeadTrack> doubted(heads.begin(), heads.end());
  Association result = correct_by(seen, camera, leds_of_heads, heads, options);
  if (!options.may_widen || seen.dots.size() < 2 || std::ranges::count(result.disputed, true) > 0 ||
      !widen_displaced(seen, camera, leds_of_heads, doubted, result.accepted, options))
    return result;
  std::ranges::move(doubted, heads.begin());
  result = correct_by(seen, camera, leds_of_heads, heads, options);
  result.widened = true;
  return result;
}

}  // namespace vindu
