// The light of the helmet: how it fades aside and with distance, and what the head hides.
#include "simulator/helmet.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

// A camera 3 m from the head's middle, level; the angle is from straight behind to the wearer's
// right.
Vec3 camera_at(double angle_deg) {
  return 3 * Vec3(std::sin(radians(angle_deg)), 0, std::cos(radians(angle_deg)));
}

TEST(Emission, is_level_within_the_fan_and_gone_beyond_the_last_led) {
  EXPECT_EQ(emission(0), 1);
  EXPECT_EQ(emission(kFan_rad), 1);
  EXPECT_NEAR(emission(kFan_rad + 0.5 * kLedHalfAngle_rad), 0.5, 1e-12);
  EXPECT_NEAR(emission(kFan_rad + kLedHalfAngle_rad), 0, 1e-12);
  EXPECT_EQ(emission(kPi), 0);
}

TEST(Helmet, shines_backwards_and_outwards) {
  const Helmet helmet{HeadConfig{}};
  const auto& clusters = helmet.clusters();
  ASSERT_EQ(clusters.size(), 3u);
  EXPECT_LT(clusters[0].normal_in_head.x(), -0.3);
  EXPECT_GT(clusters[0].normal_in_head.z(), 0.5);
  EXPECT_NEAR(clusters[1].normal_in_head.z(), 1, 1e-9);
  EXPECT_NEAR(clusters[2].normal_in_head.x(), -clusters[0].normal_in_head.x(), 1e-12);
}

TEST(Helmet, of_leds_on_the_forehead_shines_forwards) {
  HeadConfig head;
  head.leds_in_head = {{-0.05, 0, -0.20}, {0, 0.03, -0.22}, {0.05, 0, -0.20}};
  const Helmet helmet(head);
  for (const LedCluster& cluster : helmet.clusters()) {
    EXPECT_LT(cluster.normal_in_head.z(), -0.5);
    EXPECT_GT(helmet.brightness(cluster, camera_at(180)), 0);
    EXPECT_EQ(helmet.brightness(cluster, camera_at(0)), 0);
  }
}

TEST(Helmet, is_seen_whole_from_behind) {
  const Helmet helmet{HeadConfig{}};
  for (const double angle_deg : {-40, -20, 0, 20, 40})
    for (const LedCluster& cluster : helmet.clusters())
      EXPECT_NEAR(helmet.brightness(cluster, camera_at(angle_deg)), 1.0 / 9, 0.02) << angle_deg;
}

TEST(Helmet, loses_the_far_leds_behind_the_head) {
  const Helmet helmet{HeadConfig{}};
  const Vec3 from_the_right = camera_at(85);
  EXPECT_TRUE(helmet.hidden(helmet.clusters()[0], from_the_right));
  EXPECT_FALSE(helmet.hidden(helmet.clusters()[2], from_the_right));
  EXPECT_EQ(helmet.brightness(helmet.clusters()[0], from_the_right), 0);
  EXPECT_GT(helmet.brightness(helmet.clusters()[2], from_the_right), 0);
  EXPECT_TRUE(helmet.hidden(helmet.clusters()[1], camera_at(180)));
}

TEST(Helmet, fades_with_the_square_of_the_distance) {
  const Helmet helmet{HeadConfig{}};
  const LedCluster& rear = helmet.clusters()[1];
  EXPECT_NEAR(helmet.brightness(rear, {0, 0, 1}), 1, 1e-12);
  EXPECT_NEAR(helmet.brightness(rear, {0, 0, 4}), 1.0 / 16, 1e-12);
}

TEST(Helmet, head_shrinks_rather_than_swallow_an_led) {
  HeadConfig head;
  head.leds_in_head = {{-0.04, 0, -0.10}, {0, 0, 0}, {0.04, 0, -0.10}};
  const Helmet helmet(head);
  for (const LedCluster& cluster : helmet.clusters()) {
    const Vec3 from_centre = cluster.x_in_head - helmet.shape().centre_in_head;
    EXPECT_GT(from_centre.cwiseQuotient(helmet.shape().half_axes_m).norm(), 1);
  }
}

}  // namespace
}  // namespace vindu
