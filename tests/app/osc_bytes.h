// Messages of Open Sound Control 1.0 byte by byte, as tests send them: written from its
// specification, without the library that reads them.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace vindu::testing {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

inline Bytes osc_number(std::int32_t value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return {static_cast<std::uint8_t>(bits >> 24), static_cast<std::uint8_t>(bits >> 16),
          static_cast<std::uint8_t>(bits >> 8), static_cast<std::uint8_t>(bits)};
}

inline Bytes osc_real(float value) { return osc_number(std::bit_cast<std::int32_t>(value)); }

/// Ends with one to four zeros, at a multiple of four.
inline Bytes osc_text(const std::string& text) {
  Bytes bytes(text.begin(), text.end());
  bytes.resize((text.size() / 4 + 1) * 4);
  return bytes;
}

/// Of the profile /tuio/2Dcur.
inline Bytes cursor_message(const std::string& types, const Bytes& arguments) {
  Bytes bytes = osc_text("/tuio/2Dcur");
  append(bytes, osc_text("," + types));
  append(bytes, arguments);
  return bytes;
}

inline Bytes alive(const std::vector<std::int32_t>& ids) {
  Bytes arguments = osc_text("alive");
  for (const std::int32_t id : ids) append(arguments, osc_number(id));
  return cursor_message("s" + std::string(ids.size(), 'i'), arguments);
}

/// A point, its velocity and acceleration (zero).
inline Bytes set(std::int32_t id, float x, float y) {
  Bytes arguments = osc_text("set");
  append(arguments, osc_number(id));
  for (const float value : {x, y, 0.0f, 0.0f, 0.0f}) append(arguments, osc_real(value));
  return cursor_message("sifffff", arguments);
}

inline Bytes fseq(std::int32_t number) {
  Bytes arguments = osc_text("fseq");
  append(arguments, osc_number(number));
  return cursor_message("si", arguments);
}

inline Bytes source(const std::string& name) {
  Bytes arguments = osc_text("source");
  append(arguments, osc_text(name));
  return cursor_message("ss", arguments);
}

/// "#bundle", the time "at once", and each message with its length.
inline Bytes bundle(const std::vector<Bytes>& messages) {
  Bytes bytes = osc_text("#bundle");
  append(bytes, {0, 0, 0, 0, 0, 0, 0, 1});
  for (const Bytes& message : messages) {
    append(bytes, osc_number(static_cast<std::int32_t>(message.size())));
    append(bytes, message);
  }
  return bytes;
}

}  // namespace vindu::testing
