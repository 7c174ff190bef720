// Plans see the helmet as the emulated cameras do.
#include "simulator/led_sight.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "simulator/emulated_wiimote.h"

namespace vindu {
namespace {

int dots_of(const SensorState& state) {
  return static_cast<int>(
      std::ranges::count_if(state.slots, [](const auto& slot) { return slot.has_value(); }));
}

TEST(LedSight, GivesAPlanTheDotsThatAnEmulatedWiimoteReports) {
  const Site site = read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  const DotNoise noise = helmet_dot_noise(site.heads.front());
  const Onlooker planned(site.cameras[0]);
  EmulatedSensor emulated(site.cameras[0], site.heads.front(), 0, 1);
  Random random(3);
  int dots = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x_m = random.uniform(-2, 2), z_m = random.uniform(-2, 4.5);
    const Rigid3 pose =
        head_at({x_m, random.uniform(1.3, 2), z_m}, random.uniform(-kPi, kPi), site.heads.front());
    const int seen = dots_of(emulated.look(pose));
    EXPECT_EQ(planned.look(site.heads.front(), pose, noise).dots, seen);
    dots += seen;
  }
  EXPECT_GT(dots, 300);
}

TEST(LedSight, ADotFromFarAwayIsOnlyAsExactAsTheSensorsPixels) {
  const HeadConfig head;
  const DotNoise noise = helmet_dot_noise(head, 0.5);
  EXPECT_NEAR(noise(1, {0, 0, 3}).value_or(0), std::sqrt(0.25 + 1.0 / 12), 1e-12);
  EXPECT_NEAR(noise(1, {0, 0, 7}).value_or(0), std::sqrt(0.25 + 64.0 / 12), 1e-12);
  EXPECT_FALSE(noise(1, {0, 0, 9}));
  EXPECT_FALSE(noise(1, {0, 0, -3}));
}

}  // namespace
}  // namespace vindu
