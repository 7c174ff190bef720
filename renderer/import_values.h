// Single values of Assimp's: properties of materials, where they are there and sound; matrices.
#pragma once

#include <assimp/material.h>
#include <assimp/matrix4x4.h>

#include <Eigen/Core>
#include <optional>
#include <string>

#include "renderer/scene.h"

namespace vindu {

/// Assimp's is row-major, its last row (0, 0, 0, 1).
Eigen::Matrix4f matrix_of(const aiMatrix4x4& m);

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
