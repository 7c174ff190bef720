// The node tree: transforms at rest and over time, and the scene's bounds.
#include "renderer/scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace vindu {
namespace {

Eigen::Matrix4f moved_by(float x, float y, float z) {
  return Eigen::Affine3f(Eigen::Translation3f(x, y, z)).matrix();
}

Eigen::Quaternionf turned_about_y(float angle_rad) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(angle_rad, Eigen::Vector3f::UnitY()));
}

Eigen::Vector3f origin_of(const Eigen::Matrix4f& scene_from_node) {
  return scene_from_node.col(3).head<3>();
}

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2;

/// A root and its child, one unit to the right of it.
Scene two_nodes() {
  Scene scene;
  scene.nodes = {{"root", -1, Eigen::Matrix4f::Identity(), {}},
                 {"child", 0, moved_by(1, 0, 0), {}}};
  return scene;
}

AnimationChannel moving_root() {
  AnimationChannel channel;
  channel.translations = {{0, {0, 0, 0}}, {2, {0, 4, 0}}};
  channel.rotations = {{0, turned_about_y(0)}, {2, turned_about_y(kQuarterTurn)}};
  return channel;
}

/// As the scene's only mesh.
void add_triangle(Scene& scene, const std::array<Eigen::Vector3f, 3>& corners) {
  for (const Eigen::Vector3f& corner : corners) {
    scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
    scene.vertices.emplace_back().position_in_node = corner;
  }
  scene.meshes = {{.first_index = 0, .index_count = 3, .material = 0, .bounds_in_node = {}}};
}

TEST(NodeTransforms, AtRestComposeParents) {
  Scene scene = two_nodes();
  scene.nodes[0].parent_from_node = moved_by(0, 5, 0);

  const std::vector<Eigen::Matrix4f> transforms = node_transforms(scene, 7);

  EXPECT_TRUE(origin_of(transforms[1]).isApprox(Eigen::Vector3f(1, 5, 0)));
}

TEST(NodeTransforms, AnimatedParentCarriesItsChild) {
  Scene scene = two_nodes();
  scene.animations = {{"move", 2, {moving_root()}}};

  const std::vector<Eigen::Matrix4f> transforms = node_transforms(scene, 1);

  const float half = std::sqrt(0.5f);
  // Half of 4 up; half of a quarter turn takes the child's +x towards -z.
  EXPECT_TRUE(origin_of(transforms[0]).isApprox(Eigen::Vector3f(0, 2, 0), 1e-6f));
  EXPECT_TRUE(origin_of(transforms[1]).isApprox(Eigen::Vector3f(half, 2, -half), 1e-6f));
}

TEST(NodeTransforms, PlayRoundAndRound) {
  Scene scene = two_nodes();
  scene.animations = {{"move", 2, {moving_root()}}};

  for (const double t_s : {1.5, 3.5, 201.5, -0.5})
    EXPECT_FLOAT_EQ(origin_of(node_transforms(scene, t_s)[0]).y(), 3) << t_s;
}

TEST(NodeTransforms, HoldTheFirstAndLastKey) {
  Scene scene = two_nodes();
  AnimationChannel channel;
  channel.translations = {{1, {0, 1, 0}}, {2, {0, 2, 0}}};
  scene.animations = {{"move", 4, {channel}}};

  EXPECT_FLOAT_EQ(origin_of(node_transforms(scene, 0.5)[0]).y(), 1);
  EXPECT_FLOAT_EQ(origin_of(node_transforms(scene, 3.5)[0]).y(), 2);
}

TEST(NodeTransforms, PartsWithoutKeysStayAtRest) {
  Scene scene = two_nodes();
  Eigen::Affine3f at_rest = Eigen::Translation3f(3, 0, 0) * turned_about_y(0.4f);
  at_rest.scale(Eigen::Vector3f(2, 1, -1));  // mirrored
  scene.nodes[0].parent_from_node = at_rest.matrix();
  AnimationChannel channel;
  channel.translations = {{0, {9, 0, 0}}};
  scene.animations = {{"move", 1, {channel}}};

  Eigen::Matrix4f expected = at_rest.matrix();
  expected(0, 3) = 9;
  EXPECT_TRUE(node_transforms(scene, 0)[0].isApprox(expected, 1e-5f));
}

TEST(NodeTransforms, AnimationWithoutDurationShowsItsStart) {
  Scene scene = two_nodes();
  scene.animations = {{"still", 0, {moving_root()}}};

  EXPECT_TRUE(node_transforms(scene, 5)[0].isApprox(Eigen::Matrix4f::Identity(), 1e-6f));
}

TEST(BoundsInScene, CoverEveryInstanceOfAMesh) {
  Scene scene = two_nodes();
  add_triangle(scene, {{{0, 0, 0}, {1, 2, 0}, {0, 2, 3}}});
  scene.nodes[0].meshes = {0};
  scene.nodes[1].meshes = {0};
  scene.nodes[1].parent_from_node.topLeftCorner<3, 3>() =
      turned_about_y(kQuarterTurn).toRotationMatrix();  // +z becomes +x

  const Box3f bounds = bounds_in_scene(scene);

  EXPECT_TRUE(bounds.min().isApprox(Eigen::Vector3f(0, 0, -1), 1e-6f)) << bounds.min();
  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3f(4, 2, 3), 1e-6f)) << bounds.max();
}

TEST(BoundsInScene, AreThoseOfTurnedTrianglesNotOfTheirTurnedBox) {
  Scene scene = two_nodes();
  add_triangle(scene, {{{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}}});
  scene.nodes[0].meshes = {0};
  scene.nodes[0].parent_from_node.topLeftCorner<3, 3>() =
      turned_about_y(kQuarterTurn / 2).toRotationMatrix();

  EXPECT_NEAR(bounds_in_scene(scene).diagonal().x(), std::sqrt(2), 1e-6);
}

TEST(BoundsInScene, OfNothingAreEmpty) { EXPECT_TRUE(bounds_in_scene(two_nodes()).isEmpty()); }

}  // namespace
}  // namespace vindu
