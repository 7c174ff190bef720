// Where the shadow map lies: around what can be in the shadow, and still while things move a
// little.
#include <gtest/gtest.h>

#include "core/site.h"
#include "renderer/shadow_map.h"

namespace vindu {
namespace {

constexpr int kSide_px = 1024;

Box3f around(const Eigen::Vector3f& middle, float half) {
  return {middle.array() - half, middle.array() + half};
}

Vec3 on_map(const ShadowFit& fit, const Vec3& x_in_world) {
  return (fit.map_from_world * x_in_world.homogeneous()).head<3>();
}

TEST(ShadowFit, HoldsAllThatReceives) {
  const Box3f box = around({3, -1, -20}, 2.5f);
  const ShadowFit fit = fit_shadow(box, box, kSide_px);

  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place =
        on_map(fit, box.corner(static_cast<Box3f::CornerType>(corner)).cast<double>());
    EXPECT_GT(place.minCoeff(), 0);
    EXPECT_LT(place.maxCoeff(), 1);
  }
}

TEST(ShadowFit, ReachesAsHighAsWhatThrowsShadows) {
  const Box3f receivers = around({0, 0, 0}, 1);
  const Vec3 far_up = 50 * to_key_light();
  const ShadowFit fit = fit_shadow(receivers, around(far_up.cast<float>(), 1), kSide_px);

  EXPECT_LE(on_map(fit, far_up).z(), 1);
  EXPECT_GT(on_map(fit, far_up).z(), on_map(fit, Vec3::Zero()).z());
}

TEST(ShadowFit, IsNotTooLarge) {
  for (float half = 0.1f; half < 30; half *= 1.37f) {
    const ShadowFit fit = fit_shadow(around({0, 0, 0}, half), around({0, 0, 0}, half), kSide_px);
    EXPECT_LT(fit.texel_m * kSide_px, 2 * half * std::sqrt(3.0) * 1.25);
  }
}

TEST(ShadowFit, KeepsItsGrainInPlaceWhileThingsMove) {
  const ShadowFit before = fit_shadow(around({0, 0, 0}, 1), around({0, 0, 0}, 1), kSide_px);
  const Box3f moved = around({0.0137f, -0.0071f, 0.0193f}, 1.001f);
  const ShadowFit after = fit_shadow(moved, moved, kSide_px);

  EXPECT_EQ(before.texel_m, after.texel_m);
  const Vec3 step_px = kSide_px * (on_map(after, {1, 2, 3}) - on_map(before, {1, 2, 3}));
  for (const int axis : {0, 1}) EXPECT_NEAR(step_px[axis], std::round(step_px[axis]), 1e-6);
  EXPECT_GT(step_px.head<2>().norm(), 0.5);  // it did move
}

TEST(ShadowRegion, HoldsTheWallAndMuchOfWhatIsBehindIt) {
  const Box3f region = shadow_region(single_screen(4, 2, 400, 200));

  EXPECT_TRUE(region.contains(Eigen::Vector3f(-2, 1, 0)));
  EXPECT_TRUE(region.contains(Eigen::Vector3f(2, -1, -8)));  // as deep as fitted models reach
  EXPECT_TRUE(region.contains(Eigen::Vector3f(0, 0, 1)));
  EXPECT_FALSE(region.contains(Eigen::Vector3f(0, 0, -100)));
}

}  // namespace
}  // namespace vindu
