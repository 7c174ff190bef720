// Files that the importer's tests write: a folder of their own that goes with them, and the
// smallest models whose every number is known.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vindu::test {

/// Removed with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Writes a file, its folders included; returns its path.
  std::string write(const std::string& name, std::string_view bytes) const;

 private:
  std::filesystem::path folder_;
};

std::string base64(const std::vector<std::uint8_t>& bytes);

/// A file of Debian's assimp-testmodels.
std::string test_model(const std::string& name);

/// The bytes of a 2 x 1 PNG: red, then green with alpha 128.
std::vector<std::uint8_t> two_pixel_png();

/// Parts of a glTF file that differ between tests; JSON.
struct GltfParts {
  std::string material = "{}";
  std::string more = {};        ///< members at top level, each with a comma before it
  std::string node_more = {};   ///< members of the node, each with a comma before it
  bool vertex_colours = false;  ///< (128, 64, 255) at every vertex
};

/// One node "quad" with the unit square in z = 0, normals +z; texture coordinates such that the
/// square's upper left, (0, 1, 0), has (0, 0).
std::string gltf_quad(const GltfParts& parts);

/// Node "quad" moves from x = 0 to x = 2 in 2 s and turns by 90 degrees about +y.
std::string gltf_moving_quad();

}  // namespace vindu::test
