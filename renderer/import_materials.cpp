#include "renderer/import_materials.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace vindu {
namespace {

/// What a surface of unknown material looks like: light grey, in sRGB.
constexpr float kPlainGrey = 0.8f;

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

float unit(float value) { return std::clamp(value, 0.0f, 1.0f); }

Eigen::Vector3f unit(const Eigen::Vector3f& colour) { return colour.cwiseMax(0).cwiseMin(1); }

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

/// One material on its way into the scene.
struct Conversion {
  const aiMaterial& source;
  MaterialStyle style;
  TextureImporter& textures;
  std::vector<std::string>& warnings;
  Material material;
  ImportedMaterial result;

  void warn(const std::string& what) {
    warnings.push_back("material " + material.name + ": " + what);
  }

  /// The first of these types that the material has and that can be decoded, if there is one.
  bool use_base_texture(std::initializer_list<aiTextureType> types) {
    for (const aiTextureType type : types) {
      const std::string name = texture_name(source, type);
      material.base_colour_texture = textures.index_of(name);
      if (material.base_colour_texture < 0) continue;
      result.uv_channel =
          static_cast<unsigned>(std::max(0, whole(source, AI_MATKEY_UVWSRC(type, 0))));
      if (style == MaterialStyle::gltf)
        result.texture_from_uv = khr_texture_transform(source, type);
      return true;
    }
    return false;
  }

  /// glTF 2.0, 3.9.2: roughness in green, metalness in blue; Assimp calls this texture "unknown".
  /// Only the means are used.
  void use_mean_roughness() {
    const std::optional<Rgba8> mean = textures.mean_of(texture_name(source, aiTextureType_UNKNOWN));
    if (!mean) return;
    material.roughness *= static_cast<float>((*mean)[1]) / 255;
    material.metallic *= static_cast<float>((*mean)[2]) / 255;
  }

  /// A picture that glows on black, as scans often come, is an unlit base colour; on anything else
  /// it is left out. Call it after the base colour is known.
  void use_emissive(const Eigen::Vector3f& emissive) {
    material.emissive = emissive;
    if (emissive.isZero() || texture_name(source, aiTextureType_EMISSIVE).empty()) return;
    material.emissive.setZero();
    if (!material.base_colour.head<3>().isZero(1e-3f))
      return warn("its emissive texture is not shown");
    if (!use_base_texture({aiTextureType_EMISSIVE})) return;
    material.base_colour.head<3>() = emissive;
    material.unlit = true;
  }
};

void convert_gltf_alpha(Conversion& conversion) {
  Material& material = conversion.material;
  const std::string mode = text(conversion.source, AI_MATKEY_GLTF_ALPHAMODE);
  if (mode == "MASK") material.alpha_mode = AlphaMode::mask;
  if (mode == "BLEND") material.alpha_mode = AlphaMode::blend;
  material.alpha_cutoff = number(conversion.source, AI_MATKEY_GLTF_ALPHACUTOFF).value_or(0.5f);
}

/// glTF 2.0, 3.9.2.
void convert_metallic_roughness(Conversion& conversion) {
  const aiMaterial& source = conversion.source;
  Material& material = conversion.material;
  material.base_colour = colour(source, AI_MATKEY_BASE_COLOR).value_or(Eigen::Vector4f::Ones());
  material.metallic = unit(number(source, AI_MATKEY_METALLIC_FACTOR).value_or(1));
  material.roughness = unit(number(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(1));
  conversion.use_base_texture({aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  conversion.use_mean_roughness();
}

/// KHR_materials_pbrSpecularGlossiness, of which diffuse and glossiness remain.
void convert_specular_glossiness(Conversion& conversion, float glossiness) {
  conversion.material.base_colour =
      colour(conversion.source, AI_MATKEY_COLOR_DIFFUSE).value_or(Eigen::Vector4f::Ones());
  conversion.material.roughness = 1 - unit(glossiness);
  conversion.use_base_texture({aiTextureType_DIFFUSE});
}

void convert_gltf(Conversion& conversion) {
  const aiMaterial& source = conversion.source;
  Material& material = conversion.material;
  material.double_sided = whole(source, AI_MATKEY_TWOSIDED) != 0;
  material.unlit = whole(source, AI_MATKEY_SHADING_MODEL) == aiShadingMode_Unlit;
  convert_gltf_alpha(conversion);
  const std::optional<float> glossiness = number(source, AI_MATKEY_GLOSSINESS_FACTOR);
  if (glossiness)
    convert_specular_glossiness(conversion, *glossiness);
  else
    convert_metallic_roughness(conversion);
  const auto emissive = colour(source, AI_MATKEY_COLOR_EMISSIVE);
  if (emissive) conversion.use_emissive(emissive->head<3>());
}

/// The colour that goes with a texture: only OBJ's file format says that both are multiplied, and
/// writers that leave it black there mean the texture alone.
Eigen::Vector3f legacy_tint(const Conversion& conversion, bool has_texture,
                            bool has_vertex_colours) {
  const bool made_up = conversion.material.name == AI_DEFAULT_MATERIAL_NAME;
  const auto diffuse = colour(conversion.source, AI_MATKEY_COLOR_DIFFUSE);
  if (has_texture &&
      (conversion.style != MaterialStyle::obj || !diffuse || diffuse->head<3>().isZero(1e-3f)))
    return Eigen::Vector3f::Ones();
  if (made_up && has_vertex_colours) return Eigen::Vector3f::Ones();
  if (made_up || !diffuse) return Eigen::Vector3f::Constant(kPlainGrey);
  return unit(Eigen::Vector3f(diffuse->head<3>()));
}

/// Writers disagree on whether 0 or 1 is opaque; a material that nobody could see is taken as
/// opaque.
void convert_legacy_alpha(Conversion& conversion) {
  const float opacity = unit(number(conversion.source, AI_MATKEY_OPACITY).value_or(1));
  if (opacity < 0.001f) return conversion.warn("opacity 0 is shown as opaque");
  if (opacity < 0.999f) {
    conversion.material.base_colour.w() = opacity;
    conversion.material.alpha_mode = AlphaMode::blend;
    return;
  }
  const std::string mask = texture_name(conversion.source, aiTextureType_OPACITY);
  const int flags = whole(conversion.source, AI_MATKEY_TEXFLAGS_DIFFUSE(0));
  const bool in_base_texture = mask == texture_name(conversion.source, aiTextureType_DIFFUSE);
  if ((!mask.empty() && in_base_texture) || (flags & aiTextureFlags_UseAlpha))
    conversion.material.alpha_mode = AlphaMode::mask;
  else if (!mask.empty())
    conversion.warn("its opacity texture is not shown");
}

float legacy_roughness(const aiMaterial& source) {
  const auto specular = colour(source, AI_MATKEY_COLOR_SPECULAR);
  const std::optional<float> exponent = number(source, AI_MATKEY_SHININESS);
  if (specular && specular->head<3>().isZero(1e-3f)) return 0.9f;
  return exponent && *exponent > 0 ? roughness_from_shininess(*exponent) : Material{}.roughness;
}

void convert_legacy(Conversion& conversion, bool has_vertex_colours) {
  const aiMaterial& source = conversion.source;
  Material& material = conversion.material;
  // Only glTF defines which side of a face is its front; in older files the winding is often mixed.
  material.double_sided = true;
  const bool has_texture =
      conversion.use_base_texture({aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR});
  material.base_colour.head<3>() = legacy_tint(conversion, has_texture, has_vertex_colours);
  convert_legacy_alpha(conversion);
  const auto emissive = colour(source, AI_MATKEY_COLOR_EMISSIVE);
  if (emissive) conversion.use_emissive(unit(Eigen::Vector3f(emissive->head<3>())));
  material.roughness = legacy_roughness(source);
  if (const std::optional<float> metallic = number(source, AI_MATKEY_METALLIC_FACTOR)) {
    material.metallic = unit(*metallic);
    material.roughness = unit(number(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(0.6f));
  }
}

}  // namespace

float roughness_from_shininess(float exponent) {
  const float alpha = std::sqrt(2 / (std::max(exponent, 0.0f) + 2));
  return std::clamp(std::sqrt(alpha), 0.15f, 1.0f);
}

ImportedMaterial MaterialImporter::import(unsigned source_index, bool has_vertex_colours) {
  const auto [entry, is_new] = imported_.try_emplace(std::pair(source_index, has_vertex_colours));
  if (!is_new) return entry->second;
  entry->second.index = static_cast<int>(materials_.size());
  if (source_index >= source_.mNumMaterials) {
    materials_.emplace_back().double_sided = true;
    return entry->second;
  }
  Conversion conversion{*source_.mMaterials[source_index], style_, textures_, warnings_, {}, {}};
  conversion.material.name = text(conversion.source, AI_MATKEY_NAME);
  if (style_ == MaterialStyle::gltf)
    convert_gltf(conversion);
  else
    convert_legacy(conversion, has_vertex_colours);
  materials_.push_back(std::move(conversion.material));
  conversion.result.index = entry->second.index;
  entry->second = conversion.result;
  return entry->second;
}

}  // namespace vindu
