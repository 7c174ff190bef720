// What a file holds, as 64 digits: equal on two hosts when the file is.
#pragma once

#include <optional>
#include <string>

namespace vindu {

/// SHA-256 (FIPS 180-4) of the file's bytes in hexadecimal; empty when it cannot be read.
std::optional<std::string> sha256_of_file(const std::string& file);

}  // namespace vindu
