#include "simulator/led_body.h"

#include <array>
#include <cmath>
#include <memory>

#include "core/random.h"
#include "simulator/helmet.h"

namespace vindu {
namespace {

/// Two sines of unrelated rates, within -1 and 1.
struct Swing {
  std::array<double, 2> rate_hz{};
  std::array<double, 2> phase_rad{};

  double at(double t_s) const {
    return 0.6 * std::sin(2 * kPi * rate_hz[0] * t_s + phase_rad[0]) +
           0.4 * std::sin(2 * kPi * rate_hz[1] * t_s + phase_rad[1]);
  }
};

Swing random_swing(Random& random, double tempo_hz) {
  Swing swing;
  for (std::size_t i = 0; i < 2; ++i) {
    swing.rate_hz[i] = tempo_hz * (i == 0 ? random.uniform(1, 1.6) : random.uniform(2, 2.9));
    swing.phase_rad[i] = random.uniform(-kPi, kPi);
  }
  return swing;
}

}  // namespace

LedBody helmet_body(const HeadConfig& head, BodyMotion room_from_head) {
  const auto helmet = std::make_shared<const Helmet>(head);
  return {head.leds_in_head,
          [helmet](std::size_t led, const Vec3& viewer_in_head) {
            return helmet->brightness(helmet->clusters()[led], viewer_in_head);
          },
          std::move(room_from_head)};
}

LedBody bare_leds(std::vector<Vec3> leds_in_body, BodyMotion room_from_body) {
  const auto brightness = [leds_in_body](std::size_t led, const Vec3& viewer_in_body) {
    return 1 / std::max(1e-4, (viewer_in_body - leds_in_body[led]).squaredNorm());
  };
  return {std::move(leds_in_body), brightness, std::move(room_from_body)};
}

LedBody touching(std::vector<Vec3> points_in_room) {
  return bare_leds({Vec3::Zero()}, [points = std::move(points_in_room)](Time time) {
    const double t = std::max(0.0, seconds(time.time_since_epoch()) / 3);
    const auto from = std::min(static_cast<std::size_t>(t), points.size() - 1);
    const auto to = std::min(from + 1, points.size() - 1);
    const double share = std::clamp(3 * (t - static_cast<double>(from)) - 2, 0.0, 1.0);
    return Rigid3{Quat::Identity(), (1 - share) * points[from] + share * points[to]};
  });
}

BodyMotion waved(const WaveOptions& options) {
  Random random(options.seed);
  std::array<Swing, 6> swings;
  for (Swing& swing : swings) swing = random_swing(random, options.tempo_hz);
  return [options, swings](Time time) {
    const double t_s = seconds(time - options.start);
    const Vec3 shift_m =
        options.reach_m.cwiseProduct(Vec3(swings[0].at(t_s), swings[1].at(t_s), swings[2].at(t_s)));
    const Quat turn = Eigen::AngleAxisd(options.turn_rad.x() * swings[3].at(t_s), Vec3::UnitX()) *
                      Eigen::AngleAxisd(options.turn_rad.y() * swings[4].at(t_s), Vec3::UnitY()) *
                      Eigen::AngleAxisd(options.turn_rad.z() * swings[5].at(t_s), Vec3::UnitZ());
    return Rigid3{(options.room_from_rest.rotation * turn).normalized(),
                  options.room_from_rest.translation + shift_m};
  };
}

}  // namespace vindu
