// Where two rays meet, or pass each other.
#include "tracker/triangulation.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

Ray ray_to(const Vec3& from, const Vec3& to) { return {from, (to - from).normalized()}; }

TEST(Triangulation, finds_the_point_where_two_rays_meet) {
  const Vec3 point(0.2, 1.7, 2.1);
  const auto found = triangulate(ray_to({-1, 2.3, 5}, point), ray_to({1, 2.2, 5}, point));
  ASSERT_TRUE(found);
  EXPECT_LT((found->x_in_room - point).norm(), 1e-12);
  EXPECT_LT(found->gap_m, 1e-12);
}

TEST(Triangulation, takes_the_middle_of_the_gap_and_reports_its_length) {
  // One ray along +x at height 0, one along +y ... at z = 0.04: they pass each other above (3, 2).
  const Ray along_x{{0, 2, 0}, Vec3::UnitX()}, along_y{{3, 0, 0.04}, Vec3::UnitY()};
  const auto found = triangulate(along_x, along_y);
  ASSERT_TRUE(found);
  EXPECT_LT((found->x_in_room - Vec3(3, 2, 0.02)).norm(), 1e-12);
  EXPECT_NEAR(found->gap_m, 0.04, 1e-12);
}

TEST(Triangulation, parallel_rays_meet_nowhere) {
  const Vec3 direction = Vec3(1, 2, -3).normalized();
  EXPECT_FALSE(triangulate({{0, 0, 0}, direction}, {{0, 1, 0}, direction}));
  EXPECT_FALSE(triangulate({{0, 0, 0}, direction}, {{0, 1, 0}, -direction}));
  EXPECT_FALSE(triangulate({{0, 0, 0}, direction}, {{0, 0, 0}, direction}));
}

TEST(Triangulation, rays_do_not_meet_behind_their_origins) {
  const Vec3 behind(0, 1, 6);
  const Ray a{{-1, 1, 5}, -(behind - Vec3(-1, 1, 5)).normalized()};
  const Ray b{{1, 1, 5}, -(behind - Vec3(1, 1, 5)).normalized()};
  EXPECT_FALSE(triangulate(a, b));
}

TEST(Triangulation, of_nearly_parallel_rays_keeps_its_digits) {
  const Vec3 point(0, 0, -1000);  // 1 m apart at 1 km: 1 mrad
  const auto found = triangulate(ray_to({-0.5, 0, 0}, point), ray_to({0.5, 0, 0}, point));
  ASSERT_TRUE(found);
  EXPECT_LT((found->x_in_room - point).norm(), 1e-6);
}

}  // namespace
}  // namespace vindu
