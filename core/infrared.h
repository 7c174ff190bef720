// What the infrared camera of a Wiimote is set to: how it reports its dots, and what it takes for
// one. Which sensitivity suits depends on distance and LEDs: too little gain and sub-pixel steps
// die, too much and reflections win one of the four slots.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vindu {

enum class IrFormat : std::uint8_t { basic, extended, full };

/// Of its name; empty when it is none.
std::optional<IrFormat> ir_format_from(std::string_view name);

/// Written to registers 0xb00000 and 0xb0001a. Of the first, [6] is the largest blob and [8] the
/// gain (less is more); of the second, [0] is the limit of the gain, less than [8], and [1] the
/// smallest blob (wiki.wiimoteproject.com, IR Sensor).
struct Sensitivity {
  std::array<std::uint8_t, 9> block_1{};
  std::array<std::uint8_t, 2> block_2{};

  bool operator==(const Sensitivity&) const = default;
};

/// "wii-1" to "wii-5" (least to most sensitive), "marcan", "inio", "maximum": the levels of the
/// console and those that WiiBrew, cwiid and Kestrel use. For messages: "wii-1, wii-2, ...".
std::string sensitivity_names();

/// Of a name, or of 11 bytes as 22 hexadecimal digits, blanks between them allowed; empty when it
/// is neither.
std::optional<Sensitivity> sensitivity_from(const std::string& text);

/// For LEDs three to five metres away.
inline constexpr const char* kDefaultSensitivity = "wii-4";

}  // namespace vindu
