// A scene in memory as plain values: what an importer makes and what the GPU gets. Geometry of all
// meshes lies in one vertex and one index array. Units and axes are the file's; Placement decides
// how it stands before the wall.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/image.h"
#include "renderer/skin.h"

namespace vindu {

struct Vertex {
  Eigen::Vector3f position_in_node = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_in_node = Eigen::Vector3f::UnitZ();
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();    ///< (0, 0) is the upper left of the texture
  Rgba8 colour = {255, 255, 255, 255};             ///< times the material's base colour
  Eigen::Vector2f uv_1 = Eigen::Vector2f::Zero();  ///< for textures with TextureUse::uv_set 1
  /// Where a normal map's +x points; its +y is cross(normal, tangent) * bitangent_sign. Zero where
  /// the material has no normal map.
  Eigen::Vector3f tangent_in_node = Eigen::Vector3f::Zero();
  float bitangent_sign = 1;
};

enum class Wrap { repeat, mirror, clamp };

/// x_in_texture = texture_from_uv * (u, v, 1); (0, 0) is the upper left on both sides.
using UvTransform = Eigen::Matrix<float, 2, 3>;

/// How a material lays a picture on its surface.
struct TextureUse {
  int image = -1;  ///< index into Scene::textures, or -1: none
  int uv_set = 0;  ///< Vertex::uv or Vertex::uv_1
  UvTransform texture_from_uv = UvTransform::Identity();
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
};

/// What a picture says of a surface: base colour and alpha, sRGB; roughness in green and metalness
/// in blue; the normal, +y up the picture; occlusion in red; emitted light, sRGB.
enum class TextureRole { base_colour, metallic_roughness, normal, occlusion, emissive };
constexpr std::size_t kTextureRoles = 5;

enum class AlphaMode { opaque, mask, blend };

/// Metallic-roughness as glTF 2.0 (section 3.9) defines it. Colours are coded as Scene::colours
/// says.
struct Material {
  std::string name;
  Eigen::Vector4f base_colour = Eigen::Vector4f::Ones();
  float metallic = 0;
  float roughness = 0.6f;
  Eigen::Vector3f emissive = Eigen::Vector3f::Zero();
  float normal_scale = 1;
  float occlusion_strength = 1;
  std::array<TextureUse, kTextureRoles> textures{};  ///< by role; times the numbers above
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;  ///< KHR_materials_unlit: the base colour as it is

  TextureUse& texture(TextureRole role) { return textures[static_cast<std::size_t>(role)]; }
  const TextureUse& texture(TextureRole role) const {
    return textures[static_cast<std::size_t>(role)];
  }
};

using Box3f = Eigen::AlignedBox3f;

struct Mesh {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;  ///< triangles: a multiple of 3; indices are absolute
  int material = 0;
  Box3f bounds_in_node;
  bool skinned = false;  ///< joints move its vertices, which are in the mesh's own frame
  // Levels of detail: indices into Scene::coarsenings, or -1. A mesh is drawn where the first is
  // fine enough and the second is not.
  int made_by = -1;      ///< its triangles are the coarser ones of this; -1: full detail
  int replaced_by = -1;  ///< the coarser triangles of this stand for its own; -1: none do
};

/// Meshes that lie together and what stands for them where it is fine enough: fewer triangles with
/// the same outer border (renderer/levels.h).
struct Coarsening {
  Box3f bounds_in_node;     ///< around all that the coarser triangles stand for
  float error_in_node = 0;  ///< at most so far off full detail
};

/// Parents come before their children; node 0 is the root.
struct Node {
  std::string name;
  int parent = -1;
  Eigen::Matrix4f parent_from_node = Eigen::Matrix4f::Identity();
  std::vector<int> meshes;
};

template <class Value>
struct Key {
  double t_s = 0;
  Value value;
};

/// Keys in order of time; an empty list leaves that part of the node's transform as it is.
struct AnimationChannel {
  int node = 0;
  std::vector<Key<Eigen::Vector3f>> translations;
  std::vector<Key<Eigen::Quaternionf>> rotations;
  std::vector<Key<Eigen::Vector3f>> scales;
};

struct Animation {
  std::string name;
  double duration_s = 0;
  std::vector<AnimationChannel> channels;
};

/// How a file's numbers for the colours of materials and vertices mean light. Pictures of colours
/// are always sRGB.
enum class ColourCoding { linear, srgb };

/// The sRGB transfer function (IEC 61966-2-1), decoding: [0, 1] -> [0, 1].
float linear_from_srgb(float encoded);

/// All of a scene that is small: what it is made of and how that moves.
struct SceneOutline {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<Coarsening> coarsenings;
  std::vector<Material> materials;  ///< at least one where there is a mesh
  std::vector<Node> nodes;
  std::vector<Animation> animations;
  std::vector<Joint> joints;
  ColourCoding colours = ColourCoding::linear;
  std::optional<double> metres_per_unit;  ///< empty: the file does not say

  std::size_t triangle_count() const;  ///< of full detail
};

struct Scene : SceneOutline {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Influences> influences;  ///< of each vertex; empty: nothing is skinned
  std::vector<Image> textures;
};

/// scene_from_node of every node at a time, an animation played round and round; at rest where
/// there is no animation of that number.
std::vector<Eigen::Matrix4f> node_transforms(const SceneOutline& scene, double animation_time_s,
                                             int clip = 0);

/// Of all triangles at rest.
Box3f bounds_in_scene(const Scene& scene);

}  // namespace vindu
