#include "renderer/import_values.h"

#include <algorithm>
#include <cmath>

namespace vindu {

Eigen::Matrix4f matrix_of(const aiMatrix4x4& m) {
  Eigen::Matrix4f matrix;
  matrix << m.a1, m.a2, m.a3, m.a4,  //
      m.b1, m.b2, m.b3, m.b4,        //
      m.c1, m.c2, m.c3, m.c4,        //
      0, 0, 0, 1;
  return matrix;
}

std::optional<float> number(const aiMaterial& material, const char* key, unsigned type,
                            unsigned index) {
  float value = 0;
  if (material.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<Eigen::Vector4f> colour(const aiMaterial& material, const char* key, unsigned type,
                                      unsigned index) {
  aiColor4D value;
  if (material.Get(key, type, index, value) != aiReturn_SUCCESS) return std::nullopt;
  const Eigen::Vector4f rgba(value.r, value.g, value.b, value.a);
  return rgba.allFinite() ? std::optional<Eigen::Vector4f>(rgba.cwiseMax(0)) : std::nullopt;
}

std::string text(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  aiString value;
  return material.Get(key, type, index, value) == aiReturn_SUCCESS ? value.C_Str() : "";
}

int whole(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  int value = 0;
  return material.Get(key, type, index, value) == aiReturn_SUCCESS ? value : 0;
}

std::string texture_name(const aiMaterial& material, aiTextureType type) {
  return text(material, AI_MATKEY_TEXTURE(type, 0));
}

Wrap wrap_of(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  switch (whole(material, key, type, index)) {
    case aiTextureMapMode_Mirror:
      return Wrap::mirror;
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal:
      return Wrap::clamp;
    default:
      return Wrap::repeat;
  }
}

/// KHR_texture_transform: offset + rotation * scale * uv, with the rotation matrix [c s; -s c].
/// Assimp 5.2's loader rewrites it for a rotation about the texture's centre, which its own
/// application of it then gets wrong; this undoes the rewriting (glTF2Importer.cpp,
/// SetMaterialTextureProperty).
UvTransform khr_texture_transform(const aiMaterial& material, aiTextureType type) {
  aiUVTransform stored;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), stored) != aiReturn_SUCCESS)
    return UvTransform::Identity();
  const Eigen::Vector2f scale(stored.mScaling.x, stored.mScaling.y);
  const float c = std::cos(-stored.mRotation);
  const float s = std::sin(-stored.mRotation);
  UvTransform texture_from_uv;
  texture_from_uv << c * scale.x(), s * scale.y(),
      stored.mTranslation.x - 0.5f * scale.x() * (1 - c + s),  //
      -s * scale.x(), c * scale.y(),
      1 - scale.y() + 0.5f * scale.y() * (s + c - 1) - stored.mTranslation.y;
  return texture_from_uv.allFinite() ? texture_from_uv : UvTransform::Identity();
}

}  // namespace vindu
