// The off-axis frustum against the thesis: eq. 3.2 gives a tile's l, r, b, t on the screen plane
// for an eye on the wall's axis, eq. 3.3 adds the deltas of the camera event.
#include "core/frustum.h"

#include <limits>

#include "tests/core/matchers.h"
#include "tests/core/random_walls.h"

namespace vindu {
namespace {

using testing::IsNearPoint;
using testing::Random;
using testing::tromso_grid;

Eigen::Vector4d lrbt(const FrustumExtents& extents) {
  return {extents.left_m, extents.right_m, extents.bottom_m, extents.top_m};
}

// Our extents hold at any near, the thesis' only at near = e_z: hence the factor.
TEST(Frustum, OfEveryTileIsTheThesisFrustumForAnyEyeAndNear) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  Random random(32);
  for (int i = 0; i < 200; ++i) {
    const Vec3 eye = random.eye_in_wall();
    const double near_m = random.between(0.001, 5);
    const CameraEvent event = camera_event_from(eye, near_m);
    for (const Tile& tile : wall.tiles) {
      const FrustumExtents thesis =
          add(thesis_tile_extents(wall.grid, tile.column, tile.row), event.relative);
      const auto kooima = frustum_extents(tile.corners, eye, near_m);
      ASSERT_TRUE(kooima);
      EXPECT_LE((lrbt(thesis) * near_m / eye.z() - lrbt(*kooima)).norm(), 1e-12 * near_m / eye.z())
          << tile.name << ", eye " << eye.transpose() << ", near " << near_m;
    }
  }
}

TEST(Frustum, OnTheScreenPlaneIsTheTileItself) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  const auto extents = frustum_extents(wall.tiles[0].corners, {0, 0, 2}, 2);
  ASSERT_TRUE(extents);
  EXPECT_NEAR(extents->left_m, -5.185 / 2, 1e-12);
  EXPECT_NEAR(extents->right_m, -5.185 / 2 + 5.185 / 7, 1e-12);
  EXPECT_NEAR(extents->bottom_m, -2.238 / 2, 1e-12);
  EXPECT_NEAR(extents->top_m, -2.238 / 2 + 2.238 / 4, 1e-12);
}

TEST(Frustum, OfNeighboursSharesTheSeam) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  const Vec3 eye(0.3, -0.2, 0.4);
  const auto left = frustum_extents(wall.find("tile-2-1")->corners, eye, kNear_m);
  const auto right = frustum_extents(wall.find("tile-3-1")->corners, eye, kNear_m);
  const auto above = frustum_extents(wall.find("tile-2-2")->corners, eye, kNear_m);
  ASSERT_TRUE(left && right && above);
  EXPECT_NEAR(left->right_m, right->left_m, 1e-16);
  EXPECT_NEAR(left->top_m, above->bottom_m, 1e-16);
}

TEST(Frustum, IsTheSameWhereverTheTileStands) {
  Random random(33);
  const TileCorners flat{{-0.4, -0.3, 0}, {0.4, -0.3, 0}, {-0.4, 0.3, 0}};
  for (int i = 0; i < 50; ++i) {
    const Rigid3 moved = random.rigid();
    const Vec3 eye = random.eye_in_wall();
    const TileCorners there{moved * flat.lower_left_in_wall, moved * flat.lower_right_in_wall,
                            moved * flat.upper_left_in_wall};
    const auto here = frustum_extents(flat, eye, 0.1);
    const auto extents = frustum_extents(there, moved * eye, 0.1);
    ASSERT_TRUE(here && extents);
    EXPECT_LE((lrbt(*here) - lrbt(*extents)).norm(), 1e-12 * lrbt(*here).norm());
  }
}

TEST(Frustum, IsEmptyForAnEyeAtOrBehindTheTilesPlane) {
  const TileCorners tile{{-0.4, -0.3, 0}, {0.4, -0.3, 0}, {-0.4, 0.3, 0}};
  for (const double z_m : {kNear_m, 0.0, -0.5}) {
    EXPECT_FALSE(frustum_extents(tile, {0.1, 0, z_m}, 0.1)) << z_m;
    EXPECT_FALSE(clip_from_wall(tile, {0.1, 0, z_m})) << z_m;
  }
  EXPECT_TRUE(frustum_extents(tile, {0.1, 0, 1.01 * kNear_m}, 0.1));
  EXPECT_TRUE(clip_from_wall(tile, {0.1, 0, 1.01 * kNear_m}));
}

TEST(Frustum, IsEmptyForAnEyeThatIsNoNumberOrInfinitelyFarAway) {
  const TileCorners tile{{-0.4, -0.3, 0}, {0.4, -0.3, 0}, {-0.4, 0.3, 0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(frustum_extents(tile, {0, 0, nan}, 0.1));
  EXPECT_FALSE(clip_from_wall(tile, {nan, 0, 1}));
  EXPECT_FALSE(clip_from_wall(tile, {0, 0, std::numeric_limits<double>::infinity()}));
}

TEST(Frustum, DistanceIsPositiveOnTheViewersSide) {
  const TileCorners tile{{-0.4, -0.3, 0.5}, {0.4, -0.3, 0.5}, {-0.4, 0.3, 0.5}};
  EXPECT_DOUBLE_EQ(distance_to_tile(tile, {7, -3, 2}), 1.5);
  EXPECT_DOUBLE_EQ(distance_to_tile(tile, {7, -3, -1}), -1.5);
}

TEST(CameraEvent, SaysTheEyeAsTheThesisDoes) {
  const CameraEvent event = camera_event_from({0.5, -0.2, 1.8}, 0.02);
  EXPECT_THAT(event.position_in_wall, IsNearPoint(Vec3(0.5, -0.2, 1.8), 0));
  EXPECT_THAT(event.rotation, testing::IsNearRotation(Quat::Identity(), 0));
  EXPECT_EQ(lrbt(event.relative), Eigen::Vector4d(-0.5, -0.5, 0.2, 0.2));
  EXPECT_DOUBLE_EQ(event.near_m, 0.02);
  EXPECT_EQ(event.far_m, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(event.distance_m, 1.8);
}

}  // namespace
}  // namespace vindu
