// Tangents: where a normal map's +x points on a surface, and which way its +y.
#include "renderer/import_tangents.h"

#include <gtest/gtest.h>

#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using testing::add_mesh;
using testing::square_vertices;

/// A square in z = 0 whose texture coordinates went through this.
Scene square_with(const UvTransform& change) {
  std::vector<Vertex> vertices = square_vertices();
  for (Vertex& vertex : vertices)
    vertex.uv = change * Eigen::Vector3f(vertex.uv.x(), vertex.uv.y(), 1);
  Scene scene;
  add_mesh(scene, vertices, {0, 1, 3, 0, 3, 2}, {});
  return scene;
}

UvTransform rows(float a, float b, float c, float d) {
  UvTransform matrix;
  matrix << a, b, 0, c, d, 0;
  return matrix;
}

Eigen::Vector3f up_the_picture(const Vertex& vertex) {
  return vertex.bitangent_sign * vertex.normal_in_node.cross(vertex.tangent_in_node);
}

void expect_directions(Scene scene, const TextureUse& use, const Eigen::Vector3f& right,
                       const Eigen::Vector3f& up) {
  complete_tangents(scene, scene.meshes[0], use);
  for (const std::uint32_t index : scene.indices) {
    const Vertex& vertex = scene.vertices[index];
    EXPECT_TRUE(vertex.tangent_in_node.isApprox(right, 1e-5f)) << vertex.tangent_in_node;
    EXPECT_TRUE(up_the_picture(vertex).isApprox(up, 1e-5f)) << up_the_picture(vertex);
  }
}

TEST(ImportTangents, PointWhereThePictureGrows) {
  expect_directions(square_with(rows(1, 0, 0, 1)), {}, {1, 0, 0}, {0, 1, 0});
}

TEST(ImportTangents, FollowATurnedPicture) {
  // u grows down the square, v (down the picture) to the left.
  expect_directions(square_with(rows(0, 1, -1, 0)), {}, {0, -1, 0}, {1, 0, 0});
}

TEST(ImportTangents, KeepUpWhereThePictureIsMirrored) {
  expect_directions(square_with(rows(-1, 0, 0, 1)), {}, {-1, 0, 0}, {0, 1, 0});
}

TEST(ImportTangents, FollowTheTexturesOwnTransform) {
  const TextureUse use{.image = 0, .texture_from_uv = rows(0, 1, -1, 0)};
  expect_directions(square_with(rows(1, 0, 0, 1)), use, {0, -1, 0}, {1, 0, 0});
}

TEST(ImportTangents, UseTheSecondCoordinatesWhereTheTextureDoes) {
  Scene scene = square_with(rows(1, 0, 0, 1));
  for (Vertex& vertex : scene.vertices) vertex.uv_1 = {-vertex.uv.x(), vertex.uv.y()};
  expect_directions(scene, {.image = 0, .uv_set = 1}, {-1, 0, 0}, {0, 1, 0});
}

/// Two squares side by side that share an edge; the texture runs to the edge and back.
Scene mirrored_at_an_edge() {
  std::vector<Vertex> vertices;
  for (const float y : {0.0f, 1.0f})
    for (const float x : {-1.0f, 0.0f, 1.0f})
      vertices.push_back({.position_in_node = {x, y, 0}, .uv = {1 - std::abs(x), 1 - y}});
  Scene scene;
  add_mesh(scene, vertices, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}, {});
  return scene;
}

TEST(ImportTangents, SplitAVertexBetweenAPictureAndItsMirrorImage) {
  Scene scene = mirrored_at_an_edge();
  complete_tangents(scene, scene.meshes[0], {});

  EXPECT_EQ(scene.vertices.size(), 8u);
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    const Vertex& vertex = scene.vertices[scene.indices[i]];
    const float right = i < 6 ? 1.0f : -1.0f;
    EXPECT_TRUE(vertex.tangent_in_node.isApprox(Eigen::Vector3f(right, 0, 0), 1e-5f));
    EXPECT_TRUE(up_the_picture(vertex).isApprox(Eigen::Vector3f::UnitY(), 1e-5f));
  }
}

TEST(ImportTangents, KeepThoseOfTheFile) {
  Scene scene = square_with(rows(1, 0, 0, 1));
  for (Vertex& vertex : scene.vertices) vertex.tangent_in_node = {0, 1, 0};
  complete_tangents(scene, scene.meshes[0], {});

  for (const Vertex& vertex : scene.vertices)
    EXPECT_EQ(vertex.tangent_in_node, Eigen::Vector3f(0, 1, 0));
}

TEST(ImportTangents, AreUnitVectorsAcrossTheNormalWhereTheTextureSaysNothing) {
  Scene scene = square_with(rows(0, 0, 0, 0));
  complete_tangents(scene, scene.meshes[0], {});

  for (const Vertex& vertex : scene.vertices) {
    EXPECT_NEAR(vertex.tangent_in_node.norm(), 1, 1e-5);
    EXPECT_NEAR(vertex.tangent_in_node.dot(vertex.normal_in_node), 0, 1e-5);
  }
}

}  // namespace
}  // namespace vindu
