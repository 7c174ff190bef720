// Assimp's materials as metallic-roughness ones. glTF's are taken as they are; older ones (diffuse,
// specular, shininess) are translated: not metallic, a roughness that gives a highlight of the same
// width, colours from sRGB to linear.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/import_geometry.h"
#include "renderer/import_textures.h"
#include "renderer/scene.h"

namespace vindu {

/// How a file writes its colours and materials.
enum class MaterialStyle {
  gltf,    ///< metallic-roughness, linear
  obj,     ///< diffuse and specular, sRGB; the diffuse colour tints the texture
  legacy,  ///< diffuse and specular, sRGB; a texture takes the diffuse colour's place
};

struct ImportedMaterial {
  int index = 0;                         ///< into take()'s result
  UvChannels uv_channels = {0, 0};       ///< the texture coordinates that its textures use
  std::optional<TextureUse> normal_map;  ///< vertices need tangents for it
};

/// Roughness whose GGX lobe is as wide as a Blinn-Phong lobe of this exponent: alpha^2 = 2 / (n +
/// 2), roughness = sqrt(alpha) (Karis, "Specular BRDF Reference", 2013; Walter et al. 2007).
float roughness_from_shininess(float exponent);

/// Takes over the materials that are asked for, each once.
class MaterialImporter {
 public:
  /// All references must outlive this.
  MaterialImporter(const aiScene& source, MaterialStyle style, TextureImporter& textures,
                   std::vector<std::string>& warnings)
      : source_(source), style_(style), textures_(textures), warnings_(warnings) {}

  /// `has_vertex_colours`: a material that an importer made up does not tint them. Of an index that
  /// is not there: a plain one.
  ImportedMaterial import(unsigned source_index, bool has_vertex_colours);

  std::vector<Material> take() { return std::move(materials_); }

 private:
  const aiScene& source_;
  MaterialStyle style_;
  TextureImporter& textures_;
  std::vector<std::string>& warnings_;
  std::map<std::pair<unsigned, bool>, ImportedMaterial> imported_;
  std::vector<Material> materials_;
};

}  // namespace vindu
