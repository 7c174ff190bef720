#include "simulator/motions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "simulator/single_frame.h"

namespace vindu {
namespace {

constexpr int kWays = 200;
constexpr double kPeakOverMean = 1.875;  // of the speed of minimum jerk

struct Way {
  double begin_s = 0;  // then a rest, then the way
  double rest_s = 0;
  double way_s = 0;
  Rigid3 from = {}, to = {};

  double end_s() const { return begin_s + rest_s + way_s; }
};

std::vector<Way> plan(const MotionPeaks& peaks, Random& random) {
  std::vector<Way> ways;
  const Rigid3 home = head_somewhere(random);
  Way way{.from = home, .to = home};
  for (int i = 0; i < kWays; ++i) {
    way = {.begin_s = way.end_s(), .rest_s = random.uniform(0.3, 0.8), .from = way.to};
    way.to = i + 1 < kWays ? head_somewhere(random) : home;
    const double way_m = (way.to.translation - way.from.translation).norm();
    const double turn_rad = way.from.rotation.angularDistance(way.to.rotation);
    way.way_s = kPeakOverMean * std::max(way_m / peaks.move_m_s, turn_rad / peaks.turn_rad_s);
    ways.push_back(way);
  }
  return ways;
}

}  // namespace

BodyMotion resting(std::uint64_t seed) {
  Random random(seed);
  return [pose = head_somewhere(random)](Time) { return pose; };
}

BodyMotion starting_and_stopping(const MotionPeaks& peaks, std::uint64_t seed) {
  assert(peaks.move_m_s > 0 && peaks.turn_rad_s > 0);
  Random random(seed);
  return [ways = plan(peaks, random)](Time time) {
    const double t_s =
        std::fmod(std::max(0.0, seconds(time.time_since_epoch())), ways.back().end_s());
    const Way& way =
        *std::prev(std::ranges::upper_bound(ways, t_s, {}, [](const Way& w) { return w.begin_s; }));
    const double u = std::clamp((t_s - way.begin_s - way.rest_s) / way.way_s, 0.0, 1.0);
    const double share = u * u * u * (10 + u * (-15 + 6 * u));
    const Vec3 place = way.from.translation + share * (way.to.translation - way.from.translation);
    return Rigid3{way.from.rotation.slerp(share, way.to.rotation), place};
  };
}

}  // namespace vindu
