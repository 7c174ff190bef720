#include "renderer/gpu_scene.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/glm.hpp>
#include <map>
#include <optional>

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

/// As it is uploaded: colours are light, in 16 bits so that the dark ones keep their steps.
struct GpuVertex {
  Eigen::Vector3f position_in_node;
  Eigen::Vector3f normal_in_node;
  Eigen::Vector2f uv;
  std::array<std::uint16_t, 4> colour;
};
static_assert(sizeof(GpuVertex) == 40);

/// The 16-bit light of each 8-bit code.
std::array<std::uint16_t, 256> light_codes(ColourCoding coding, Style style) {
  std::array<std::uint16_t, 256> codes{};
  for (int code = 0; code < 256; ++code) {
    const Eigen::Vector3f colour = Eigen::Vector3f::Constant(static_cast<float>(code) / 255);
    codes[code] =
        static_cast<std::uint16_t>(std::lround(light_of(colour, coding, style).x() * 65535));
  }
  return codes;
}

std::vector<GpuVertex> gpu_vertices(const Scene& scene, Style style) {
  const std::array<std::uint16_t, 256> codes = light_codes(scene.colours, style);
  std::vector<GpuVertex> vertices;
  vertices.reserve(scene.vertices.size());
  for (const Vertex& vertex : scene.vertices) {
    const auto [r, g, b, a] = vertex.colour;
    const auto alpha = static_cast<std::uint16_t>(257 * a);
    vertices.push_back({vertex.position_in_node,
                        vertex.normal_in_node,
                        vertex.uv,
                        {codes[r], codes[g], codes[b], alpha}});
  }
  return vertices;
}

/// How much longer a vector can become.
double largest_stretch(const Eigen::Matrix4f& matrix) {
  const Mat3 linear = matrix.topLeftCorner<3, 3>().cast<double>();
  return std::sqrt((linear.transpose() * linear).selfadjointView<Eigen::Lower>().operatorNorm());
}

/// What few vertices need.
struct GpuDetail {
  Eigen::Vector3f tangent_in_node;
  float bitangent_sign;
  Eigen::Vector2f uv_1;
};
static_assert(sizeof(GpuDetail) == 24);

void add_attribute(GLuint array, GLuint buffer, GLuint attribute, GLint floats,
                   std::size_t offset) {
  glVertexArrayAttribFormat(array, attribute, floats, GL_FLOAT, GL_FALSE,
                            static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(array, attribute, buffer);
  glEnableVertexArrayAttrib(array, attribute);
}

void check_memory(const std::string& name) {
  if (glGetError() == GL_OUT_OF_MEMORY)
    throw Error({"is too large for this GPU's memory", name, "use a smaller model"});
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, const Look& look)
    : triangle_count_(scene.triangle_count()), skin_(scene), textures_(scene, look) {
  skeleton_.nodes = scene.nodes;
  skeleton_.animations = scene.animations;
  list_draws(scene);
  upload_geometry(scene, look.style);
  upload_details(scene);
  upload_materials(scene, look.style);
  nodes_ = gl::make_buffer(nullptr, scene.nodes.size() * kBlockBytes, GL_DYNAMIC_STORAGE_BIT);
  check_memory(scene.name);
  pose(Mat4::Identity(), 0);
}

void GpuScene::list_draws(const Scene& scene) {
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    std::map<int, int> posed;  // by their index in the scene
    const auto pose_of = [&](int coarsening) {
      if (coarsening < 0) return -1;
      const auto [at, is_new] =
          posed.try_emplace(coarsening, static_cast<int>(coarsenings_.size()));
      if (is_new)
        coarsenings_.push_back({static_cast<int>(node), scene.coarsenings[coarsening], {}, 0});
      return at->second;
    };
    for (const int index : scene.nodes[node].meshes) {
      const Mesh& mesh = scene.meshes[index];
      const Material& material = scene.materials[mesh.material];
      draws_.push_back({static_cast<int>(node), mesh, material.alpha_mode, material.double_sided,
                        kind_of(material) | (mesh.skinned ? kSkinned : 0u),
                        mesh.skinned ? joint_boxes(scene, mesh) : std::vector<JointBox>{},
                        pose_of(mesh.made_by), pose_of(mesh.replaced_by)});
    }
  }
  std::ranges::stable_sort(draws_, [](const Draw& a, const Draw& b) {
    return std::pair(a.alpha_mode, a.mesh.material) < std::pair(b.alpha_mode, b.mesh.material);
  });
}

void GpuScene::upload_geometry(const Scene& scene, Style style) {
  const std::vector<GpuVertex> vertices = gpu_vertices(scene, style);
  vertices_ = gl::make_buffer(vertices.data(), vertices.size() * sizeof(GpuVertex));
  indices_ = gl::make_buffer(scene.indices.data(), scene.indices.size() * sizeof(std::uint32_t));
  vertex_array_ = gl::make_vertex_array();
  const GLuint array = vertex_array_.name();
  glVertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(GpuVertex));
  glVertexArrayElementBuffer(array, indices_.name());
  add_attribute(array, 0, 0, 3, offsetof(GpuVertex, position_in_node));
  add_attribute(array, 0, 1, 3, offsetof(GpuVertex, normal_in_node));
  add_attribute(array, 0, 2, 2, offsetof(GpuVertex, uv));
  glVertexArrayAttribFormat(array, 3, 4, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(GpuVertex, colour));
  glVertexArrayAttribBinding(array, 3, 0);
  glEnableVertexArrayAttrib(array, 3);
  skin_.add_attributes(array, 2);
}

void GpuScene::upload_details(const Scene& scene) {
  constexpr SurfaceKind detailed = kSecondUv | textured(TextureRole::normal);
  if (std::ranges::none_of(draws_, [](const Draw& draw) { return draw.kind & detailed; })) return;
  std::vector<GpuDetail> details;
  details.reserve(scene.vertices.size());
  for (const Vertex& vertex : scene.vertices)
    details.push_back({vertex.tangent_in_node, vertex.bitangent_sign, vertex.uv_1});
  details_ = gl::make_buffer(details.data(), details.size() * sizeof(GpuDetail));
  const GLuint array = vertex_array_.name();
  glVertexArrayVertexBuffer(array, 1, details_.name(), 0, sizeof(GpuDetail));
  add_attribute(array, 1, 4, 4, offsetof(GpuDetail, tangent_in_node));
  add_attribute(array, 1, 5, 2, offsetof(GpuDetail, uv_1));
}

void GpuScene::upload_materials(const Scene& scene, Style style) {
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
  place_draws();
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

void GpuScene::place_draws() {
  bounds_in_world_.clear();
  std::vector<std::optional<Facing>> facings(world_from_nodes_.size());
  for (const Draw& draw : draws_) {
    if (!draw.mesh.skinned) {
      bounds_in_world_.push_back(moved(draw.mesh.bounds_in_node, world_from_nodes_[draw.node]));
      continue;
    }
    bounds_in_world_.push_back(skin_.bounds_in_world(draw.joints));
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
