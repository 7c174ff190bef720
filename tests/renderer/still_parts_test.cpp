// Parts that stand still are joined, and every triangle stays where it was.
#include "renderer/still_parts.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "renderer/chunks.h"
#include "renderer/packed_scene.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::SizeIs;

constexpr Eigen::Index kCornerNumbers = 11;
/// Three corners: position, normal and tangent in the scene, bitangent sign, the material.
using ShownTriangle = Eigen::Matrix<float, kCornerNumbers, 3>;

/// What a scene shows at a time, by its definition.
std::vector<ShownTriangle> shown_triangles(const Scene& scene, double time_s = 0) {
  const std::vector<Eigen::Matrix4f> transforms = node_transforms(scene, time_s);
  std::vector<ShownTriangle> triangles;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    for (const int index : scene.nodes[node].meshes) {
      const Mesh& mesh = scene.meshes[index];
      const Eigen::Matrix3f linear = transforms[node].topLeftCorner<3, 3>();
      const bool mirrored = linear.determinant() < 0;
      for (std::uint32_t i = 0; i < mesh.index_count; i += 3) {
        ShownTriangle triangle;
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t corner = mirrored ? 2 - k : k;  // the same side is in front
          const Vertex& vertex = scene.vertices[scene.indices[mesh.first_index + i + corner]];
          triangle.col(k) << (transforms[node] * vertex.position_in_node.homogeneous()).head<3>(),
              (linear.inverse().transpose() * vertex.normal_in_node).normalized(),
              (linear * vertex.tangent_in_node).normalized(),
              mirrored ? -vertex.bitangent_sign : vertex.bitangent_sign,
              static_cast<float>(mesh.material);
        }
        triangles.push_back(triangle);
      }
    }
  return triangles;
}

/// Each has its own among the others, whichever corner comes first.
void expect_same_triangles(const Scene& joined, const Scene& scene, double time_s = 0,
                           float tolerance = 1e-5f) {
  std::vector<ShownTriangle> rest = shown_triangles(scene, time_s);
  const std::vector<ShownTriangle> triangles = shown_triangles(joined, time_s);
  ASSERT_EQ(triangles.size(), rest.size());
  for (const ShownTriangle& triangle : triangles) {
    const auto is_same = [&](const ShownTriangle& other) {
      for (const int turn : {0, 1, 2}) {
        ShownTriangle turned;
        for (int k = 0; k < 3; ++k) turned.col(k) = other.col((k + turn) % 3);
        if ((turned - triangle).cwiseAbs().maxCoeff() < tolerance) return true;
      }
      return false;
    };
    const auto found = std::ranges::find_if(rest, is_same);
    ASSERT_NE(found, rest.end()) << triangle;
    rest.erase(found);
  }
}

Scene joined(Scene scene) {
  join_still_parts(scene);
  EXPECT_EQ(fault_of(pack(scene)), "");
  return scene;
}

Eigen::Matrix4f turned(float angle_rad) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topLeftCorner<3, 3>() =
      Eigen::AngleAxisf(angle_rad, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  return matrix;
}

/// Squares with normals and tangents of their own, of two materials, below nodes that move, turn,
/// stretch and mirror.
Scene tree(int parts) {
  Scene scene;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> between(-2, 2);
  scene.nodes.push_back(empty_node(moved_by(1, 2, 3) * turned(1)));
  for (int part = 0; part < parts; ++part) {
    const int parent = static_cast<int>(random() % scene.nodes.size());
    const float mirror = part % 3 == 0 ? -1.0f : 1.0f;
    add_square(scene, plain(1, 1, 1),
               moved_by(between(random), between(random), between(random)) *
                   turned(between(random)) * scaled_by(mirror, 0.5f, 1.5f),
               parent);
    scene.meshes.back().material = part % 2;
  }
  for (Vertex& vertex : scene.vertices) {
    vertex.normal_in_node = Eigen::Vector3f(between(random), between(random), 3).normalized();
    vertex.tangent_in_node = Eigen::Vector3f(3, between(random), between(random)).normalized();
  }
  return scene;
}

int meshes_shown(const Scene& scene) {
  int count = 0;
  for (const Node& node : scene.nodes) count += static_cast<int>(node.meshes.size());
  return count;
}

TEST(StillParts, BecomeOneMeshOfEachMaterial) {
  const Scene scene = tree(12), one = joined(scene);
  EXPECT_THAT(one.meshes, SizeIs(2));
  EXPECT_THAT(one.nodes, SizeIs(2));  // the root, and where they are now
  EXPECT_EQ(one.vertices.size(), scene.vertices.size());
  expect_same_triangles(one, scene);
}

TEST(StillParts, OfOneMaterialEachAreLeftAlone) {
  Scene scene = tree(2);
  EXPECT_THAT(joined(scene).nodes, SizeIs(scene.nodes.size()));
}

TEST(StillParts, LeaveAPartThatIsAnimatedAndAllBelowIt) {
  Scene scene = tree(12);
  scene.animations.push_back({.name = "wave", .duration_s = 2, .channels = {}});
  Animation& animation = scene.animations.back();
  AnimationChannel& channel = animation.channels.emplace_back();
  channel.node = 3;
  channel.translations = {{0, Eigen::Vector3f::Zero()}, {2, Eigen::Vector3f::Ones()}};
  const int below = add_square(scene, plain(1, 0, 0), moved_by(0, 1, 0), channel.node);
  scene.meshes.back().material = 0;
  const Scene one = joined(scene);
  EXPECT_LT(meshes_shown(one), meshes_shown(scene));
  EXPECT_GE(meshes_shown(one), 2 + 2);
  for (const double time_s : {0.0, 0.7, 1.9}) expect_same_triangles(one, scene, time_s);
  EXPECT_TRUE(std::ranges::any_of(
      one.nodes, [&](const Node& node) { return node.name == scene.nodes[below].name; }));
}

TEST(StillParts, StayTogetherWhereManyNodesShowALargeOne) {
  Scene scene = tree(6);
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 3 * kChunkTriangles + 3; ++i) {
    vertices.push_back({.position_in_node = Eigen::Vector3f::Random()});
    indices.push_back(i);
  }
  const int large = add_mesh(scene, vertices, indices, plain(0, 1, 0));
  for (int copy = 0; copy < 3; ++copy) {
    scene.nodes.push_back(empty_node(moved_by(static_cast<float>(copy), 0, 0), 0));
    scene.nodes.back().meshes = {large};
  }
  const Scene one = joined(scene);
  EXPECT_THAT(one.meshes, SizeIs(3));
  EXPECT_EQ(meshes_shown(one), 2 + 3);
  EXPECT_EQ(one.vertices.size(), scene.vertices.size());
  expect_same_triangles(one, scene);
}

TEST(StillParts, AreCopiedWhereManyNodesShowASmallOne) {
  Scene scene = tree(4);
  for (int copy = 0; copy < 5; ++copy) {
    scene.nodes.push_back(empty_node(moved_by(static_cast<float>(copy), 3, 0), 0));
    scene.nodes.back().meshes = {0};
  }
  const Scene one = joined(scene);
  EXPECT_THAT(one.meshes, SizeIs(2));
  expect_same_triangles(one, scene);
}

TEST(StillParts, MayShareTheirVertices) {
  Scene scene = tree(4);
  scene.indices.insert(scene.indices.end(), {0, 4, 2});  // of the first mesh and the second
  scene.meshes.push_back({.first_index = static_cast<std::uint32_t>(scene.indices.size()) - 3,
                          .index_count = 3,
                          .material = 1,
                          .bounds_in_node = scene.meshes[0].bounds_in_node});
  scene.nodes.push_back(empty_node(moved_by(0, 5, 0), 0));
  scene.nodes.back().meshes = {4};
  expect_same_triangles(joined(scene), scene);
}

TEST(StillParts, ThatAreBlendedStayApart) {
  Scene scene = tree(8);
  scene.materials[1].alpha_mode = AlphaMode::blend;
  const Scene one = joined(scene);
  EXPECT_EQ(meshes_shown(one), 1 + 4);
  EXPECT_THAT(one.nodes, SizeIs(2));
  expect_same_triangles(one, scene);
}

TEST(StillParts, ThatAreFlatOrSkinnedAreLeftAlone) {
  Scene scene = tree(6);
  const int flat = add_square(scene, plain(1, 1, 1), scaled_by(1, 1, 0), 0);
  const int skinned = add_square(scene, plain(1, 1, 1), moved_by(1, 0, 0), 0);
  for (const int node : {flat, skinned}) scene.meshes[scene.nodes[node].meshes[0]].material = 0;
  scene.meshes.back().skinned = true;
  scene.joints = {{.node = 4}};
  scene.influences.assign(scene.vertices.size(), {.joints = {}, .weights = {kFullWeight, 0, 0, 0}});
  const Scene one = joined(scene);
  EXPECT_EQ(meshes_shown(one), 2 + 2);
  EXPECT_EQ(one.influences.size(), one.vertices.size());
  EXPECT_EQ(one.nodes[one.joints[0].node].name, scene.nodes[4].name);
}

/// Surveyors' coordinates: a float has steps of 6 cm there.
TEST(StillParts, KeepTheirSizeFarFromTheOrigin) {
  Scene scene;
  scene.nodes.push_back(empty_node(moved_by(600000, 5e6f, 100)));
  for (int part = 0; part < 3; ++part) {
    add_square(scene, plain(1, 1, 1), moved_by(0.01f * static_cast<float>(part), 0, 0), 0);
    scene.meshes.back().material = 0;
  }
  const Scene one = joined(scene);
  ASSERT_THAT(one.meshes, SizeIs(1));
  EXPECT_NEAR(one.meshes[0].bounds_in_node.sizes().x(), 2.02, 1e-5);
  EXPECT_LT(one.meshes[0].bounds_in_node.center().norm(), 1e-4);
}

}  // namespace
}  // namespace vindu
