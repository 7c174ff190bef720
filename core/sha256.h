// What a file or a text holds, as 64 digits: equal on two hosts when that is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vindu {

/// SHA-256 (FIPS 180-4) in hexadecimal.
std::string sha256_of_text(std::string_view bytes);

/// Of the file's bytes; empty when it cannot be read.
std::optional<std::string> sha256_of_file(const std::string& file);

}  // namespace vindu
