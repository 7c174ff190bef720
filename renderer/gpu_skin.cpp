#include "renderer/gpu_skin.h"

#include <Eigen/LU>
#include <cstddef>

#include "renderer/gpu_textures.h"

namespace vindu {
namespace {

static_assert(kPaletteUnit > kShadowUnit);
static_assert(sizeof(Influences) == 16);

/// As shaders/scene.vert fetches them.
using Rows = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

}  // namespace

GpuSkin::GpuSkin(const PackedScene& packed, Upload& upload) : joints_(packed.scene.joints) {
  const auto influences = packed.geometry.influences;
  if (influences.empty()) return;
  influences_ = make_buffer(influences, upload);
  palette_ = gl::make_buffer(nullptr, joints_.size() * sizeof(Rows), GL_DYNAMIC_STORAGE_BIT);
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
  palette_texture_ = gl::Texture(name);
  glTextureBuffer(name, GL_RGBA32F, palette_.name());
}

void GpuSkin::add_attributes(GLuint vertex_array, GLuint binding) const {
  if (!influences_) return;
  constexpr GLuint joints = 6, weights = 7;
  glVertexArrayVertexBuffer(vertex_array, binding, influences_.name(), 0, sizeof(Influences));
  glVertexArrayAttribIFormat(vertex_array, joints, 4, GL_UNSIGNED_SHORT,
                             offsetof(Influences, joints));
  glVertexArrayAttribFormat(vertex_array, weights, 4, GL_UNSIGNED_SHORT, GL_TRUE,
                            offsetof(Influences, weights));
  for (const GLuint attribute : {joints, weights}) {
    glVertexArrayAttribBinding(vertex_array, attribute, binding);
    glEnableVertexArrayAttrib(vertex_array, attribute);
  }
}

void GpuSkin::pose(std::span<const Eigen::Matrix4f> world_from_nodes) {
  if (!palette_) return;
  world_from_meshes_ = joint_transforms(joints_, world_from_nodes);
  std::vector<Rows> rows;
  mirrored_.clear();
  for (const Eigen::Matrix4f& world_from_mesh : world_from_meshes_) {
    rows.emplace_back(world_from_mesh.topRows<3>());
    mirrored_.push_back(world_from_mesh.topLeftCorner<3, 3>().determinant() < 0);
  }
  glNamedBufferSubData(palette_.name(), 0, static_cast<GLsizeiptr>(rows.size() * sizeof(Rows)),
                       rows.data());
}

Box3f GpuSkin::bounds_in_world(std::span<const JointBox> boxes) const {
  Box3f bounds;
  for (const JointBox& box : boxes)
    bounds.extend(moved(box.box_in_mesh, world_from_meshes_[static_cast<std::size_t>(box.joint)]));
  return bounds;
}

void GpuSkin::bind() const {
  if (palette_texture_) glBindTextureUnit(kPaletteUnit, palette_texture_.name());
}

}  // namespace vindu
