// The skin of a scene on the GPU: which joints move which vertex, and where the joints stand this
// frame. One palette serves all skinned meshes. Bound to the render thread.
#pragma once

#include <span>
#include <vector>

#include "renderer/gl/handle.h"
#include "renderer/packed_scene.h"
#include "renderer/upload.h"

namespace vindu {

/// Behind the materials' textures and the shadow map.
constexpr GLuint kPaletteUnit = 6;

class GpuSkin {
 public:
  /// Keeps the scene's joints. Without any this costs nothing.
  GpuSkin(const PackedScene& packed, Upload& upload);

  /// To a vertex array: `binding` is a free one of its buffers.
  void add_attributes(GLuint vertex_array, GLuint binding) const;

  void pose(std::span<const Eigen::Matrix4f> world_from_nodes);

  /// Around what these joints move, as they are posed.
  Box3f bounds_in_world(std::span<const JointBox> boxes) const;
  /// The joint turns what it moves inside out.
  bool mirrored(int joint) const { return mirrored_[static_cast<std::size_t>(joint)]; }

  /// Before skinned draws.
  void bind() const;

 private:
  std::vector<Joint> joints_;
  std::vector<Eigen::Matrix4f> world_from_meshes_;
  std::vector<bool> mirrored_;
  gl::Buffer influences_;
  gl::Buffer palette_;  // three rows of each joint's matrix
  gl::Texture palette_texture_;
};

}  // namespace vindu
