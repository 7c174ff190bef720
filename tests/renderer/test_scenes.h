// The smallest scenes whose picture can be worked out by hand: rectangles in z = 0 that face the
// viewer, and boxes.
#pragma once

#include <Eigen/Geometry>

#include "renderer/scene.h"

namespace vindu::testing {

inline Eigen::Matrix4f moved_by(float x, float y, float z) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topRightCorner<3, 1>() = Eigen::Vector3f(x, y, z);
  return matrix;
}

inline Eigen::Matrix4f scaled_by(float x, float y, float z) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.diagonal().head<3>() = Eigen::Vector3f(x, y, z);
  return matrix;
}

/// An unlit material of one colour; linear.
inline Material plain(float red, float green, float blue, float alpha = 1) {
  Material material;
  material.base_colour = {red, green, blue, alpha};
  material.unlit = true;
  return material;
}

/// A node without meshes, at the root or below `parent`.
inline Node empty_node(const Eigen::Matrix4f& parent_from_node, int parent = -1) {
  Node node;
  node.parent = parent;
  node.parent_from_node = parent_from_node;
  return node;
}

/// Appends vertices and triangles as one mesh.
inline int add_mesh(Scene& scene, const std::vector<Vertex>& vertices,
                    const std::vector<std::uint32_t>& indices, const Material& material) {
  Mesh mesh{.first_index = static_cast<std::uint32_t>(scene.indices.size()),
            .index_count = static_cast<std::uint32_t>(indices.size()),
            .material = static_cast<int>(scene.materials.size()),
            .bounds_in_node = {}};
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const std::uint32_t index : indices) scene.indices.push_back(first + index);
  for (const Vertex& vertex : vertices) {
    scene.vertices.push_back(vertex);
    mesh.bounds_in_node.extend(vertex.position_in_node);
  }
  scene.materials.push_back(material);
  scene.meshes.push_back(mesh);
  return static_cast<int>(scene.meshes.size()) - 1;
}

/// Four corners of the square from -1 to 1 in z = 0, facing +z, from the lower left to the right
/// and up; uv (0, 0) at the upper left.
inline std::vector<Vertex> square_vertices() {
  std::vector<Vertex> vertices;
  for (const float y : {-1.0f, 1.0f})
    for (const float x : {-1.0f, 1.0f})
      vertices.push_back({.position_in_node = {x, y, 0}, .uv = {(1 + x) / 2, (1 - y) / 2}});
  return vertices;
}

/// Mesh and node: a square, moved and turned by `parent_from_node`.
inline int add_square(Scene& scene, const Material& material,
                      const Eigen::Matrix4f& parent_from_node, int parent = -1) {
  const int mesh = add_mesh(scene, square_vertices(), {0, 1, 3, 0, 3, 2}, material);
  scene.nodes.push_back({.name = "square " + std::to_string(mesh),
                         .parent = parent,
                         .parent_from_node = parent_from_node,
                         .meshes = {mesh}});
  return static_cast<int>(scene.nodes.size()) - 1;
}

inline Scene square_scene(const Material& material,
                          const Eigen::Matrix4f& parent_from_node = Eigen::Matrix4f::Identity()) {
  Scene scene;
  scene.name = "square";
  add_square(scene, material, parent_from_node);
  return scene;
}

/// The cube from -1 to 1, seen from outside and from inside.
inline Scene cube_scene(const Material& material) {
  Scene scene;
  scene.name = "cube";
  std::vector<Vertex> vertices;
  for (int corner = 0; corner < 8; ++corner)
    vertices.push_back({.position_in_node = {corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                                             corner & 4 ? 1.0f : -1.0f}});
  Material both_sides = material;
  both_sides.double_sided = true;
  const int mesh = add_mesh(scene, vertices, {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                              2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5},
                            both_sides);
  scene.nodes.push_back({.name = "cube", .meshes = {mesh}});
  return scene;
}

}  // namespace vindu::testing
