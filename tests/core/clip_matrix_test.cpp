// clip_from_wall: Kooima's matrix where a tile's corners are at right angles, exact where they are
// not, with reversed depth that never ends.
#include <array>

#include "core/frustum.h"
#include "tests/core/matchers.h"
#include "tests/core/random_walls.h"

namespace vindu {
namespace {

using testing::IsNearMatrix;
using testing::Random;
using testing::tromso_grid;

/// x and y over w, and depth, as the rasteriser sees them.
Vec3 normalised(const Mat4& clip_from_wall, const Vec3& x_in_wall) {
  return (clip_from_wall * x_in_wall.homogeneous()).hnormalized();
}

/// The textbook's way, from Kooima's paper and the glFrustum manual page, with the depth row of an
/// infinite reversed projection: extents at near, axes of the screen, the eye at the origin.
Mat4 kooima_matrix(const TileCorners& corners, const Vec3& eye_in_wall, double near_m) {
  const Vec3 vr = (corners.lower_right_in_wall - corners.lower_left_in_wall).normalized();
  const Vec3 vu = (corners.upper_left_in_wall - corners.lower_left_in_wall).normalized();
  const Vec3 vn = vr.cross(vu);
  const Vec3 va = corners.lower_left_in_wall - eye_in_wall;
  const Vec3 vb = corners.lower_right_in_wall - eye_in_wall;
  const Vec3 vc = corners.upper_left_in_wall - eye_in_wall;
  const double d = -vn.dot(va), n = near_m;
  const double l = vr.dot(va) * n / d, r = vr.dot(vb) * n / d;
  const double b = vu.dot(va) * n / d, t = vu.dot(vc) * n / d;
  Mat4 projection, axes = Mat4::Identity(), to_eye = Mat4::Identity();
  projection << 2 * n / (r - l), 0, (r + l) / (r - l), 0,  //
      0, 2 * n / (t - b), (t + b) / (t - b), 0,            //
      0, 0, 0, n,                                          //
      0, 0, -1, 0;
  axes.topLeftCorner<3, 3>() << vr.transpose(), vu.transpose(), vn.transpose();
  to_eye.topRightCorner<3, 1>() = -eye_in_wall;
  return projection * axes * to_eye;
}

TEST(ClipMatrix, IsKooimasForEveryTileOfAFlatAndOfACurvedWall) {
  Random random(41);
  WallGrid curved = tromso_grid();
  curved.curve_deg = 30;
  for (const WallGrid& grid : {tromso_grid(), curved})
    for (const Tile& tile : expand_wall(grid, {}, {}).tiles)
      for (int i = 0; i < 20; ++i) {
        const Vec3 eye = random.eye_in_wall() + Vec3(0, 0, 1);
        const double near_m = random.between(0.001, 0.1);
        if (distance_to_tile(tile.corners, eye) < 0.05) continue;
        const auto clip = clip_from_wall(tile.corners, eye, near_m);
        ASSERT_TRUE(clip);
        const Mat4 expected = kooima_matrix(tile.corners, eye, near_m);
        EXPECT_THAT(*clip, IsNearMatrix(expected, 1e-12 * expected.norm())) << tile.name;
      }
}

TEST(ClipMatrix, PutsTheFourCornersOfASkewedTileAtTheCornersOfThePicture) {
  Random random(42);
  for (int i = 0; i < 100; ++i) {
    // Measured corners are never at right angles: each is off by up to 5 cm here.
    const TileCorners tile{Vec3(-0.4, -0.3, 0) + random.vector(0.05),
                           Vec3(0.4, -0.3, 0) + random.vector(0.05),
                           Vec3(-0.4, 0.3, 0) + random.vector(0.05)};
    const Vec3 eye(random.between(-2, 2), random.between(-1, 1), random.between(0.6, 4));
    const auto clip = clip_from_wall(tile, eye);
    ASSERT_TRUE(clip);
    const std::array<std::pair<Vec3, Vec2>, 4> corners = {{{tile.lower_left_in_wall, {-1, -1}},
                                                           {tile.lower_right_in_wall, {1, -1}},
                                                           {tile.upper_left_in_wall, {-1, 1}},
                                                           {tile.upper_right_in_wall(), {1, 1}}}};
    for (const auto& [x_in_wall, expected] : corners)
      EXPECT_LE((normalised(*clip, x_in_wall).head<2>() - expected).norm(), 1e-12);
  }
}

TEST(ClipMatrix, ProjectsAPointOntoTheTileAlongTheRayToTheEye) {
  Random random(43);
  const TileCorners tile{{-0.4, -0.3, 0}, {0.4, -0.28, 0.02}, {-0.41, 0.3, 0}};
  for (int i = 0; i < 100; ++i) {
    const Vec3 eye(random.between(-2, 2), random.between(-1, 1), random.between(0.6, 4));
    const double across = random.between(0, 1), up = random.between(0, 1);
    const Vec3 on_tile = tile.lower_left_in_wall +
                         across * (tile.lower_right_in_wall - tile.lower_left_in_wall) +
                         up * (tile.upper_left_in_wall - tile.lower_left_in_wall);
    const Vec3 behind = eye + random.between(0.1, 50) * (on_tile - eye);
    const auto clip = clip_from_wall(tile, eye);
    ASSERT_TRUE(clip);
    const Vec2 expected(2 * across - 1, 2 * up - 1);
    EXPECT_LE((normalised(*clip, behind).head<2>() - expected).norm(), 1e-11);
  }
}

TEST(ClipMatrix, DepthIsOneAtTheNearPlaneAndFallsToZeroAtInfinity) {
  const TileCorners tile{{-0.4, -0.3, 0}, {0.4, -0.3, 0}, {-0.4, 0.3, 0}};
  const Vec3 eye(0.2, 0.1, 2);
  const auto clip = clip_from_wall(tile, eye, 0.01);
  ASSERT_TRUE(clip);
  EXPECT_NEAR(normalised(*clip, {0, 0, 1.99}).z(), 1, 1e-12);
  EXPECT_NEAR(normalised(*clip, {0.3, 0.2, 0}).z(), 0.01 / 2, 1e-15);
  EXPECT_NEAR(normalised(*clip, {5, 3, -98}).z(), 0.01 / 100, 1e-15);
  const Vec4 infinitely_far = *clip * Vec4(0, 0, -1, 0);
  EXPECT_DOUBLE_EQ(infinitely_far.z() / infinitely_far.w(), 0);
}

TEST(ClipMatrix, DepthDoesNotDependOnTheTileOfAFlatWall) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  const Vec3 eye(-0.7, 0.3, 1.4), x_in_wall(0.2, 0.1, -3);
  for (const Tile& tile : wall.tiles)
    EXPECT_NEAR(normalised(*clip_from_wall(tile.corners, eye), x_in_wall).z(), kNear_m / 4.4,
                1e-15);
}

TEST(ClipMatrix, SeesNothingBehindTheEye) {
  const TileCorners tile{{-0.4, -0.3, 0}, {0.4, -0.3, 0}, {-0.4, 0.3, 0}};
  const auto clip = clip_from_wall(tile, {0, 0, 1});
  ASSERT_TRUE(clip);
  EXPECT_LT((*clip * Vec4(0, 0, 1.5, 1)).w(), 0);
  EXPECT_GT((*clip * Vec4(0, 0, 0.5, 1)).w(), 0);
}

}  // namespace
}  // namespace vindu
