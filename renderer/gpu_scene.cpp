#include "renderer/gpu_scene.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "core/error.h"
#include "renderer/gl/convert.h"

namespace vindu {
namespace {

/// Uniform blocks are bound by ranges, whose offsets must be multiples of at most 256 bytes
/// (OpenGL 4.5, table 23.70).
constexpr GLintptr kBlockBytes = 256;

/// As shaders/scene.vert and scene.frag declare them (std140).
struct GpuMaterial {
  glm::vec4 base_colour;
  glm::vec4 emissive_metallic;
  glm::vec4 roughness_cutoff_normal_occlusion;
  glm::vec4 texture_from_uv[2 * kTextureRoles];
};
struct GpuNode {
  glm::mat4 world_from_node;
  glm::mat4 normal_from_node;
  glm::vec4 handedness;
};
static_assert(sizeof(GpuMaterial) <= kBlockBytes && sizeof(GpuNode) <= kBlockBytes);

/// As light; for measuring, the file's numbers as they are.
Eigen::Vector3f light_of(const Eigen::Vector3f& colour, ColourCoding coding, Style style) {
  if (coding == ColourCoding::linear || style == Style::unlit) return colour;
  return colour.unaryExpr(&linear_from_srgb);
}

GpuMaterial gpu_material(const Material& material, ColourCoding coding, Style style) {
  const float cutoff = material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : -1.0f;
  const Eigen::Vector3f base = light_of(material.base_colour.head<3>(), coding, style);
  const Eigen::Vector3f emissive = light_of(material.emissive, coding, style);
  GpuMaterial block{
      {base.x(), base.y(), base.z(), material.base_colour.w()},
      {emissive.x(), emissive.y(), emissive.z(), material.metallic},
      {material.roughness, cutoff, material.normal_scale, material.occlusion_strength},
      {}};
  for (std::size_t role = 0; role < kTextureRoles; ++role) {
    const auto& [image, uv_set, rows, wrap_u, wrap_v] = material.textures[role];
    for (int row = 0; row < 2; ++row)
      block.texture_from_uv[2 * role + static_cast<std::size_t>(row)] = {
          rows(row, 0), rows(row, 1), rows(row, 2), static_cast<float>(uv_set)};
  }
  return block;
}

/// Of a colour, in 16 bits so that the dark ones keep their steps.
using Light = std::array<std::uint16_t, 4>;

std::vector<Light> light_of_srgb(std::span<const Rgba8> colours) {
  static const auto codes = [] {
    std::array<std::uint16_t, 256> lights{};
    for (std::size_t code = 0; code < lights.size(); ++code)
      lights[code] = static_cast<std::uint16_t>(
          std::lround(linear_from_srgb(static_cast<float>(code) / 255) * 65535));
    return lights;
  }();
  std::vector<Light> lights;
  lights.reserve(colours.size());
  for (const auto& [r, g, b, a] : colours)
    lights.push_back({codes[r], codes[g], codes[b], static_cast<std::uint16_t>(257 * a)});
  return lights;
}

/// How much longer a vector can become.
double largest_stretch(const Eigen::Matrix4f& matrix) {
  const Mat3 linear = matrix.topLeftCorner<3, 3>().cast<double>();
  return std::sqrt((linear.transpose() * linear).selfadjointView<Eigen::Lower>().operatorNorm());
}

/// Of shaders/scene.vert, whose buffers GpuSkin continues.
enum Attribute : GLuint { kPosition, kNormal, kUv, kColour, kTangent, kSecondUvs };
enum VertexBuffer : GLuint { kVertices, kUvs, kColours, kDetails, kInfluences };

/// How an attribute lies in its buffer. Integers other than floats are fractions of their largest.
struct Layout {
  GLint numbers = 0;
  GLenum type = GL_FLOAT;
  std::size_t offset = 0;
};

void add_attribute(GLuint array, VertexBuffer buffer, Attribute attribute, const Layout& layout) {
  glVertexArrayAttribFormat(array, attribute, layout.numbers, layout.type, GL_TRUE,
                            static_cast<GLuint>(layout.offset));
  glVertexArrayAttribBinding(array, attribute, buffer);
  glEnableVertexArrayAttrib(array, attribute);
}

/// Empty lists are no buffer.
template <class Value>
gl::Buffer add_buffer(GLuint array, VertexBuffer buffer, std::span<const Value> values,
                      Upload& upload) {
  gl::Buffer made = make_buffer(values, upload);
  if (made) glVertexArrayVertexBuffer(array, buffer, made.name(), 0, sizeof(Value));
  return made;
}

}  // namespace

void check_gpu_memory(const std::string& name) {
  if (glGetError() == GL_OUT_OF_MEMORY)
    throw Error({"is too large for this GPU's memory", name, "use a smaller model"});
}

GpuScene::GpuScene(const PackedScene& packed, const Look& look, Upload& upload)
    : triangle_count_(packed.scene.triangle_count()),
      skin_(packed, upload),
      textures_(packed, look, upload) {
  const SceneOutline& scene = packed.scene;
  skeleton_.nodes = scene.nodes;
  skeleton_.animations = scene.animations;
  list_draws(packed);
  add_geometry(packed.geometry, upload);
  if (scene.colours == ColourCoding::linear || look.style == Style::unlit)
    add_colours(packed.geometry.colours, upload);
  else
    add_lights(packed.geometry.colours, upload);
  add_materials(scene, look.style);
  nodes_ = gl::make_buffer(nullptr, scene.nodes.size() * kBlockBytes, GL_DYNAMIC_STORAGE_BIT);
  check_gpu_memory(scene.name);
  pose(Mat4::Identity(), 0);
}

GpuScene uploaded(const PackedScene& packed, const Look& look) {
  Upload upload;
  GpuScene scene(packed, look, upload);
  while (!upload.done()) upload.advance(std::numeric_limits<std::size_t>::max());
  check_gpu_memory(packed.scene.name);
  return scene;
}

void GpuScene::list_draws(const PackedScene& packed) {
  const SceneOutline& scene = packed.scene;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    std::map<int, int> posed;  // by their index in the scene
    const auto pose_of = [&](int coarsening) {
      if (coarsening < 0) return -1;
      const auto [at, is_new] =
          posed.try_emplace(coarsening, static_cast<int>(coarsenings_.size()));
      if (is_new)
        coarsenings_.push_back({static_cast<int>(node), scene.coarsenings[coarsening], {}});
      return at->second;
    };
    for (const int index : scene.nodes[node].meshes) {
      const Mesh& mesh = scene.meshes[index];
      const Material& material = scene.materials[mesh.material];
      draws_.push_back({static_cast<int>(node), mesh, material.alpha_mode, material.double_sided,
                        kind_of(material) | (mesh.skinned ? kSkinned : 0u), 0,
                        packed.joint_boxes[index], pose_of(mesh.made_by),
                        pose_of(mesh.replaced_by)});
    }
  }
  std::ranges::stable_sort(draws_, [](const Draw& a, const Draw& b) {
    return std::pair(a.alpha_mode, a.mesh.material) < std::pair(b.alpha_mode, b.mesh.material);
  });
  link_draws();
}

void GpuScene::link_draws() {
  std::map<std::tuple<int, int, bool>, int> groups;
  for (std::size_t i = 0; i < draws_.size(); ++i) {
    Draw& draw = draws_[i];
    const std::tuple group(draw.node, draw.mesh.material, draw.mesh.skinned);
    draw.group = groups.try_emplace(group, static_cast<int>(groups.size())).first->second;
    const int index = static_cast<int>(i);
    if (draw.mesh.skinned) skinned_.push_back(index);
    (draw.replaced_by < 0 ? coarsest_ : coarsenings_[draw.replaced_by].finer).push_back(index);
  }
  for (const int index : coarsest_) coarsest_triangles_ += draws_[index].mesh.index_count / 3;
  group_count_ = static_cast<int>(groups.size());
  boxes_.resize(draws_.size());
}

void GpuScene::add_geometry(const PackedGeometry& geometry, Upload& upload) {
  vertex_array_ = gl::make_vertex_array();
  const GLuint array = vertex_array_.name();
  vertices_ = add_buffer(array, kVertices, geometry.vertices, upload);
  indices_ = make_buffer(geometry.indices, upload);
  glVertexArrayElementBuffer(array, indices_.name());
  add_attribute(array, kVertices, kPosition,
                {3, GL_FLOAT, offsetof(PackedVertex, position_in_node)});
  add_attribute(array, kVertices, kNormal, {2, GL_SHORT, offsetof(PackedVertex, normal_in_node)});
  uvs_ = add_buffer(array, kUvs, geometry.uvs, upload);
  if (uvs_) add_attribute(array, kUvs, kUv, {2});
  details_ = add_buffer(array, kDetails, geometry.details, upload);
  if (details_) {
    add_attribute(array, kDetails, kTangent,
                  {3, GL_SHORT, offsetof(PackedDetail, tangent_in_node)});
    add_attribute(array, kDetails, kSecondUvs, {2, GL_FLOAT, offsetof(PackedDetail, uv_1)});
  }
  skin_.add_attributes(array, kInfluences);
}

void GpuScene::add_colours(std::span<const Rgba8> colours, Upload& upload) {
  colours_ = add_buffer(vertex_array_.name(), kColours, colours, upload);
  if (colours_) add_attribute(vertex_array_.name(), kColours, kColour, {4, GL_UNSIGNED_BYTE});
}

void GpuScene::add_lights(std::span<const Rgba8> colours, Upload& upload) {
  if (colours.empty()) return;
  const GLuint array = vertex_array_.name();
  colours_ = gl::make_buffer(nullptr, colours.size() * sizeof(Light), GL_DYNAMIC_STORAGE_BIT);
  glVertexArrayVertexBuffer(array, kColours, colours_.name(), 0, sizeof(Light));
  add_attribute(array, kColours, kColour, {4, GL_UNSIGNED_SHORT});
  upload.add({.items = colours.size(),
              .item_bytes = sizeof(Light),
              .move = [name = colours_.name(), colours](std::size_t first, std::size_t count) {
                const auto lights = light_of_srgb(colours.subspan(first, count));
                glNamedBufferSubData(name, static_cast<GLintptr>(first * sizeof(Light)),
                                     static_cast<GLsizeiptr>(count * sizeof(Light)), lights.data());
              }});
}

void GpuScene::add_materials(const SceneOutline& scene, Style style) {
  std::vector<std::byte> blocks(scene.materials.size() * kBlockBytes);
  for (std::size_t index = 0; index < scene.materials.size(); ++index) {
    const GpuMaterial material = gpu_material(scene.materials[index], scene.colours, style);
    std::memcpy(&blocks[index * kBlockBytes], &material, sizeof(material));
    texture_uses_.push_back(scene.materials[index].textures);
  }
  materials_ = gl::make_buffer(blocks.data(), blocks.size());
}

void GpuScene::pose(const Mat4& world_from_scene, double animation_time_s, int clip) {
  std::vector<Eigen::Matrix4f> world_from_nodes =
      node_transforms(skeleton_, animation_time_s, clip);
  facings_.resize(world_from_nodes.size());
  std::vector<std::byte> blocks(world_from_nodes.size() * kBlockBytes);
  for (std::size_t node = 0; node < world_from_nodes.size(); ++node) {
    const Mat4 world_from_node = world_from_scene * world_from_nodes[node].cast<double>();
    world_from_nodes[node] = world_from_node.cast<float>();
    const Mat3 linear = world_from_node.topLeftCorner<3, 3>();
    const double determinant = linear.determinant();
    facings_[node] = determinant < 0 ? Facing::mirrored : Facing::front;
    // Normals turn with the inverse transpose; a node flattened to nothing keeps any.
    Mat4 normal = Mat4::Identity();
    if (determinant != 0) normal.topLeftCorner<3, 3>() = linear.inverse().transpose();
    const float sign = determinant < 0 ? -1.0f : 1.0f;
    const GpuNode block{gl::mat4_from(world_from_node), gl::mat4_from(normal), glm::vec4(sign)};
    std::memcpy(&blocks[node * kBlockBytes], &block, sizeof(block));
  }
  if (world_from_nodes == world_from_nodes_) return;
  ++moves_;
  world_from_nodes_ = std::move(world_from_nodes);
  glNamedBufferSubData(nodes_.name(), 0, static_cast<GLsizeiptr>(blocks.size()), blocks.data());
  skin_.pose(world_from_nodes_);
  place_skinned();
  place_coarsenings();
}

void GpuScene::place_coarsenings() {
  int node = -1;
  double stretch = 0;
  for (PosedCoarsening& posed : coarsenings_) {
    const Eigen::Matrix4f& world_from_node = world_from_nodes_[posed.node];
    if (posed.node != node) stretch = largest_stretch(world_from_node);
    node = posed.node;
    posed.bounds_in_world = moved(posed.in_node.bounds_in_node, world_from_node);
    posed.error_m = posed.in_node.error_in_node * stretch;
  }
}

const Box3f& GpuScene::bounds_in_world(const Draw& draw) const {
  PosedBox& box = boxes_[static_cast<std::size_t>(&draw - draws_.data())];
  if (box.moves != moves_)
    box = {moves_, draw.mesh.skinned
                       ? skin_.bounds_in_world(draw.joints)
                       : moved(draw.mesh.bounds_in_node, world_from_nodes_[draw.node])};
  return box.in_world;
}

void GpuScene::place_skinned() {
  std::vector<std::optional<Facing>> facings(world_from_nodes_.size());
  for (const int index : skinned_) {
    const Draw& draw = draws_[index];
    std::optional<Facing>& facing = facings[static_cast<std::size_t>(draw.node)];
    for (const JointBox& box : draw.joints) {
      const Facing own = skin_.mirrored(box.joint) ? Facing::mirrored : Facing::front;
      facing = facing.value_or(own) == own ? own : Facing::mixed;
    }
  }
  skinned_facings_.clear();
  for (const auto& facing : facings) skinned_facings_.push_back(facing.value_or(Facing::front));
}

void GpuScene::bind() const {
  glBindVertexArray(vertex_array_.name());
  if (!colours_) glVertexAttrib4f(kColour, 1, 1, 1, 1);  // of all vertices
  skin_.bind();
}

void GpuScene::bind(const Draw& draw, SurfaceKind kind) const {
  glBindBufferRange(GL_UNIFORM_BUFFER, 0, nodes_.name(), draw.node * kBlockBytes, sizeof(GpuNode));
  glBindBufferRange(GL_UNIFORM_BUFFER, 1, materials_.name(), draw.mesh.material * kBlockBytes,
                    sizeof(GpuMaterial));
  const auto& uses = texture_uses_[static_cast<std::size_t>(draw.mesh.material)];
  for (std::size_t i = 0; i < kTextureRoles; ++i) {
    const auto role = static_cast<TextureRole>(i);
    if (kind & textured(role)) textures_.bind(uses[i], role);
  }
}

}  // namespace vindu
