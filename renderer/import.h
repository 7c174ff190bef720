// Any model file that Assimp reads, as a Scene. Geometry, node transforms, bones, animation,
// materials and their textures (embedded or beside the file); missing normals and tangents are
// computed. A file that cannot become a picture is an Error that says why and what to do; the
// caller keeps the scene it had.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// What a file may cost at most; more is refused before memory runs out.
struct ImportLimits {
  std::uintmax_t file_bytes = std::uintmax_t{2} << 30;
  std::size_t triangles = 100'000'000;
  std::size_t texture_pixels = std::size_t{1} << 28;  ///< of all textures together
};

struct ImportResult {
  Scene scene;
  std::vector<std::string>
      warnings;  ///< what was lost: a texture that is not there, lines and points, ...
  std::vector<std::string> files;  ///< that were read: the model first, then those beside it
};

/// Throws Error: missing, a folder, empty, too large, broken, not a model, without triangles, or in
/// a format that Assimp does not read (.osg, .ive: names osgconv).
ImportResult import_scene(const std::string& file, const ImportLimits& limits = {});

}  // namespace vindu
