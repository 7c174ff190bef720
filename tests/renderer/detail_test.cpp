// How large an error in the scene looks: never larger on any tile than what is reckoned with.
#include "renderer/detail.h"

#include <gmock/gmock.h>

#include <random>

#include "core/wall.h"
#include "renderer/view.h"

namespace vindu {
namespace {

Wall wall_bent_by(double curve_deg) {
  return expand_wall({.columns = 7,
                      .rows = 4,
                      .width_m = 5.185,
                      .height_m = 2.238,
                      .tile_width_px = 1024,
                      .tile_height_px = 768,
                      .curve_deg = curve_deg,
                      .mount = {}},
                     {}, {});
}

class Random {
 public:
  double between(double least, double largest) {
    return std::uniform_real_distribution<double>(least, largest)(engine_);
  }
  Vec3 in_box(const Vec3& least, const Vec3& largest) {
    return {between(least.x(), largest.x()), between(least.y(), largest.y()),
            between(least.z(), largest.z())};
  }
  std::size_t index(std::size_t count) { return engine_() % count; }

 private:
  std::mt19937 engine_{4};
};

/// Where the eye sees the point on the tile's plane.
Vec3 on_plane(const TileCorners& tile, const Vec3& eye, const Vec3& point) {
  const Vec3 normal = (tile.lower_right_in_wall - tile.lower_left_in_wall)
                          .cross(tile.upper_left_in_wall - tile.lower_left_in_wall);
  const Vec3 ray = point - eye;
  return eye + ray * (normal.dot(tile.lower_left_in_wall - eye) / normal.dot(ray));
}

TEST(Detail, NeverLooksCoarserOnAnyTileThanReckoned) {
  Random random;
  int near_the_bound = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Wall wall = wall_bent_by(trial % 2 ? 50 : 0);
    const Tile& tile = wall.tiles[random.index(wall.tiles.size())];
    const Vec3 eye = random.in_box({-3, -1, 0.2}, {3, 1, 3});
    if (!tile_view(tile.corners, eye)) continue;
    const Vec3 shown =
        tile.corners.lower_left_in_wall +
        random.between(0, 1) *
            (tile.corners.lower_right_in_wall - tile.corners.lower_left_in_wall) +
        random.between(0, 1) * (tile.corners.upper_left_in_wall - tile.corners.lower_left_in_wall);
    const double depth = std::pow(10, random.between(-0.7, 1));
    const Vec3 point = eye + depth * (shown - eye);
    const double error_m = 1e-3 * depth;
    const Vec3 moved = point + error_m * random.in_box({-1, -1, -1}, {1, 1, 1}).normalized();
    Box3f box(point.cast<float>());
    box.extend(moved.cast<float>());
    box.extend(
        (point + random.between(0, 0.3) * random.in_box({-1, -1, -1}, {1, 1, 1})).cast<float>());
    const double seen_m = (on_plane(tile.corners, eye, moved) - shown).norm();
    double bound_m = 0;
    for (const ScreenPlane& plane : detail_need(wall, eye).planes)
      bound_m = std::max(bound_m, largest_on_screen_m(plane, eye, box, error_m));
    ASSERT_LE(seen_m, 1.001 * bound_m) << trial << ' ' << tile.name << ' ' << eye.transpose();
    near_the_bound += seen_m > 0.5 * bound_m;
  }
  EXPECT_GT(near_the_bound, 500);  // it is no idle bound
}

TEST(Detail, IsNeverFineAroundABoxWhereItIsNotFineWithin) {
  Random random;
  const Wall wall = wall_bent_by(30);
  for (int trial = 0; trial < 5000; ++trial) {
    const Vec3 eye = random.in_box({-3, -1, 0.2}, {3, 1, 3});
    Box3f inner;
    for (int corner = 0; corner < 2; ++corner)
      inner.extend(random.in_box({-3, -3, -9}, {3, 3, 3}).cast<float>());
    Box3f outer = inner;
    outer.extend(random.in_box({-3, -3, -9}, {3, 3, 3}).cast<float>());
    for (const ScreenPlane& plane : detail_need(wall, eye).planes)
      ASSERT_LE(largest_on_screen_m(plane, eye, inner, 1),
                1.000001 * largest_on_screen_m(plane, eye, outer, 1));
  }
}

TEST(Detail, OfAFlatWallHasOnePlaneAndTheSmallestPitch) {
  const DetailNeed need = detail_need(wall_bent_by(0), {0, 0, 2});
  ASSERT_EQ(need.planes.size(), 1u);
  EXPECT_NEAR(need.planes[0].eye_off_m, 2, 1e-9);
  EXPECT_NEAR(need.planes[0].steepest_m, (4 + 2.5925 * 2.5925 + 1.119 * 1.119) / 2, 1e-6);
  EXPECT_NEAR(need.pixel_m, 5.185 / 7168, 1e-6);
  EXPECT_EQ(detail_need(wall_bent_by(50), {0, 0, 2}).planes.size(), 7u);
  EXPECT_NEAR(detail_need(wall_bent_by(0), {0, 0, 2}, 0.25).pixel_m, 4 * need.pixel_m, 1e-9);
}

TEST(Detail, IsHalfAPixel) {
  const TileCorners screen{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  const Vec3 eye(0, 0, 2);
  const DetailNeed need = detail_need(screen, {200, 200}, eye);
  const Eigen::Vector3f far(0, 0, -2);  // twice as far as the screen: half as large on it
  EXPECT_TRUE(fine_enough(need, eye, Box3f(far), 0.0099));
  EXPECT_FALSE(fine_enough(need, eye, Box3f(far), 0.0101));
  EXPECT_FALSE(fine_enough(need, eye, Box3f(Eigen::Vector3f(0, 0, 2)), 1e-9));
  EXPECT_FALSE(fine_enough(DetailNeed{}, eye, Box3f(far), 1e-9));
}

}  // namespace
}  // namespace vindu
