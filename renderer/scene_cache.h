// Packed scenes by what their models hold: a model is packed once, whoever asks, however many
// processes do so at once, and again when one of its files has changed.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "renderer/scene_file.h"

namespace vindu {

class SceneCache {
 public:
  /// A folder of its own, made when it is needed. Scenes that were used longest ago go when all
  /// together have more bytes.
  explicit SceneCache(std::filesystem::path folder,
                      std::uintmax_t most_bytes = std::uintmax_t{8} << 30);

  /// $XDG_CACHE_HOME/vindu/scenes, or ~/.cache/vindu/scenes; empty where neither is known.
  static std::filesystem::path usual_folder();

  /// Where the scene of a model of that content is kept.
  std::filesystem::path entry_of(const std::string& model_sha256) const;

  /// Empty when it is not there, damaged, or a file of the model has changed since.
  std::optional<PackedScene> find(const std::string& model_sha256, const std::string& model) const;

  /// The scene of the model; `pack` writes it to the file that it is given, and throws Error when
  /// it cannot. One process packs, others wait for it, until a stop: then Error. Throws
  /// std::filesystem::filesystem_error when the folder cannot be written.
  PackedScene find_or_pack(const std::string& model, const std::string& model_sha256,
                           const std::function<void(const std::string& file)>& pack,
                           const std::stop_token& stop = {}) const;

 private:
  void forget_oldest() const;

  std::filesystem::path folder_;
  std::uintmax_t most_bytes_;
};

}  // namespace vindu
