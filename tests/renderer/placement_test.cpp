// Where a model stands before the wall, for each way of placing it.
#include "renderer/placement.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using ::testing::HasSubstr;

const Wall kWall = single_screen(5.0, 2.0, 1000, 400);

/// A scene of one triangle with the given bounds.
Scene scene_of(const Eigen::Vector3f& least, const Eigen::Vector3f& largest) {
  Scene scene;
  for (const Eigen::Vector3f& corner : {least, largest, least}) {
    scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
    scene.vertices.emplace_back().position_in_node = corner;
  }
  scene.meshes.push_back({.index_count = 3, .bounds_in_node = Box3f(least, largest)});
  scene.materials.emplace_back();
  scene.nodes.push_back({.name = "triangle", .meshes = {0}});
  return scene;
}

/// The scene's bounds where it was placed.
Eigen::AlignedBox3d bounds_in_wall(const Scene& scene, const Navigation& navigation) {
  const Box3f box = bounds_in_scene(scene);
  const Mat4 wall_from_scene = matrix_of(navigation.wall_from_scene, navigation.scale);
  Eigen::AlignedBox3d bounds;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 x_in_scene = box.corner(static_cast<Box3f::CornerType>(corner)).cast<double>();
    bounds.extend(Vec3((wall_from_scene * x_in_scene.homogeneous()).head<3>()));
  }
  return bounds;
}

TEST(Placement, FitsAWideModelToFourFifthsOfTheWidth) {
  const Scene scene = scene_of({100, 100, 100}, {300, 110, 150});
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  const auto bounds = bounds_in_wall(scene, placed.navigation);
  EXPECT_NEAR(bounds.sizes().x(), 4.0, 1e-5);
  EXPECT_NEAR(bounds.sizes().z(), 1.0, 1e-5);
}

TEST(Placement, FitsATallModelToFourFifthsOfTheHeight) {
  const Scene scene = scene_of({0, 0, 0}, {1, 8, 1});
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  EXPECT_NEAR(bounds_in_wall(scene, placed.navigation).sizes().y(), 1.6, 1e-5);
}

TEST(Placement, FitsADeepModelToTwiceTheWidth) {
  const Scene scene = scene_of({0, 0, -1000}, {1, 1, 0});
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  EXPECT_NEAR(bounds_in_wall(scene, placed.navigation).sizes().z(), 10.0, 1e-4);
}

TEST(Placement, CentresAFittedModelWithItsFrontInTheScreenPlane) {
  const Scene scene = scene_of({-7, 3, 20}, {-3, 4, 26});
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  const auto bounds = bounds_in_wall(scene, placed.navigation);
  EXPECT_NEAR(bounds.center().x(), 0, 1e-6);
  EXPECT_NEAR(bounds.center().y(), 0, 1e-6);
  EXPECT_NEAR(bounds.max().z(), 0, 1e-6);
  EXPECT_LT(bounds.min().z(), 0);
}

TEST(Placement, SaysTheSizeThatAModelWasFittedTo) {
  const Scene scene = scene_of({0, 0, 0}, {1, 8, 2});
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  EXPECT_EQ(placed.remark, "fitted to the wall: 0.2 x 1.6 x 0.4 m");
}

TEST(Placement, ShowsAModelWithAUnitInItsTrueSize) {
  Scene scene = scene_of({0, 0, 0}, {1500, 300, 200});
  scene.metres_per_unit = 0.001;
  const PlacedScene placed = place_scene(pack(scene), Placement::life_size, kWall);
  const auto bounds = bounds_in_wall(scene, placed.navigation);
  EXPECT_NEAR(bounds.sizes().x(), 1.5, 1e-6);
  EXPECT_NEAR(bounds.max().z(), 0, 1e-6);
  EXPECT_EQ(placed.remark, "shown life-size: 1.5 x 0.3 x 0.2 m");
}

TEST(Placement, FitsALifeSizeModelWithoutAUnitAndSaysSo) {
  const Scene scene = scene_of({0, 0, 0}, {1, 8, 1});
  const PlacedScene placed = place_scene(pack(scene), Placement::life_size, kWall);
  EXPECT_NEAR(bounds_in_wall(scene, placed.navigation).sizes().y(), 1.6, 1e-5);
  EXPECT_THAT(placed.remark, HasSubstr("does not state its unit"));
  EXPECT_THAT(placed.remark, HasSubstr("fitted"));
}

TEST(Placement, LeavesAnAsIsModelWhereItsCoordinatesSay) {
  Scene scene = scene_of({-1, 5, -9}, {1, 6, -3});
  scene.metres_per_unit = 0.01;
  const PlacedScene placed = place_scene(pack(scene), Placement::as_is, kWall);
  const auto bounds = bounds_in_wall(scene, placed.navigation);
  EXPECT_EQ(bounds.min(), Vec3(-1, 5, -9));
  EXPECT_EQ(bounds.max(), Vec3(1, 6, -3));
  EXPECT_EQ(placed.remark, "");
}

class FlatOrTinyBox : public ::testing::TestWithParam<Eigen::Vector3f> {};

TEST_P(FlatOrTinyBox, IsFittedInsideTheWallByAFiniteScale) {
  const Scene scene = scene_of({2, 2, 2}, Eigen::Vector3f(2, 2, 2) + GetParam());
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  const auto bounds = bounds_in_wall(scene, placed.navigation);
  EXPECT_TRUE(std::isfinite(placed.navigation.scale));
  EXPECT_GT(placed.navigation.scale, 0);
  EXPECT_LE(bounds.sizes().x(), 4.0 + 1e-4);
  EXPECT_LE(bounds.sizes().y(), 1.6 + 1e-4);
  EXPECT_TRUE(bounds.center().allFinite());
}

INSTANTIATE_TEST_SUITE_P(Placement, FlatOrTinyBox,
                         ::testing::Values(Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0),
                                           Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(0, 0, 1),
                                           Eigen::Vector3f(1, 1, 0), Eigen::Vector3f(0, 3, 3),
                                           Eigen::Vector3f(1e-6f, 1e-6f, 1e-6f)));

TEST(Placement, FitsAFlatPictureByItsLongerSides) {
  const Scene scene = scene_of({0, 0, 0}, {4, 3, 0});
  const PlacedScene placed = place_scene(pack(scene), Placement::fit, kWall);
  EXPECT_NEAR(bounds_in_wall(scene, placed.navigation).sizes().y(), 1.6, 1e-5);
}

}  // namespace
}  // namespace vindu
