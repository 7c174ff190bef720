// How well LEDs can be told apart by their places.
#include "tracker/calibration/layout.h"

#include <gtest/gtest.h>

#include "core/site.h"

namespace vindu {
namespace {

TEST(Layout, OfTheThesisHelmetIsAmbiguous) {
  EXPECT_LT(layout_ambiguity(HeadConfig{}.leds_in_head).rigid_mm, 1e-6);
}

TEST(Layout, OfAScaleneTriangleIsToldBySomeMillimetres) {
  const LayoutAmbiguity ambiguity =
      layout_ambiguity({{-0.10, 0, -0.05}, {0, 0, 0}, {0.10, 0, -0.15}});
  EXPECT_GT(ambiguity.rigid_mm, kAmbiguous_mm);
  EXPECT_EQ(ambiguity.labelling.size(), 3u);
}

TEST(Layout, OfASquareIsAmbiguous) {
  EXPECT_LT(layout_ambiguity({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}}).rigid_mm, 1e-6);
}

TEST(Layout, ThatIsItsOwnMirrorImageIsAmbiguousInAMirrorOnly) {
  // No rotation, but a reflection in x = 0 maps it upon itself.
  const LayoutAmbiguity ambiguity =
      layout_ambiguity({{-0.1, 0, 0}, {0.1, 0, 0}, {0, 0.03, 0.09}, {0, 0.12, -0.05}});
  EXPECT_GT(ambiguity.rigid_mm, 5);
  EXPECT_LT(ambiguity.mirrored_mm, 1e-6);
}

TEST(Layout, OfOneHeadIsFoundInAnothersWhereverItIsHeldAndHoweverItsLedsAreNumbered) {
  const std::vector<Vec3> three = {{-0.10, 0, -0.05}, {0, 0, 0}, {0.10, 0, -0.15}};
  std::vector<Vec3> four = {{0, 0.08, 0.02}};
  const Quat turned(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (const Vec3& led : three) four.emplace_back(turned * led + Vec3(0.3, 0, -0.1));
  EXPECT_LT(layouts_apart_mm(three, four), 1e-6);
  EXPECT_LT(layouts_apart_mm(four, three), 1e-6);
  four.back() += turned * Vec3(0.05, 0, 0);
  EXPECT_GT(layouts_apart_mm(three, four), kAmbiguous_mm);
}

TEST(Layout, OfTwoLedsIsAlwaysAmbiguous) {
  EXPECT_EQ(layout_ambiguity({{0, 0, 0}, {0.1, 0, 0}}).rigid_mm, 0);
}

}  // namespace
}  // namespace vindu
