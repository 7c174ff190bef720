#include "renderer/surface_kind.h"

namespace vindu {

SurfaceKind kind_of(const Material& material) {
  SurfaceKind kind =
      (material.unlit ? kUnlit : 0u) | (material.alpha_mode == AlphaMode::mask ? kMasked : 0u);
  for (std::size_t i = 0; i < kTextureRoles; ++i) {
    const TextureUse& use = material.textures[i];
    const auto role = static_cast<TextureRole>(i);
    if (use.image < 0 || (material.unlit && role != TextureRole::base_colour)) continue;
    kind |= textured(role) | (use.uv_set == 1 ? kSecondUv : 0u);
  }
  return kind;
}

}  // namespace vindu
