#include "tracker/recording_format.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <concepts>
#include <filesystem>

namespace vindu {
namespace {

enum class RecordType : std::uint8_t { start = 1, report = 2, dropped = 3, note = 4 };

template <std::unsigned_integral Value>
void append(Bytes& to, Value value) {
  for (std::size_t i = 0; i < sizeof(Value); ++i)
    to.push_back(static_cast<std::uint8_t>(std::uint64_t{value} >> 8 * i & 0xff));
}

void append_text(Bytes& to, std::string_view text) {
  append(to, static_cast<std::uint32_t>(text.size()));
  to.insert(to.end(), text.begin(), text.end());
}

std::uint32_t crc_of(ByteSpan bytes) {
  return static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
}

void put_u32(Bytes& to, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) to[at + i] = static_cast<std::uint8_t>(value >> 8 * i & 0xff);
}

/// Room for length and CRC-32, then the type; returns where the record begins.
std::size_t begin_record(Bytes& to, RecordType type) {
  const std::size_t begin = to.size();
  to.resize(begin + kRecordHead);
  to.push_back(static_cast<std::uint8_t>(type));
  return begin;
}

void end_record(Bytes& to, std::size_t begin) {
  const ByteSpan body = ByteSpan(to).subspan(begin + kRecordHead);
  put_u32(to, begin, static_cast<std::uint32_t>(body.size()));
  put_u32(to, begin + 4, crc_of(body));
}

/// Takes values off the front; one that is not there makes all of it bad.
class Taker {
 public:
  explicit Taker(ByteSpan bytes) : rest_(bytes) {}

  template <std::unsigned_integral Value>
  Value take() {
    const ByteSpan bytes = take_bytes(sizeof(Value));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::uint64_t{bytes[i]} << 8 * i;
    return static_cast<Value>(value);
  }
  std::int64_t take_i64() { return static_cast<std::int64_t>(take<std::uint64_t>()); }
  Time take_time() {
    const std::int64_t time_ns = take_i64();
    good_ = good_ && arrival_in_range(time_ns);
    return Time{Duration(good_ ? time_ns : 0)};
  }
  std::string take_text() {
    const ByteSpan bytes = take_bytes(take<std::uint32_t>());
    return {bytes.begin(), bytes.end()};
  }
  ByteSpan rest() const { return rest_; }
  bool good() const { return good_; }

 private:
  ByteSpan take_bytes(std::size_t count) {
    good_ = good_ && count <= rest_.size();
    if (!good_) return {};
    const ByteSpan taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  ByteSpan rest_;
  bool good_ = true;
};

std::optional<Record> decode_start(Taker from) {
  StartRecord start;
  start.info.started_utc_ns = from.take_i64();
  start.info.started = from.take_time();
  const auto part = from.take<std::uint32_t>();
  start.info.program = from.take_text();
  start.info.wall_file = from.take_text();
  start.info.wall_text = from.take_text();
  const int devices = from.take<std::uint16_t>();
  for (int i = 0; i < devices && from.good(); ++i) {
    const int index = from.take<std::uint16_t>();
    start.info.devices.push_back({index, from.take_text()});
  }
  if (!from.good() || part > 1'000'000) return std::nullopt;
  start.part = static_cast<int>(part);
  return start;
}

std::optional<Record> decode_report(Taker from) {
  RecordedReport report;
  report.device = from.take<std::uint16_t>();
  report.arrival = from.take_time();
  report.bytes.assign(from.rest().begin(), from.rest().end());
  if (!from.good() || report.bytes.empty() || report.bytes.size() > kMaxRecordedReport)
    return std::nullopt;
  return report;
}

std::optional<Record> decode_dropped(Taker from) {
  const DroppedRecord dropped{from.take<std::uint64_t>()};
  return from.good() ? std::optional<Record>(dropped) : std::nullopt;
}

std::optional<Record> decode_note(Taker from) {
  RecordedNote note{from.take_time(), {}};
  note.text.assign(from.rest().begin(), from.rest().end());
  if (!from.good() || note.text.size() > kMaxRecordedReport) return std::nullopt;
  return note;
}

constexpr bool is_blank(char letter) { return letter == ' ' || letter == '\t'; }

/// The next word, and the line without it.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view word = line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
  line.remove_prefix(word.size());
  return word;
}

int hex_digit(char letter) {
  if (letter >= '0' && letter <= '9') return letter - '0';
  const char small = static_cast<char>(letter | 0x20);
  return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

/// Pairs of digits; blanks may stand between pairs.
std::string parse_hex(std::string_view text, Bytes& bytes) {
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    const int high = hex_digit(text[at]);
    const int low = at + 1 < text.size() ? hex_digit(text[at + 1]) : -1;
    if (high < 0 || low < 0)
      return "\"" + std::string(text.substr(at, 2)) + "\" is not a byte in two hex digits";
    bytes.push_back(static_cast<std::uint8_t>(16 * high + low));
    at += 2;
  }
  if (bytes.empty()) return "there are no bytes after the arrival time";
  if (bytes.size() > kMaxRecordedReport)
    return std::to_string(bytes.size()) + " bytes are more than any report has";
  return "";
}

}  // namespace

std::string recording_part(const std::string& file, int part) {
  if (part == 0) return file;
  std::filesystem::path path(file);
  const std::string extension = path.extension();
  path.replace_extension("." + std::to_string(part) + extension);
  return path;
}

std::optional<int> recording_part_after(const std::string& file, int part) {
  const std::filesystem::path path(file);
  const std::string begin = path.stem().string() + ".";
  std::optional<int> first;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(
           path.has_parent_path() ? path.parent_path() : ".", unreadable)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(begin)) continue;
    int number = 0;
    std::from_chars(name.data() + begin.size(), name.data() + name.size(), number);
    const bool later = number > part && (!first || number < *first);
    if (later && name == std::filesystem::path(recording_part(file, number)).filename())
      first = number;
  }
  return first;
}

bool arrival_in_range(std::int64_t arrival_ns) {
  return arrival_ns >= 0 && arrival_ns <= 4'000'000'000'000'000'000;
}

void append_start(Bytes& to, const StartRecord& start) {
  to.insert(to.end(), kRecordingMagic.begin(), kRecordingMagic.end());
  append(to, kRecordingFormat);
  const std::size_t begin = begin_record(to, RecordType::start);
  append(to, static_cast<std::uint64_t>(start.info.started_utc_ns));
  append(to, static_cast<std::uint64_t>(nanoseconds(start.info.started)));
  append(to, static_cast<std::uint32_t>(start.part));
  append_text(to, start.info.program);
  append_text(to, start.info.wall_file);
  append_text(to, start.info.wall_text);
  append(to, static_cast<std::uint16_t>(start.info.devices.size()));
  for (const RecordedDevice& device : start.info.devices) {
    append(to, static_cast<std::uint16_t>(device.index));
    append_text(to, device.name);
  }
  end_record(to, begin);
}

void append_report(Bytes& to, int device, Time arrival, ByteSpan report) {
  assert(device >= 0 && device <= 0xffff && arrival_in_range(nanoseconds(arrival)));
  assert(!report.empty() && report.size() <= kMaxRecordedReport);
  const std::size_t begin = begin_record(to, RecordType::report);
  append(to, static_cast<std::uint16_t>(device));
  append(to, static_cast<std::uint64_t>(nanoseconds(arrival)));
  to.insert(to.end(), report.begin(), report.end());
  end_record(to, begin);
}

void append_dropped(Bytes& to, const DroppedRecord& dropped) {
  const std::size_t begin = begin_record(to, RecordType::dropped);
  append(to, dropped.reports);
  end_record(to, begin);
}

void append_note(Bytes& to, const RecordedNote& note) {
  assert(arrival_in_range(nanoseconds(note.time)) && note.text.size() <= kMaxRecordedReport);
  const std::size_t begin = begin_record(to, RecordType::note);
  append(to, static_cast<std::uint64_t>(nanoseconds(note.time)));
  to.insert(to.end(), note.text.begin(), note.text.end());
  end_record(to, begin);
}

std::uint32_t read_u32(ByteSpan bytes) { return Taker(bytes).take<std::uint32_t>(); }

std::size_t record_size(ByteSpan bytes) { return kRecordHead + read_u32(bytes); }

bool record_is_whole(ByteSpan record) {
  return record.size() > kRecordHead &&
         read_u32(record.subspan(4)) == crc_of(record.subspan(kRecordHead));
}

std::optional<Record> decode_body(ByteSpan body) {
  Taker from(body);
  switch (static_cast<RecordType>(from.take<std::uint8_t>())) {
    case RecordType::start:
      return decode_start(from);
    case RecordType::report:
      return decode_report(from);
    case RecordType::dropped:
      return decode_dropped(from);
    case RecordType::note:
      return decode_note(from);
  }
  return from.good() ? std::optional<Record>(std::monostate()) : std::nullopt;
}

std::string text_line(std::string_view device, const RecordedReport& report) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string line(device);
  line += " " + std::to_string(nanoseconds(report.arrival)) + " ";
  for (const std::uint8_t byte : report.bytes) {
    line += kDigits[byte / 16];
    line += kDigits[byte % 16];
  }
  return line;
}

std::string parse_text_line(std::string_view text, TextLine& line) {
  line.device = take_word(text);
  const std::string_view arrival = take_word(text);
  std::int64_t arrival_ns = 0;
  const char* const end = arrival.data() + arrival.size();
  const auto [stop, error] = std::from_chars(arrival.data(), end, arrival_ns);
  if (arrival.empty() || error != std::errc{} || stop != end || !arrival_in_range(arrival_ns))
    return "\"" + std::string(arrival) + "\" is not an arrival time in nanoseconds, 0 to 4e18";
  line.arrival = Time{Duration(arrival_ns)};
  line.bytes.clear();
  return parse_hex(text, line.bytes);
}

}  // namespace vindu
