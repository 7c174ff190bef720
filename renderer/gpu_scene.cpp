#include "renderer/gpu_scene.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/glm.hpp>

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
  glm::vec4 roughness_cutoff;
};
struct GpuNode {
  glm::mat4 world_from_node;
  glm::mat4 normal_from_node;
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
  return {{base.x(), base.y(), base.z(), material.base_colour.w()},
          {emissive.x(), emissive.y(), emissive.z(), material.metallic},
          {material.roughness, cutoff, 0, 0}};
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

/// The box around a moved box: its middle moves, its half size by the absolute matrix (J. Arvo,
/// Graphics Gems, 1990).
Box3f moved(const Box3f& box, const Eigen::Matrix4f& matrix) {
  const Eigen::Vector3f middle = (matrix * box.center().homogeneous()).head<3>();
  const Eigen::Vector3f half = 0.5f * matrix.topLeftCorner<3, 3>().cwiseAbs() * box.sizes();
  return {middle - half, middle + half};
}

gl::Texture upload_texture(const Image& image, Style style) {
  gl::Texture texture = gl::make_texture_2d();
  const auto longest = static_cast<unsigned>(std::max(image.width_px, image.height_px));
  glTextureStorage2D(texture.name(), std::bit_width(longest),
                     style == Style::lit ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width_px,
                     image.height_px);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width_px, image.height_px, GL_RGBA,
                      GL_UNSIGNED_BYTE, image.pixels.data());
  glGenerateTextureMipmap(texture.name());
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  // For measuring nothing may blur: llvmpipe's anisotropic filter mixes neighbours at any level.
  if (style == Style::lit) glTextureParameterf(texture.name(), GL_TEXTURE_MAX_ANISOTROPY, 8.0f);
  return texture;
}

void check_memory(const std::string& name) {
  if (glGetError() == GL_OUT_OF_MEMORY)
    throw Error({"is too large for this GPU's memory", name, "use a smaller model"});
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, Style style) : triangle_count_(scene.triangle_count()) {
  skeleton_.nodes = scene.nodes;
  skeleton_.animations = scene.animations;
  list_draws(scene);
  upload_geometry(scene, style);
  upload_materials(scene, style);
  upload_textures(scene, style);
  nodes_ = gl::make_buffer(nullptr, scene.nodes.size() * kBlockBytes, GL_DYNAMIC_STORAGE_BIT);
  check_memory(scene.name);
  pose(Mat4::Identity(), 0);
}

void GpuScene::list_draws(const Scene& scene) {
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    for (const int index : scene.nodes[node].meshes) {
      const Mesh& mesh = scene.meshes[index];
      const Material& material = scene.materials[mesh.material];
      draws_.push_back({static_cast<int>(node), mesh, material.alpha_mode, material.double_sided,
                        material.base_colour_texture, material.unlit});
    }
  std::ranges::stable_sort(draws_, [](const Draw& a, const Draw& b) {
    return std::pair(a.alpha_mode, a.texture) < std::pair(b.alpha_mode, b.texture);
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
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, position_in_node));
  glVertexArrayAttribFormat(array, 1, 3, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, normal_in_node));
  glVertexArrayAttribFormat(array, 2, 2, GL_FLOAT, GL_FALSE, offsetof(GpuVertex, uv));
  glVertexArrayAttribFormat(array, 3, 4, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(GpuVertex, colour));
  for (GLuint attribute = 0; attribute < 4; ++attribute) {
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribBinding(array, attribute, 0);
  }
}

void GpuScene::upload_materials(const Scene& scene, Style style) {
  std::vector<std::byte> blocks(scene.materials.size() * kBlockBytes);
  for (std::size_t index = 0; index < scene.materials.size(); ++index) {
    const GpuMaterial material = gpu_material(scene.materials[index], scene.colours, style);
    std::memcpy(&blocks[index * kBlockBytes], &material, sizeof(material));
  }
  materials_ = gl::make_buffer(blocks.data(), blocks.size());
}

void GpuScene::upload_textures(const Scene& scene, Style style) {
  white_ = upload_texture(Image::filled(1, 1, {255, 255, 255, 255}), style);
  for (const Image& image : scene.textures) textures_.push_back(upload_texture(image, style));
}

void GpuScene::pose(const Mat4& world_from_scene, double animation_time_s) {
  std::vector<Eigen::Matrix4f> world_from_nodes = node_transforms(skeleton_, animation_time_s);
  mirrored_.resize(world_from_nodes.size());
  std::vector<std::byte> blocks(world_from_nodes.size() * kBlockBytes);
  for (std::size_t node = 0; node < world_from_nodes.size(); ++node) {
    const Mat4 world_from_node = world_from_scene * world_from_nodes[node].cast<double>();
    world_from_nodes[node] = world_from_node.cast<float>();
    const Mat3 linear = world_from_node.topLeftCorner<3, 3>();
    const double determinant = linear.determinant();
    mirrored_[node] = determinant < 0;
    // Normals turn with the inverse transpose; a node flattened to nothing keeps any.
    Mat4 normal = Mat4::Identity();
    if (determinant != 0) normal.topLeftCorner<3, 3>() = linear.inverse().transpose();
    const GpuNode block{gl::mat4_from(world_from_node), gl::mat4_from(normal)};
    std::memcpy(&blocks[node * kBlockBytes], &block, sizeof(block));
  }
  glNamedBufferSubData(nodes_.name(), 0, static_cast<GLsizeiptr>(blocks.size()), blocks.data());
  bounds_in_world_.clear();
  for (const Draw& draw : draws_)
    bounds_in_world_.push_back(moved(draw.mesh.bounds_in_node, world_from_nodes[draw.node]));
}

void GpuScene::bind() const { glBindVertexArray(vertex_array_.name()); }

void GpuScene::bind(const Draw& draw) const {
  glBindBufferRange(GL_UNIFORM_BUFFER, 0, nodes_.name(), draw.node * kBlockBytes, sizeof(GpuNode));
  glBindBufferRange(GL_UNIFORM_BUFFER, 1, materials_.name(), draw.mesh.material * kBlockBytes,
                    sizeof(GpuMaterial));
  glBindTextureUnit(0, draw.texture < 0 ? white_.name() : textures_[draw.texture].name());
}

}  // namespace vindu
