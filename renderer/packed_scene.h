// A scene as the GPU takes it: geometry and pictures with their mipmaps as bytes that are copied as
// they are, whether a file of them is mapped into memory or they were just made of a Scene.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "renderer/skinning.h"

namespace vindu {

/// A direction by two numbers of 16 bits, 32767 for 1: the octahedron |x| + |y| + |z| = 1 with its
/// lower half folded outwards (Z. Cigolle et al., "Survey of Efficient Representations for
/// Independent Unit Vectors", 2014). At most 0.004 degrees off. shaders/scene.vert reads them.
struct PackedDirection {
  std::int16_t x = 0;
  std::int16_t y = 0;
};
/// Of any length; +z where it has none.
PackedDirection pack_direction(const Eigen::Vector3f& direction);
Eigen::Vector3f unpack_direction(PackedDirection packed);

/// What every vertex has. Positions stay whole: vertices at the seam of two meshes must meet, and a
/// house that is shown life-size has parts of a millimetre.
struct PackedVertex {
  Eigen::Vector3f position_in_node;
  PackedDirection normal_in_node;
};

/// Where a material asks for normal maps or second texture coordinates.
struct PackedDetail {
  Eigen::Vector2f uv_1;
  PackedDirection tangent_in_node;
  std::int16_t bitangent_sign = 1;  ///< or -1
  std::int16_t unused = 0;
};

/// Of all meshes; the lists that no material asks for are empty.
struct PackedGeometry {
  std::span<const PackedVertex> vertices;
  std::span<const Eigen::Vector2f> uvs;
  std::span<const Rgba8> colours;  ///< as Vertex::colour; empty: all are white
  std::span<const PackedDetail> details;
  std::span<const Influences> influences;
  std::span<const std::uint32_t> indices;
};

/// A picture for one kind of use, with its mipmaps one after another, from the whole picture to a
/// single pixel: each side half of the one before, rounded down.
struct PackedTexture {
  int image = 0;      ///< TextureUse::image
  bool srgb = false;  ///< it holds colours: smaller pictures were made of their light
  int width_px = 0;
  int height_px = 0;
  std::span<const Rgba8> pixels;
};

/// Colours of surfaces are coded as sRGB, all else is linear.
constexpr bool holds_colour(TextureRole role) {
  return role == TextureRole::base_colour || role == TextureRole::emissive;
}

/// A file that the model was read from, to notice that it has changed.
struct SceneSource {
  std::string path;  ///< absolute
  std::uint64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
};

struct PackedScene {
  SceneOutline scene;
  Box3f bounds_in_scene;                           ///< of all triangles at rest
  std::vector<std::vector<JointBox>> joint_boxes;  ///< of each mesh; empty: it is not skinned
  PackedGeometry geometry;
  std::vector<PackedTexture> textures;
  std::vector<std::string> warnings;   ///< what was lost when the model was read
  std::vector<SceneSource> sources;    ///< the model first
  std::shared_ptr<const void> memory;  ///< what the spans lie in
};

/// Of pictures that no material uses nothing is kept.
PackedScene pack(Scene scene);

/// What makes it unfit to be drawn, an index out of range say; empty: nothing.
std::string fault_of(const PackedScene& packed);

}  // namespace vindu
