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
