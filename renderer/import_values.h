// Single properties of Assimp's materials, where they are there and sound.
#pragma once

#include <assimp/material.h>

#include <Eigen/Core>
#include <optional>
#include <string>

#include "renderer/scene.h"

namespace vindu {

/// Keys, types and indices are those of Assimp's AI_MATKEY macros.
std::optional<float> number(const aiMaterial& material, const char* key, unsigned type,
                            unsigned index);
std::optional<Eigen::Vector4f> colour(const aiMaterial& material, const char* key, unsigned type,
                                      unsigned index);
/// Empty where it is not there.
std::string text(const aiMaterial& material, const char* key, unsigned type, unsigned index);
/// 0 where it is not there.
int whole(const aiMaterial& material, const char* key, unsigned type, unsigned index);

/// The first texture of this type, empty without.
std::string texture_name(const aiMaterial& material, aiTextureType type);
Wrap wrap_of(const aiMaterial& material, const char* key, unsigned type, unsigned index);
/// Of a glTF file; identity without.
UvTransform khr_texture_transform(const aiMaterial& material, aiTextureType type);

}  // namespace vindu
