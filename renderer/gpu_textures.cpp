#include "renderer/gpu_textures.h"

#include <algorithm>
#include <bit>

#include "renderer/mipmaps.h"

namespace vindu {
namespace {

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

GpuTextures::GpuTextures(const PackedScene& packed, const Look& look, Upload& upload)
    : look_(look) {
  for (const Material& material : packed.scene.materials)
    for (std::size_t i = 0; i < kTextureRoles; ++i) {
      const auto role = static_cast<TextureRole>(i);
      const TextureUse& use = material.textures[i];
      if (use.image < 0 || (look.style == Style::unlit && role != TextureRole::base_colour))
        continue;
      textures_.try_emplace({use.image, holds_colour(role)});
      make_sampler(use.wrap_u, use.wrap_v);
    }
  for (const PackedTexture& texture : packed.textures)
    if (textures_.contains({texture.image, texture.srgb})) add(texture, upload);
}

void GpuTextures::add(const PackedTexture& packed, Upload& upload) {
  gl::Texture& texture = textures_.at({packed.image, packed.srgb}) = gl::make_texture_2d();
  SizePx size = {packed.width_px, packed.height_px};
  const int levels = std::bit_width(static_cast<unsigned>(std::max(size.width, size.height)));
  const bool decoded = packed.srgb && look_.style == Style::lit;
  glTextureStorage2D(texture.name(), levels, decoded ? GL_SRGB8_ALPHA8 : GL_RGBA8, size.width,
                     size.height);
  const Rgba8* pixels = packed.pixels.data();
  for (int level = 0; level < levels; ++level, size = half_of(size)) {
    const auto width = static_cast<std::size_t>(size.width),
               height = static_cast<std::size_t>(size.height);
    upload.add({.items = height,
                .item_bytes = width * sizeof(Rgba8),
                .move = [name = texture.name(), level, pixels, width](std::size_t first,
                                                                      std::size_t count) {
                  glTextureSubImage2D(name, level, 0, static_cast<GLint>(first),
                                      static_cast<GLsizei>(width), static_cast<GLsizei>(count),
                                      GL_RGBA, GL_UNSIGNED_BYTE, pixels + first * width);
                }});
    pixels += width * height;
  }
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
