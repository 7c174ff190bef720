// Files of keys: nobody but their owner reads them. Private to cluster/keys.
#pragma once

#include <filesystem>
#include <string>

namespace vindu::internal {

/// Throws Error where it cannot be read.
std::string read_key_file(const std::filesystem::path& file);

/// With mode 0600 from its first byte on, new folders with 0700; whole or not at all. Throws Error.
void write_key_file(const std::filesystem::path& file, const std::string& text);

/// Throws Error where anybody but its owner may read it.
void expect_private(const std::filesystem::path& file);

}  // namespace vindu::internal
