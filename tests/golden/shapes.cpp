#include "tests/golden/shapes.h"

#include <cmath>

#include "renderer/import_tangents.h"

namespace vindu::testing {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// Triangles over a grid of (columns + 1) x (rows + 1) vertices, row by row from the top.
void weave(int columns, int rows, Shape& shape) {
  const auto index = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      for (const std::uint32_t corner :
           {index(column, row), index(column, row + 1), index(column + 1, row + 1),
            index(column, row), index(column + 1, row + 1), index(column + 1, row)})
        shape.indices.push_back(corner);
}

std::uint8_t code(float part) {
  return static_cast<std::uint8_t>(std::lround(127.5f + 127.5f * part));
}

}  // namespace

Shape sphere(int rings) {
  Shape shape;
  for (int row = 0; row <= rings; ++row)
    for (int column = 0; column <= 2 * rings; ++column) {
      const Eigen::Vector2f uv(static_cast<float>(column) / static_cast<float>(2 * rings),
                               static_cast<float>(row) / static_cast<float>(rings));
      const float around = kTurn * uv.x(), down = 0.5f * kTurn * uv.y();
      const Eigen::Vector3f out(std::sin(down) * std::sin(around), std::cos(down),
                                std::sin(down) * std::cos(around));
      shape.vertices.push_back({.position_in_node = out, .normal_in_node = out, .uv = uv});
    }
  weave(2 * rings, rings, shape);
  return shape;
}

Shape torus(float tube_radius) {
  Shape shape;
  const int columns = 64, rows = 24;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const Eigen::Vector2f uv(static_cast<float>(column) / columns,
                               static_cast<float>(row) / rows);
      const float around = kTurn * uv.x(), down = kTurn * uv.y();
      const Eigen::Vector3f middle(std::sin(around), 0, std::cos(around));
      const Eigen::Vector3f out =
          std::cos(down) * Eigen::Vector3f::UnitY() + std::sin(down) * middle;
      shape.vertices.push_back({.position_in_node = middle + tube_radius * out,
                                .normal_in_node = out,
                                .uv = uv.cwiseProduct(Eigen::Vector2f(4, 1))});
    }
  weave(columns, rows, shape);
  return shape;
}

Shape square() { return {square_vertices(), {0, 1, 3, 0, 3, 2}}; }

Shape box() {
  Shape shape;
  for (int side = 0; side < 6; ++side) {
    const Eigen::Vector3f axis = side < 4 ? Eigen::Vector3f::UnitY() : Eigen::Vector3f::UnitX();
    const float degrees = side < 4 ? 90.0f * static_cast<float>(side) : side == 4 ? 90 : -90;
    const Eigen::Matrix4f turn = turned(degrees, axis);
    const auto first = static_cast<std::uint32_t>(shape.vertices.size());
    for (Vertex vertex : square_vertices()) {
      vertex.position_in_node =
          turn.topLeftCorner<3, 3>() * (vertex.position_in_node + Eigen::Vector3f::UnitZ());
      vertex.normal_in_node = turn.topLeftCorner<3, 3>() * vertex.normal_in_node;
      shape.vertices.push_back(vertex);
    }
    for (const std::uint32_t corner : {0, 1, 3, 0, 3, 2}) shape.indices.push_back(first + corner);
  }
  return shape;
}

int add(Scene& scene, const Shape& shape, const Material& material, const Eigen::Matrix4f& place,
        int parent) {
  const int mesh = add_mesh(scene, shape.vertices, shape.indices, material);
  const TextureUse& normal_map = material.texture(TextureRole::normal);
  if (normal_map.image >= 0)
    complete_tangents(scene, scene.meshes[static_cast<std::size_t>(mesh)], normal_map);
  Node node = empty_node(place, parent);
  node.meshes = {mesh};
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

int add(Scene& scene, Image picture) {
  scene.textures.push_back(std::move(picture));
  return static_cast<int>(scene.textures.size()) - 1;
}

void add_floor(Scene& scene, float y, const Material& material) {
  add(scene, square(), material,
      moved_by(0, y, -0.6f) * scaled_by(2, 1, 2) * turned(-90, Eigen::Vector3f::UnitX()));
}

Material lit(float red, float green, float blue, float roughness, float metallic) {
  Material material;
  material.base_colour = {red, green, blue, 1};
  material.roughness = roughness;
  material.metallic = metallic;
  return material;
}

Material glass(float red, float green, float blue, float alpha) {
  Material material = lit(red, green, blue, 0.1f);
  material.base_colour.w() = alpha;
  material.alpha_mode = AlphaMode::blend;
  material.double_sided = true;
  return material;
}

Eigen::Matrix4f turned(float degrees, const Eigen::Vector3f& axis) {
  Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
  matrix.topLeftCorner<3, 3>() =
      Eigen::AngleAxisf(kTurn / 360 * degrees, axis.normalized()).toRotationMatrix();
  return matrix;
}

Eigen::Matrix4f at(float x, float y, float z, float size) {
  return moved_by(x, y, z) * scaled_by(size, size, size);
}

Image chequered(int size_px, int side_px, Rgba8 first, Rgba8 second) {
  Image image = Image::filled(size_px, size_px, first);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x)
      if ((x / side_px + y / side_px) % 2) image.at(x, y) = second;
  return image;
}

Image letter(Rgba8 ground) {
  Image image = Image::filled(64, 64, ground);
  const Rgba8 ink{25, 25, 35, ground[3]};
  paste(Image::filled(8, 48, ink), 16, 8, image);
  paste(Image::filled(32, 8, ink), 16, 8, image);
  paste(Image::filled(24, 8, ink), 16, 28, image);
  return image;
}

Image bumps(int size_px, int count) {
  Image image = Image::filled(size_px, size_px, {128, 128, 255, 255});
  const float side = static_cast<float>(size_px) / static_cast<float>(count);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const float right = std::fmod(static_cast<float>(x) + 0.5f, side) / side * 2 - 1;
      const float up = 1 - std::fmod(static_cast<float>(y) + 0.5f, side) / side * 2;
      const Eigen::Vector2f out = Eigen::Vector2f(right, up) / 0.8f;
      if (out.norm() >= 0.95f) continue;
      image.at(x, y) = {code(out.x()), code(out.y()), code(std::sqrt(1 - out.squaredNorm())), 255};
    }
  return image;
}

Image discs(int size_px, int count, Rgba8 colour) {
  Image image = Image::filled(size_px, size_px, {colour[0], colour[1], colour[2], 0});
  const float side = static_cast<float>(size_px) / static_cast<float>(count);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const float right = std::fmod(static_cast<float>(x) + 0.5f, side) / side * 2 - 1;
      const float up = std::fmod(static_cast<float>(y) + 0.5f, side) / side * 2 - 1;
      if (std::hypot(right, up) < 0.7f) image.at(x, y) = colour;
    }
  return image;
}

}  // namespace vindu::testing
