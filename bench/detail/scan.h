// A model like those that scanners make: one closed surface of very many triangles of about the
// same size, with vertex colours, hills of all sizes, and noise. The same surface whatever the
// number of triangles. For the bench and for tests.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "renderer/scene.h"

namespace vindu {

struct ScanOptions {
  int triangles = 100000;          ///< about that many
  float noise_of_spacing = 0.02f;  ///< of vertices along the normal, one sigma
};

namespace scan {

/// The surface's distance from the middle: a ball with sums of waves in eight directions, from
/// hills as large as the ball to some of a sixtieth of it.
inline float radius(const Eigen::Vector3f& direction) {
  static const std::array<Eigen::Vector3f, 8> kWaves = [] {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    std::array<Eigen::Vector3f, 8> waves;
    for (Eigen::Vector3f& wave : waves)
      wave = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    return waves;
  }();
  float radius = 1;
  for (int octave = 0; octave < 7; ++octave) {
    float sum = 0;
    for (std::size_t i = 0; i < kWaves.size(); ++i)
      sum += std::sin(std::ldexp(2.3f, octave) * kWaves[i].dot(direction) +
                      1.7f * static_cast<float>(i) + static_cast<float>(octave));
    radius += 0.018f / std::pow(2.2f, static_cast<float>(octave)) * sum;
  }
  return radius;
}

inline Rgba8 colour(const Eigen::Vector3f& direction) {
  const auto level = [&](int axis, float frequency) {
    return static_cast<std::uint8_t>(
        170 + 50 * std::sin(frequency * direction[axis] + 3 * direction[(axis + 1) % 3]));
  };
  return {level(0, 9), level(2, 7), level(1, 11), 255};
}

/// A grid over the six faces of a cube, blown up to a ball. Faces share the vertices of their
/// edges.
class Grid {
 public:
  explicit Grid(int side)
      : side_(side), index_of_(6 * static_cast<std::size_t>(side + 1) * (side + 1)) {
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j) place(face, i, j);
  }

  const std::vector<Eigen::Vector3f>& directions() const { return directions_; }

  std::vector<std::uint32_t> triangles() const {
    std::vector<std::uint32_t> indices;
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < side_; ++i)
        for (int j = 0; j < side_; ++j) {
          const std::uint32_t a = at(face, i, j), b = at(face, i + 1, j),
                              c = at(face, i + 1, j + 1), d = at(face, i, j + 1);
          for (const std::uint32_t corner : {a, b, c, a, c, d}) indices.push_back(corner);
        }
    return indices;
  }

 private:
  std::size_t slot(int face, int i, int j) const {
    return (static_cast<std::size_t>(face) * (side_ + 1) + i) * (side_ + 1) + j;
  }
  std::uint32_t at(int face, int i, int j) const { return index_of_[slot(face, i, j)]; }

  /// In whole steps from -side to side on the cube.
  std::array<int, 3> on_cube(int face, int i, int j) const {
    const int axis = face / 2;
    std::array<int, 3> steps{};
    steps[axis] = face % 2 ? side_ : -side_;
    steps[(axis + 1) % 3] = 2 * (face % 2 ? i : j) - side_;
    steps[(axis + 2) % 3] = 2 * (face % 2 ? j : i) - side_;
    return steps;
  }

  void place(int face, int i, int j) {
    const std::array<int, 3> steps = on_cube(face, i, j);
    std::uint32_t& index = index_of_[slot(face, i, j)];
    for (int other = 0; other < face; ++other) {  // an edge's vertex may be there already
      const int axis = other / 2;
      if (steps[axis] != (other % 2 ? side_ : -side_)) continue;
      const int u = (steps[(axis + 1) % 3] + side_) / 2, v = (steps[(axis + 2) % 3] + side_) / 2;
      index = other % 2 ? at(other, u, v) : at(other, v, u);
      return;
    }
    index = static_cast<std::uint32_t>(directions_.size());
    Eigen::Vector3f direction;
    for (int axis = 0; axis < 3; ++axis)
      direction[axis] =
          std::tan(0.785398163f * static_cast<float>(steps[axis]) / static_cast<float>(side_));
    directions_.push_back(direction.normalized());
  }

  int side_;
  std::vector<std::uint32_t> index_of_;
  std::vector<Eigen::Vector3f> directions_;
};

/// Of each vertex, by the area of its triangles.
inline void add_normals(Scene& scene) {
  for (Vertex& vertex : scene.vertices) vertex.normal_in_node.setZero();
  for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) -> Vertex& {
      return scene.vertices[scene.indices[i + k]];
    };
    const Eigen::Vector3f normal =
        (corner(1).position_in_node - corner(0).position_in_node)
            .cross(corner(2).position_in_node - corner(0).position_in_node);
    for (std::size_t k = 0; k < 3; ++k) corner(k).normal_in_node += normal;
  }
  for (Vertex& vertex : scene.vertices) vertex.normal_in_node.normalize();
}

}  // namespace scan

inline Scene scan_scene(const ScanOptions& options) {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(options.triangles / 12.0))));
  const scan::Grid grid(side);
  std::mt19937 random(7);
  std::normal_distribution<float> noise(
      0, options.noise_of_spacing * 1.57f / static_cast<float>(side));
  Scene scene;
  scene.name = "scan";
  Mesh mesh;
  for (const Eigen::Vector3f& direction : grid.directions()) {
    Vertex vertex;
    vertex.position_in_node = (scan::radius(direction) + noise(random)) * direction;
    vertex.colour = scan::colour(direction);
    mesh.bounds_in_node.extend(vertex.position_in_node);
    scene.vertices.push_back(vertex);
  }
  scene.indices = grid.triangles();
  scan::add_normals(scene);
  mesh.index_count = static_cast<std::uint32_t>(scene.indices.size());
  scene.meshes = {mesh};
  scene.materials.emplace_back();
  scene.nodes.emplace_back().meshes = {0};
  return scene;
}

}  // namespace vindu
