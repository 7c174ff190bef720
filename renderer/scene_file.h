// A scene as a file: all that an importer made of a model, ready to be copied into memory. Only the
// Vindu that wrote it reads it: it is a cache, and a way to bring a scene to hosts, not an exchange
// format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/import.h"

namespace vindu {

/// Ends the names of such files.
constexpr const char* kSceneFileExtension = ".vscene";

/// A file that the model was read from, to notice that it has changed.
struct SceneSource {
  std::string path;  ///< absolute
  std::uint64_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
};

struct PackedScene {
  ImportResult imported;
  std::vector<SceneSource> sources;  ///< the model first
};

/// Whole or not at all. Throws Error when it cannot be written.
void write_scene_file(const PackedScene& packed, const std::string& file);

/// Throws Error: not there, not such a file, of another Vindu, damaged.
PackedScene read_scene_file(const std::string& file);

/// What makes a scene unfit to be drawn, an index out of range say; empty: nothing.
std::string fault_of(const Scene& scene);

}  // namespace vindu
