// The bytes of a recording's records, written and read; docs/recording.md has the layout. Private
// to the recording's writer and reader.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "tracker/recording.h"

namespace vindu {

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

constexpr std::string_view kRecordingMagic = "VINDUREC";
constexpr std::uint32_t kRecordingFormat = 1;
constexpr std::size_t kPreambleSize = 12;  ///< magic and format
constexpr std::size_t kRecordHead = 8;     ///< length of the body and its CRC-32
constexpr std::size_t kMaxStartBody = 16 << 20;
constexpr std::size_t kMaxBody = kMaxRecordedReport + 11;  ///< of all records but the start

struct StartRecord {
  RecordingInfo info;
  int part = 0;
};
struct DroppedRecord {
  std::uint64_t reports = 0;
};
/// monostate: a type that this version does not know.
using Record =
    std::variant<std::monostate, StartRecord, RecordedReport, DroppedRecord, RecordedNote>;

/// The preamble, then the record that every file begins with.
void append_start(Bytes& to, const StartRecord& start);
void append_report(Bytes& to, int device, Time arrival, ByteSpan report);
void append_dropped(Bytes& to, const DroppedRecord& dropped);
void append_note(Bytes& to, const RecordedNote& note);

/// Size of the whole record that begins here, by its length field. Needs kRecordHead bytes.
std::size_t record_size(ByteSpan bytes);
/// Whether the CRC-32 of a whole record is right.
bool record_is_whole(ByteSpan record);

/// Empty where the body cannot have been written by us: too short, or values out of range.
std::optional<Record> decode_body(ByteSpan body);

std::uint32_t read_u32(ByteSpan bytes);

struct TextLine {
  std::string device;  ///< a number, or a name
  Time arrival{};
  Bytes bytes;
};
/// What is wrong with a line that is neither empty nor a comment; "" when `line` was filled.
std::string parse_text_line(std::string_view text, TextLine& line);

/// 0 to 4e18 ns, 126 years: sums of two times do not overflow.
bool arrival_in_range(std::int64_t arrival_ns);

}  // namespace vindu
