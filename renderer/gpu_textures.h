// A scene's pictures on the GPU, each in the coding that its use asks for (colours are sRGB, all
// else is linear), and how they are sampled. Bound to the render thread.
#pragma once

#include <map>
#include <utility>

#include "renderer/canvas.h"
#include "renderer/packed_scene.h"
#include "renderer/upload.h"

namespace vindu {

/// Texture units of the scene's programs: one for each TextureRole, then the shadow map.
constexpr GLuint kShadowUnit = kTextureRoles;

class GpuTextures {
 public:
  /// What the scene's materials use; `upload` fills them.
  GpuTextures(const PackedScene& packed, const Look& look, Upload& upload);

  /// To the unit of its role.
  void bind(const TextureUse& use, TextureRole role) const;

 private:
  void add(const PackedTexture& packed, Upload& upload);
  void make_sampler(Wrap u, Wrap v);

  Look look_;
  std::map<std::pair<int, bool>, gl::Texture> textures_;  // by image, and whether it is sRGB
  std::map<std::pair<Wrap, Wrap>, gl::Sampler> samplers_;
};

/// Pictures are sampled by their own parameters again.
void unbind_samplers();

}  // namespace vindu
