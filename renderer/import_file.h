// What can be said about a model file before anything reads it: that it is there, that it is a file
// of a believable size, and that Assimp has a reader for its kind.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vindu {

/// Throws Error with a remedy; returns only where reading the file is worth trying.
void check_model_file(const std::string& file, std::uintmax_t max_bytes);

/// "model.GLB" -> ".glb".
std::string lower_extension(const std::string& file);

/// ASCII only, as file formats and their names in the wild are.
std::string lower_case(std::string_view text);

}  // namespace vindu
