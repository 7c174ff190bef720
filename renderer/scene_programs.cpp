#include "renderer/scene_programs.h"

#include <array>

namespace vindu {
namespace {

constexpr std::array<const char*, 10> kNames = {"BASE_COLOUR_TEXTURE",
                                                "METALLIC_ROUGHNESS_TEXTURE",
                                                "NORMAL_TEXTURE",
                                                "OCCLUSION_TEXTURE",
                                                "EMISSIVE_TEXTURE",
                                                "SECOND_UV",
                                                "UNLIT",
                                                "MASKED",
                                                "SHADOWED",
                                                "SKINNED"};

}  // namespace

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

std::string defines_of(SurfaceKind kind) {
  std::string defines;
  for (std::size_t bit = 0; bit < kNames.size(); ++bit)
    if (kind >> bit & 1u) defines += std::string("#define ") + kNames[bit] + "\n";
  return defines;
}

const gl::Program& ScenePrograms::of(SurfaceKind kind) const {
  const auto found = programs_.find(kind);
  if (found != programs_.end()) return found->second;
  std::string defines = defines_of(kind);
  if (look_.style == Style::unlit) defines += "#define MEASURE\n";
  if (look_.shadows == Shadows::soft) defines += "#define SOFT_SHADOWS\n";
  return programs_.emplace(kind, gl::Program("scene.vert", fragment_, defines)).first->second;
}

}  // namespace vindu
