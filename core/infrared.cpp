#include "core/infrared.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace vindu {
namespace {

struct NamedSensitivity {
  const char* name;
  Sensitivity blocks;
};

constexpr NamedSensitivity kNamed[] = {
    {"wii-1", {{0x02, 0, 0, 0x71, 0x01, 0, 0x64, 0, 0xfe}, {0xfd, 0x05}}},
    {"wii-2", {{0x02, 0, 0, 0x71, 0x01, 0, 0x96, 0, 0xb4}, {0xb3, 0x04}}},
    {"wii-3", {{0x02, 0, 0, 0x71, 0x01, 0, 0xaa, 0, 0x64}, {0x63, 0x03}}},
    {"wii-4", {{0x02, 0, 0, 0x71, 0x01, 0, 0xc8, 0, 0x36}, {0x35, 0x03}}},
    {"wii-5", {{0x07, 0, 0, 0x71, 0x01, 0, 0x72, 0, 0x20}, {0x1f, 0x03}}},
    {"marcan", {{0, 0, 0, 0, 0, 0, 0x90, 0, 0xc0}, {0x40, 0}}},
    {"inio", {{0, 0, 0, 0, 0, 0, 0x90, 0, 0x41}, {0x40, 0}}},
    {"maximum", {{0, 0, 0, 0, 0, 0, 0xff, 0, 0x0c}, {0, 0}}},
};

std::optional<std::vector<std::uint8_t>> bytes_from_hex(std::string text) {
  std::erase(text, ' ');
  std::vector<std::uint8_t> bytes(text.size() / 2);
  if (text.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char* digits = text.data() + 2 * i;
    if (std::from_chars(digits, digits + 2, bytes[i], 16).ptr != digits + 2) return std::nullopt;
  }
  return bytes;
}

}  // namespace

std::optional<IrFormat> ir_format_from(std::string_view name) {
  if (name == "basic") return IrFormat::basic;
  if (name == "extended") return IrFormat::extended;
  if (name == "full") return IrFormat::full;
  return std::nullopt;
}

std::string sensitivity_names() {
  std::string names;
  for (const NamedSensitivity& named : kNamed)
    names += std::string(names.empty() ? "" : ", ") + named.name;
  return names;
}

std::optional<Sensitivity> sensitivity_from(const std::string& text) {
  const auto* named =
      std::ranges::find_if(kNamed, [&](const NamedSensitivity& each) { return each.name == text; });
  if (named != std::end(kNamed)) return named->blocks;
  const auto bytes = bytes_from_hex(text);
  Sensitivity custom;
  if (!bytes || bytes->size() != custom.block_1.size() + custom.block_2.size()) return std::nullopt;
  const auto middle = bytes->begin() + custom.block_1.size();
  std::copy(bytes->begin(), middle, custom.block_1.begin());
  std::copy(middle, bytes->end(), custom.block_2.begin());
  return custom;
}

}  // namespace vindu
