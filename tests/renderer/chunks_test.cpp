// Cutting meshes into compact pieces: the same triangles, whose pieces know their bounds.
#include "renderer/chunks.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Ge;
using ::testing::Le;

using Triangle = std::array<Eigen::Vector3f, 3>;

/// Triangles of random places, in no order at all, shown by two nodes; between them a vertex that
/// none uses.
Scene random_scene(int triangle_count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> along(-10, 10), near_by(-.1f, .1f);
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (int triangle = 0; triangle < triangle_count; ++triangle) {
    const Eigen::Vector3f place(along(random), along(random), along(random));
    for (int corner = 0; corner < 3; ++corner) {
      indices.push_back(static_cast<std::uint32_t>(vertices.size()));
      Vertex vertex;
      vertex.position_in_node =
          place + Eigen::Vector3f(near_by(random), near_by(random), near_by(random));
      vertices.push_back(vertex);
    }
    vertices.emplace_back();
  }
  Scene scene;
  add_mesh(scene, vertices, indices, Material{});
  scene.nodes.assign(2, empty_node(Eigen::Matrix4f::Identity()));
  for (Node& node : scene.nodes) node.meshes = {0};
  return scene;
}

std::vector<Triangle> triangles_of(const Scene& scene, const Node& node) {
  std::vector<Triangle> triangles;
  for (const int index : node.meshes) {
    const Mesh& mesh = scene.meshes[index];
    const auto corner = [&](std::uint32_t i) {
      return scene.vertices[scene.indices[i]].position_in_node;
    };
    for (std::uint32_t i = mesh.first_index; i < mesh.first_index + mesh.index_count; i += 3)
      triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
  }
  return triangles;
}

TEST(Chunks, HoldEveryTriangleOnce) {
  const Scene whole = random_scene(1000);
  Scene cut = whole;
  cut_into_chunks(cut);
  for (const Node& node : cut.nodes)
    EXPECT_THAT(triangles_of(cut, node),
                ::testing::UnorderedElementsAreArray(triangles_of(whole, whole.nodes[0])));
}

TEST(Chunks, AreNoLargerThanAskedForAndKeepTheirMaterial) {
  Scene cut = random_scene(1000);
  cut_into_chunks(cut, 100);
  EXPECT_THAT(cut.meshes.size(), AllOf(Ge(10u), Le(20u)));
  for (const Mesh& mesh : cut.meshes) {
    EXPECT_LE(mesh.index_count, 300u);
    EXPECT_EQ(mesh.index_count % 3, 0u);
    EXPECT_EQ(mesh.material, 0);
  }
}

TEST(Chunks, HaveTheBoundsOfTheirOwnTriangles) {
  Scene cut = random_scene(1000);
  cut_into_chunks(cut);
  for (const Mesh& mesh : cut.meshes) {
    Box3f bounds;
    for (std::uint32_t i = mesh.first_index; i < mesh.first_index + mesh.index_count; ++i)
      bounds.extend(cut.vertices[cut.indices[i]].position_in_node);
    EXPECT_EQ(mesh.bounds_in_node.min(), bounds.min());
    EXPECT_EQ(mesh.bounds_in_node.max(), bounds.max());
  }
}

TEST(Chunks, AreCompact) {
  Scene cut = random_scene(4000);
  const float whole = cut.meshes.front().bounds_in_node.volume();
  cut_into_chunks(cut, 100);
  double sum = 0;
  for (const Mesh& mesh : cut.meshes) sum += mesh.bounds_in_node.volume();
  EXPECT_LT(sum, 4 * whole);  // 40 times the whole for triangles in no order
}

TEST(Chunks, LeaveASmallMeshWhole) {
  Scene cut = random_scene(static_cast<int>(kChunkTriangles));
  cut_into_chunks(cut);
  EXPECT_EQ(cut.meshes.size(), 1u);
}

TEST(Chunks, UseTheirVerticesInOrderAndDropThoseThatNoneUses) {
  Scene cut = random_scene(1000);
  cut_into_chunks(cut);
  std::uint32_t next = 0;
  for (const std::uint32_t index : cut.indices) {
    ASSERT_LE(index, next);
    next = std::max(next, index + 1);
  }
  EXPECT_EQ(next, cut.vertices.size());
  EXPECT_EQ(next, 3000u);
}

TEST(Chunks, OfAnEmptySceneAreNone) {
  Scene scene;
  cut_into_chunks(scene);
  EXPECT_TRUE(scene.meshes.empty());
}

TEST(Chunks, TakeAMeshWithoutAnyExtent) {
  Scene scene = random_scene(500);
  for (Vertex& vertex : scene.vertices) vertex.position_in_node.setConstant(3);
  scene.meshes.front().bounds_in_node =
      Box3f(Eigen::Vector3f::Constant(3), Eigen::Vector3f::Constant(3));
  cut_into_chunks(scene, 100);
  EXPECT_EQ(triangles_of(scene, scene.nodes[0]).size(), 500u);
}

}  // namespace
}  // namespace vindu
