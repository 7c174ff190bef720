// Shapes, pictures and materials that the golden scenes are made of; metres, in wall.
#pragma once

#include <numbers>

#include "renderer/scene.h"
#include "tests/renderer/test_scenes.h"

namespace vindu::testing {

/// Vertices and triangles; uv runs once over the shape.
struct Shape {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Radius 1, poles on y.
Shape sphere(int rings = 24);
/// Around y: radius 1 to the middle of the tube.
Shape torus(float tube_radius);
/// From -1 to 1, a face each side.
Shape box();
/// From -1 to 1 in z = 0, facing +z.
Shape square();

/// Mesh, node and material; tangents where the material has a normal map. Returns the node.
int add(Scene& scene, const Shape& shape, const Material& material, const Eigen::Matrix4f& place,
        int parent = -1);
/// A picture of the scene's; returns its index.
int add(Scene& scene, Image picture);
/// A floor at this height, 4 m wide, facing up.
void add_floor(Scene& scene, float y, const Material& material);

Material lit(float red, float green, float blue, float roughness = 0.5f, float metallic = 0);
/// Sees both sides, half seen through where alpha is a half.
Material glass(float red, float green, float blue, float alpha);

Eigen::Matrix4f turned(float degrees, const Eigen::Vector3f& axis);
/// At a place, of a size.
Eigen::Matrix4f at(float x, float y, float z, float size = 1);

/// Fields of `side_px` in two colours.
Image chequered(int size_px, int side_px, Rgba8 first, Rgba8 second);
/// An F, dark on the given ground: neither mirrored nor turned it looks the same.
Image letter(Rgba8 ground);
/// Normals of `count` x `count` half balls that stand out of a plane.
Image bumps(int size_px, int count);
/// `count` x `count` discs, opaque on nothing.
Image discs(int size_px, int count, Rgba8 colour);

}  // namespace vindu::testing
