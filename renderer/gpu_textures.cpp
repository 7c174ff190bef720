#include "renderer/gpu_textures.h"

#include <algorithm>
#include <bit>

namespace vindu {
namespace {

bool holds_colour(TextureRole role) {
  return role == TextureRole::base_colour || role == TextureRole::emissive;
}

GLint gl_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return GL_REPEAT;
    case Wrap::mirror:
      return GL_MIRRORED_REPEAT;
    case Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
  }
  return GL_REPEAT;
}

}  // namespace

GpuTextures::GpuTextures(const Scene& scene, const Look& look) : look_(look) {
  for (const Material& material : scene.materials)
    for (std::size_t i = 0; i < kTextureRoles; ++i) {
      const auto role = static_cast<TextureRole>(i);
      const TextureUse& use = material.textures[i];
      if (use.image < 0 || (look.style == Style::unlit && role != TextureRole::base_colour))
        continue;
      upload(scene.textures[static_cast<std::size_t>(use.image)], use.image, holds_colour(role));
      make_sampler(use.wrap_u, use.wrap_v);
    }
}

void GpuTextures::upload(const Image& image, int index, bool srgb) {
  const auto [entry, is_new] = textures_.try_emplace({index, srgb});
  if (!is_new) return;
  gl::Texture texture = gl::make_texture_2d();
  const auto longest = static_cast<unsigned>(std::max(image.width_px, image.height_px));
  glTextureStorage2D(texture.name(), std::bit_width(longest),
                     srgb && look_.style == Style::lit ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width_px,
                     image.height_px);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width_px, image.height_px, GL_RGBA,
                      GL_UNSIGNED_BYTE, image.pixels.data());
  glGenerateTextureMipmap(texture.name());
  entry->second = std::move(texture);
}

void GpuTextures::make_sampler(Wrap u, Wrap v) {
  const auto [entry, is_new] = samplers_.try_emplace({u, v});
  if (!is_new) return;
  entry->second = gl::make_sampler();
  const GLuint sampler = entry->second.name();
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, gl_wrap(u));
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, gl_wrap(v));
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  // For measuring nothing may blur: llvmpipe's anisotropic filter mixes neighbours at any level.
  if (look_.style == Style::lit)
    glSamplerParameterf(sampler, GL_TEXTURE_MAX_ANISOTROPY, look_.anisotropy);
}

void GpuTextures::bind(const TextureUse& use, TextureRole role) const {
  const auto unit = static_cast<GLuint>(role);
  glBindTextureUnit(unit, textures_.at({use.image, holds_colour(role)}).name());
  glBindSampler(unit, samplers_.at({use.wrap_u, use.wrap_v}).name());
}

void unbind_samplers() { glBindSamplers(0, kTextureRoles, nullptr); }

}  // namespace vindu
