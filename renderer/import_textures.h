// The pictures that a model's materials name: embedded in the model, or files beside it. Names in
// models are seldom right on this machine (another case, backslashes, absolute paths of the
// author's disk), so a file is searched for where people put textures.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/image.h"

namespace vindu {

/// The file that a model in `folder` means by `name`; empty when nothing fits.
std::optional<std::filesystem::path> find_texture_file(const std::filesystem::path& folder,
                                                       const std::string& name);

/// Decodes each picture once. What cannot be had is a warning, never an error: the model is shown
/// without it.
class TextureImporter {
 public:
  /// `source` and `warnings` must outlive this. `max_pixels`: of all textures together.
  TextureImporter(const aiScene& source, std::filesystem::path folder, std::size_t max_pixels,
                  std::vector<std::string>& warnings);

  /// Index of the picture in take()'s result, or -1.
  int index_of(const std::string& name);

  /// The same for a picture that says how a surface's normals turn: one of heights, which is grey,
  /// becomes one of normals.
  int index_of_normal_map(const std::string& name);

  /// A copy of picture `base` (white without one, -1) whose `channel` (0 to 3) is the named
  /// picture: its alpha if it has holes, else its red. `base` where there is no such picture.
  int index_with_channel(int base, std::size_t channel, const std::string& name);

  std::vector<Image> take() { return std::move(textures_); }
  /// That were read, whether they were pictures or not.
  const std::vector<std::string>& files() const { return files_; }

 private:
  int keep(const std::string& key, Image image);
  std::optional<Image> load(const std::string& name);
  std::optional<Image> from_embedded(const aiTexture& texture, const std::string& name);
  std::optional<Image> from_file(const std::string& name);
  std::optional<Image> decoded(std::span<const std::uint8_t> bytes, const std::string& name);

  const aiScene& source_;
  std::filesystem::path folder_;
  std::size_t pixels_left_;
  std::vector<std::string>& warnings_;
  std::map<std::string, int> index_of_name_;  // of derived pictures with what was done to them
  std::vector<Image> textures_;
  std::vector<std::string> files_;
};

}  // namespace vindu
