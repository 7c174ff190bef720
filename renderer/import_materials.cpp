#include "renderer/import_materials.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/import_values.h"

namespace vindu {
namespace {

/// What a surface of unknown material looks like: light grey, in sRGB.
constexpr float kPlainGrey = 0.8f;

float unit(float value) { return std::clamp(value, 0.0f, 1.0f); }

Eigen::Vector3f unit(const Eigen::Vector3f& colour) { return colour.cwiseMax(0).cwiseMin(1); }

/// One material on its way into the scene.
struct Conversion {
  const aiMaterial& source;
  MaterialStyle style;
  TextureImporter& textures;
  std::vector<std::string>& warnings;
  Material material;
  std::vector<unsigned> uv_channels;  // in use; at most two

  void warn(const std::string& what) {
    warnings.push_back("material " + material.name + ": " + what);
  }

  std::string name_of(aiTextureType type) const { return texture_name(source, type); }

  /// Lays a picture on the surface as the file does with its texture of this type. False: there is
  /// no picture.
  bool use(TextureRole role, aiTextureType type, int image) {
    if (image < 0) return false;
    TextureUse& use = material.texture(role);
    use = {.image = image,
           .uv_set = uv_set_of(whole(source, AI_MATKEY_UVWSRC(type, 0))),
           .wrap_u = wrap_of(source, AI_MATKEY_MAPPINGMODE_U(type, 0)),
           .wrap_v = wrap_of(source, AI_MATKEY_MAPPINGMODE_V(type, 0))};
    if (style == MaterialStyle::gltf) use.texture_from_uv = khr_texture_transform(source, type);
    return true;
  }

  /// The first of these types that the material has and that can be decoded, if there is one.
  bool use(TextureRole role, std::initializer_list<aiTextureType> types) {
    return std::ranges::any_of(types, [&](aiTextureType type) {
      return use(role, type, textures.index_of(name_of(type)));
    });
  }

  int uv_set_of(int channel) {
    const auto wanted = static_cast<unsigned>(std::max(0, channel));
    const auto found = std::ranges::find(uv_channels, wanted);
    if (found != uv_channels.end()) return static_cast<int>(found - uv_channels.begin());
    if (uv_channels.size() == 2) {
      warn("of its texture coordinates only two are used");
      return 0;
    }
    uv_channels.push_back(wanted);
    return static_cast<int>(uv_channels.size()) - 1;
  }

  /// A picture that glows on black, as scans often come, is an unlit base colour: it needs no
  /// light. Call it after the base colour is known.
  void use_emissive(const Eigen::Vector3f& emissive) {
    const float intensity = number(source, AI_MATKEY_EMISSIVE_INTENSITY).value_or(1);
    material.emissive = std::max(intensity, 0.0f) * emissive;
    if (material.emissive.isZero() || name_of(aiTextureType_EMISSIVE).empty()) return;
    const bool scan = material.base_colour.head<3>().isZero(1e-3f);
    const TextureRole role = scan ? TextureRole::base_colour : TextureRole::emissive;
    const bool found = use(role, {aiTextureType_EMISSIVE});
    if (!found) material.emissive.setZero();  // the picture would have limited it
    if (!found || !scan) return;
    material.base_colour.head<3>() = material.emissive;
    material.emissive.setZero();
    material.unlit = true;
  }

  ImportedMaterial result(int index) const {
    ImportedMaterial imported{.index = index, .uv_channels = {0, 0}, .normal_map = {}};
    std::ranges::copy(uv_channels, imported.uv_channels.begin());
    const TextureUse& normal_map = material.texture(TextureRole::normal);
    if (normal_map.image >= 0 && !material.unlit) imported.normal_map = normal_map;
    return imported;
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
  conversion.use(TextureRole::base_colour, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  conversion.use(TextureRole::metallic_roughness, {aiTextureType_UNKNOWN});  // Assimp's name for it
}

/// KHR_materials_pbrSpecularGlossiness, of which diffuse and glossiness remain.
void convert_specular_glossiness(Conversion& conversion, float glossiness) {
  conversion.material.base_colour =
      colour(conversion.source, AI_MATKEY_COLOR_DIFFUSE).value_or(Eigen::Vector4f::Ones());
  conversion.material.roughness = 1 - unit(glossiness);
  conversion.use(TextureRole::base_colour, {aiTextureType_DIFFUSE});
}

/// glTF 2.0, 3.9.3.
void convert_gltf_details(Conversion& conversion) {
  const aiMaterial& source = conversion.source;
  Material& material = conversion.material;
  if (conversion.use(TextureRole::normal, {aiTextureType_NORMALS}))
    material.normal_scale =
        number(source, AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0)).value_or(1);
  if (conversion.use(TextureRole::occlusion, {aiTextureType_LIGHTMAP}))
    material.occlusion_strength = unit(
        number(source, AI_MATKEY_GLTF_TEXTURE_STRENGTH(aiTextureType_LIGHTMAP, 0)).value_or(1));
  const auto emissive = colour(source, AI_MATKEY_COLOR_EMISSIVE);
  if (emissive) conversion.use_emissive(emissive->head<3>());
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
  convert_gltf_details(conversion);
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
  const std::string mask = conversion.name_of(aiTextureType_OPACITY);
  const int flags = whole(conversion.source, AI_MATKEY_TEXFLAGS_DIFFUSE(0));
  const bool in_base_texture = mask == conversion.name_of(aiTextureType_DIFFUSE);
  if ((!mask.empty() && in_base_texture) || (flags & aiTextureFlags_UseAlpha)) {
    conversion.material.alpha_mode = AlphaMode::mask;
    return;
  }
  const int base = conversion.material.texture(TextureRole::base_colour).image;
  const int masked = conversion.textures.index_with_channel(base, 3, mask);
  if (masked == base) return;  // there is none
  if (base < 0)
    conversion.use(TextureRole::base_colour, aiTextureType_OPACITY, masked);
  else
    conversion.material.texture(TextureRole::base_colour).image = masked;
  conversion.material.alpha_mode = AlphaMode::mask;
}

float legacy_roughness(const aiMaterial& source) {
  const auto specular = colour(source, AI_MATKEY_COLOR_SPECULAR);
  const std::optional<float> exponent = number(source, AI_MATKEY_SHININESS);
  if (specular && specular->head<3>().isZero(1e-3f)) return 0.9f;
  return exponent && *exponent > 0 ? roughness_from_shininess(*exponent) : Material{}.roughness;
}

/// Formats before glTF have a picture for each of roughness, metalness and occlusion, if at all.
void convert_legacy_pictures(Conversion& conversion) {
  const aiMaterial& source = conversion.source;
  Material& material = conversion.material;
  for (const aiTextureType type :
       {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT})
    if (conversion.use(TextureRole::normal, type,
                       conversion.textures.index_of_normal_map(conversion.name_of(type))))
      break;
  conversion.use(TextureRole::occlusion, {aiTextureType_AMBIENT_OCCLUSION});
  const std::string roughness = conversion.name_of(aiTextureType_DIFFUSE_ROUGHNESS),
                    metalness = conversion.name_of(aiTextureType_METALNESS);
  const int rough = conversion.textures.index_with_channel(-1, 1, roughness);
  const int both = conversion.textures.index_with_channel(rough, 2, metalness);
  if (rough >= 0) material.roughness = 1;
  if (both != rough) material.metallic = 1;
  conversion.use(TextureRole::metallic_roughness,
                 rough >= 0 ? aiTextureType_DIFFUSE_ROUGHNESS : aiTextureType_METALNESS, both);
  const auto emissive = colour(source, AI_MATKEY_COLOR_EMISSIVE);
  const bool glows = emissive && !emissive->head<3>().isZero();
  if (glows)
    conversion.use_emissive(unit(Eigen::Vector3f(emissive->head<3>())));
  else if (!conversion.name_of(aiTextureType_EMISSIVE).empty())
    conversion.use_emissive(Eigen::Vector3f::Ones());
}

void convert_legacy(Conversion& conversion, bool has_vertex_colours) {
  const aiMaterial& source = conversion.source;
  Material& material = conversion.material;
  // Only glTF defines which side of a face is its front; in older files the winding is often mixed.
  material.double_sided = true;
  const bool has_texture =
      conversion.use(TextureRole::base_colour, {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR});
  material.base_colour.head<3>() = legacy_tint(conversion, has_texture, has_vertex_colours);
  convert_legacy_alpha(conversion);
  material.roughness = legacy_roughness(source);
  if (const std::optional<float> metallic = number(source, AI_MATKEY_METALLIC_FACTOR)) {
    material.metallic = unit(*metallic);
    material.roughness = unit(number(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(0.6f));
  }
  convert_legacy_pictures(conversion);
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
  entry->second = conversion.result(entry->second.index);
  materials_.push_back(std::move(conversion.material));
  return entry->second;
}

}  // namespace vindu
