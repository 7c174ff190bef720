#include "cluster/launch/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/error.h"

namespace vindu {
namespace {

void refuse_zero(const std::string& text) {
  if (text.find('\0') != std::string::npos)
    throw Error({"holds a zero byte", "\"" + text.substr(0, text.find('\0')) + "...\"",
                 "no program can be given that"});
}

bool is_plain(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= '0' && letter <= '9') ||
         std::string_view("-_./:@+,").find(letter) != std::string_view::npos;
}

/// RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? letters[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string shell_word(const std::string& text) {
  refuse_zero(text);
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char letter : text) {
    if (letter == '\'')
      quoted += "'\\''";
    else
      quoted += letter;
  }
  return quoted + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

std::string unit_word(const std::string& text, const std::string& prefix) {
  refuse_zero(text);
  std::string quoted = "\"" + prefix;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\x{:02x}", code);
    else if (letter == '%' || letter == '$')
      quoted += std::string(2, letter);
    else if (letter == '"' || letter == '\\')
      quoted += std::string("\\") + letter;
    else
      quoted += letter;
  }
  return quoted + "\"";
}

std::string command_for_hosts(const std::string& script) {
  return "echo " + base64(script) + " | base64 -d | sh";
}

}  // namespace vindu
