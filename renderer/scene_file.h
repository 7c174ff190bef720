// A packed scene as a file, ready to be mapped into memory. Only the Vindu that wrote it reads it:
// it is a cache, and a way to bring a scene to hosts, not an exchange format.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderer/packed_scene.h"

namespace vindu {

/// Ends the names of such files.
constexpr const char* kSceneFileExtension = ".vscene";

/// Where a process writes such a file until it is whole.
inline std::string unfinished_scene_file(const std::string& file, long process) {
  return file + "." + std::to_string(process) + ".part";
}

/// Whole or not at all. Throws Error when it cannot be written.
void write_scene_file(const PackedScene& packed, const std::string& file);

/// Maps the file into memory, which it must not be overwritten in while the scene lives: who writes
/// one anew puts it in its place (rename). Throws Error: not there, not such a file, of another
/// Vindu, damaged.
PackedScene read_scene_file(const std::string& file);

/// Of what follows the file's header, at a multiple of 16 bytes and outliving the scene; errors
/// name `file`.
PackedScene scene_from(std::span<const std::uint8_t> content, const std::string& file);

}  // namespace vindu
