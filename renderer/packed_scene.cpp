#include "renderer/packed_scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "renderer/mipmaps.h"
#include "renderer/surface_kind.h"

namespace vindu {
namespace {

constexpr float kOne = 32767;

std::int16_t in_16_bits(float value) {
  return static_cast<std::int16_t>(std::lround(kOne * value));
}

/// What a PackedScene's spans lie in.
struct Lists {
  std::vector<PackedVertex> vertices;
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Rgba8> colours;
  std::vector<PackedDetail> details;
  std::vector<Influences> influences;
  std::vector<std::uint32_t> indices;
  std::vector<std::vector<Rgba8>> pictures;
};

template <class Part>
auto of_each(const std::vector<Vertex>& vertices, const Part& part) {
  std::vector<decltype(part(vertices.front()))> parts;
  parts.reserve(vertices.size());
  for (const Vertex& vertex : vertices) parts.push_back(part(vertex));
  return parts;
}

SurfaceKind kinds_of(const Scene& scene) {
  SurfaceKind kinds = 0;
  for (const Material& material : scene.materials) kinds |= kind_of(material);
  return kinds;
}

constexpr SurfaceKind kTextured = (1u << kTextureRoles) - 1;
constexpr SurfaceKind kDetailed = kSecondUv | textured(TextureRole::normal);

void pack_vertices(const Scene& scene, Lists& lists) {
  const std::vector<Vertex>& vertices = scene.vertices;
  lists.vertices = of_each(vertices, [](const Vertex& vertex) {
    return PackedVertex{vertex.position_in_node, pack_direction(vertex.normal_in_node)};
  });
  const SurfaceKind kinds = kinds_of(scene);
  if (kinds & kTextured)
    lists.uvs = of_each(vertices, [](const Vertex& vertex) { return vertex.uv; });
  const auto is_white = [](const Vertex& vertex) {
    return vertex.colour == Rgba8{255, 255, 255, 255};
  };
  if (!std::ranges::all_of(vertices, is_white))
    lists.colours = of_each(vertices, [](const Vertex& vertex) { return vertex.colour; });
  if (kinds & kDetailed)
    lists.details = of_each(vertices, [](const Vertex& vertex) {
      const std::int16_t sign = vertex.bitangent_sign < 0 ? -1 : 1;
      return PackedDetail{vertex.uv_1, pack_direction(vertex.tangent_in_node), sign};
    });
}

/// Each picture once for each coding that a material asks for.
std::vector<PackedTexture> pack_textures(const Scene& scene, Lists& lists) {
  std::set<std::pair<int, bool>> wanted;
  for (const Material& material : scene.materials)
    for (std::size_t role = 0; role < kTextureRoles; ++role)
      if (const int image = material.textures[role].image; image >= 0)
        wanted.emplace(image, holds_colour(static_cast<TextureRole>(role)));
  std::vector<PackedTexture> textures;
  for (const auto& [index, srgb] : wanted) {
    const Image& image = scene.textures[static_cast<std::size_t>(index)];
    lists.pictures.push_back(mipmaps_of(image, srgb));
    textures.push_back({index, srgb, image.width_px, image.height_px, lists.pictures.back()});
  }
  return textures;
}

bool within(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool is_whole(const PackedTexture& texture) {
  return texture.width_px > 0 && texture.height_px > 0 &&
         texture.pixels.size() == mipmap_pixels({texture.width_px, texture.height_px});
}

std::string fault_of_textures(const PackedScene& packed) {
  std::set<std::pair<int, bool>> there;
  for (const PackedTexture& texture : packed.textures) {
    if (!is_whole(texture)) return "a texture is not whole";
    there.emplace(texture.image, texture.srgb);
  }
  for (const Material& material : packed.scene.materials)
    for (std::size_t role = 0; role < kTextureRoles; ++role) {
      const int image = material.textures[role].image;
      if (image != -1 && !there.contains({image, holds_colour(static_cast<TextureRole>(role))}))
        return "a material names a texture that is not there";
    }
  return "";
}

bool lies_within(const Mesh& mesh, const PackedScene& packed) {
  const std::size_t indices = packed.geometry.indices.size();
  return mesh.index_count % 3 == 0 && mesh.first_index <= indices &&
         mesh.index_count <= indices - mesh.first_index &&
         within(mesh.material, packed.scene.materials.size());
}

/// What they weigh is more than a question of looks: bounds count on a blend of whole weights.
bool are_sound(const Influences& influences, std::size_t joints) {
  int sum = 0;
  for (std::size_t i = 0; i < influences.joints.size(); ++i) {
    sum += influences.weights[i];
    if (influences.joints[i] >= joints) return false;
  }
  return sum == kFullWeight;
}

std::string fault_of_skin(const PackedScene& packed) {
  const auto& [scene, geometry] = std::tie(packed.scene, packed.geometry);
  const std::size_t joints = scene.joints.size();
  if (joints > kMaxJoints) return "there are more joints than fit";
  for (const Joint& joint : scene.joints)
    if (!within(joint.node, scene.nodes.size()) || !joint.joint_from_mesh.allFinite())
      return "a joint is no node, or nowhere";
  if (packed.joint_boxes.size() != scene.meshes.size()) return "its meshes are not all bounded";
  for (const std::vector<JointBox>& boxes : packed.joint_boxes)
    if (!std::ranges::all_of(boxes, [&](const JointBox& box) { return within(box.joint, joints); }))
      return "a mesh hangs on a joint that is not there";
  for (const Mesh& mesh : scene.meshes)
    for (std::uint32_t i = 0; mesh.skinned && i < mesh.index_count; ++i)
      if (geometry.influences.empty() ||
          !are_sound(geometry.influences[geometry.indices[mesh.first_index + i]], joints))
        return "a vertex follows no joint, or one that is not there";
  return "";
}

/// Each of the coarsenings is there, and coarser than what it was made of.
bool levels_in_order(const Mesh& mesh, const std::vector<Coarsening>& coarsenings) {
  for (const int index : {mesh.made_by, mesh.replaced_by})
    if (index != -1 && !within(index, coarsenings.size())) return false;
  return mesh.made_by == -1 || mesh.replaced_by == -1 ||
         coarsenings[mesh.made_by].error_in_node < coarsenings[mesh.replaced_by].error_in_node;
}

std::string fault_of_geometry(const PackedScene& packed) {
  const PackedGeometry& geometry = packed.geometry;
  const Box3f& bounds = packed.bounds_in_scene;
  if (!bounds.isEmpty() && !(bounds.min().allFinite() && bounds.max().allFinite()))
    return "it has no size";
  const std::size_t vertices = geometry.vertices.size();
  for (const std::size_t size : {geometry.uvs.size(), geometry.colours.size(),
                                 geometry.details.size(), geometry.influences.size()})
    if (size != 0 && size != vertices) return "some vertices are whole and others not";
  if (std::ranges::any_of(geometry.indices, [&](std::uint32_t index) { return index >= vertices; }))
    return "a triangle names a vertex that is not there";
  for (const Mesh& mesh : packed.scene.meshes) {
    if (!lies_within(mesh, packed))
      return "a mesh names triangles or a material that are not there";
    if (!levels_in_order(mesh, packed.scene.coarsenings))
      return "its levels of detail are out of order";
  }
  return "";
}

std::string fault_of_nodes(const SceneOutline& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.parent < -1 || node.parent >= static_cast<int>(i) || (i > 0 && node.parent < 0))
      return "a node comes before its parent";
    if (!std::ranges::all_of(node.meshes,
                             [&](int mesh) { return within(mesh, scene.meshes.size()); }))
      return "a node names a mesh that is not there";
  }
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels)
      if (!within(channel.node, scene.nodes.size())) return "an animation moves no node";
  return scene.nodes.empty() ? "there is no node" : "";
}

}  // namespace

PackedDirection pack_direction(const Eigen::Vector3f& direction) {
  const float size = direction.lpNorm<1>();
  if (!(size > 0)) return {};
  Eigen::Vector3f on_octahedron = direction / size;
  if (on_octahedron.z() < 0) {
    const Eigen::Vector2f sides = on_octahedron.head<2>();
    for (int axis = 0; axis < 2; ++axis)
      on_octahedron[axis] = std::copysign(1 - std::abs(sides[1 - axis]), sides[axis]);
  }
  return {in_16_bits(on_octahedron.x()), in_16_bits(on_octahedron.y())};
}

Eigen::Vector3f unpack_direction(PackedDirection packed) {
  const Eigen::Vector2f square = Eigen::Vector2f(packed.x, packed.y) / kOne;
  Eigen::Vector3f direction(square.x(), square.y(), 1 - square.lpNorm<1>());
  const float folded = std::max(-direction.z(), 0.0f);
  for (int axis = 0; axis < 2; ++axis) direction[axis] -= std::copysign(folded, square[axis]);
  return direction.normalized();
}

PackedScene pack(Scene scene) {
  PackedScene packed;
  packed.bounds_in_scene = bounds_in_scene(scene);
  for (const Mesh& mesh : scene.meshes)
    packed.joint_boxes.push_back(mesh.skinned ? joint_boxes(scene, mesh) : std::vector<JointBox>{});
  const auto lists = std::make_shared<Lists>();
  pack_vertices(scene, *lists);
  lists->influences = std::move(scene.influences);
  lists->indices = std::move(scene.indices);
  packed.textures = pack_textures(scene, *lists);
  packed.geometry = {lists->vertices, lists->uvs,        lists->colours,
                     lists->details,  lists->influences, lists->indices};
  packed.memory = lists;
  packed.scene = std::move(scene);
  return packed;
}

std::string fault_of(const PackedScene& packed) {
  for (const auto& fault : {fault_of_textures, fault_of_geometry, fault_of_skin})
    if (std::string found = fault(packed); !found.empty()) return found;
  return fault_of_nodes(packed.scene);
}

}  // namespace vindu
