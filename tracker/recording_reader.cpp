#include "tracker/recording_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include "core/error.h"
#include "tracker/recording_format.h"

namespace vindu {
namespace {

constexpr std::size_t kLongestLine = 64 << 10;
constexpr std::size_t kRemarks = 10;
constexpr std::size_t kNotes = 1000;
constexpr std::array<std::uint8_t, 3> kByteOrderMark = {0xef, 0xbb, 0xbf};  // of UTF-8

/// The whole record that begins here; empty where there is none.
ByteSpan whole_record(RecordingStream& stream, std::size_t largest_body) {
  const ByteSpan head = stream.peek(kRecordHead);
  if (head.size() < kRecordHead) return {};
  const std::size_t size = record_size(head);
  if (size <= kRecordHead || size > kRecordHead + largest_body) return {};
  const ByteSpan record = stream.peek(size);
  return record.size() == size && record_is_whole(record) ? record : ByteSpan();
}

bool starts_as_binary(ByteSpan bytes) {
  return std::ranges::equal(bytes, kRecordingMagic, {}, {},
                            [](char letter) { return static_cast<std::uint8_t>(letter); });
}

/// "a.2.vrec", part 2, gives "a.vrec"; "" where the name does not say so.
std::string base_of_part(const std::string& file, int part) {
  if (part == 0) return file;
  std::filesystem::path path(file);
  const std::filesystem::path extension = path.extension();
  path.replace_extension();
  if (path.extension() != "." + std::to_string(part)) return "";
  path.replace_extension(extension);
  return path;
}

std::optional<int> device_number(const std::string& word) {
  int number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error != std::errc{} || stop != end || number < 0 || number > 0xffff) return std::nullopt;
  return number;
}

}  // namespace

RecordingReader::RecordingReader(const std::string& file, DamagePolicy damage)
    : base_(file), file_(file), damage_(damage), stream_(file) {
  const ByteSpan begin = stream_->peek(512);
  if (begin.empty()) throw Error({"is empty", file, "record again"});
  text_ = !starts_as_binary(begin.first(std::min(begin.size(), kRecordingMagic.size())));
  if (text_ && std::ranges::find(begin, 0) != begin.end())
    throw Error({"is neither a recording nor text", file,
                 "give a file that vindu record wrote, or lines \"device arrival_ns hex-bytes\""});
  if (!text_)
    begin_part();
  else if (std::ranges::equal(stream_->peek(kByteOrderMark.size()), kByteOrderMark))
    stream_->skip(kByteOrderMark.size());
}

void RecordingReader::begin_part() {
  const ByteSpan preamble = stream_->peek(kPreambleSize + 1);
  if (preamble.size() <= kPreambleSize)
    throw Error({"ends within its beginning", file_, "nothing can be read of it; record again"});
  const std::uint32_t format = read_u32(preamble.subspan(kRecordingMagic.size()));
  if (format != kRecordingFormat)
    throw Error({"is of format " + std::to_string(format) + "; this version reads " +
                     std::to_string(kRecordingFormat),
                 file_, "use the version of vindu that wrote it, or a newer one"});
  stream_->skip(kPreambleSize);
  const ByteSpan record = whole_record(*stream_, kMaxStartBody);
  const auto body = record.empty() ? std::nullopt : decode_body(record.subspan(kRecordHead));
  const auto* start = body ? std::get_if<StartRecord>(&*body) : nullptr;
  if (!start) return handle_damage();
  stream_->skip(record.size());
  info_ = start->info;
  part_ = start->part;
  base_ = base_of_part(file_, part_);
}

bool RecordingReader::begin_next_part() {
  const std::string next = base_.empty() ? "" : recording_part(base_, part_ + 1);
  std::error_code ignored;
  if (next.empty()) return false;
  if (!std::filesystem::exists(next, ignored)) {
    look_for_later_parts();
    return false;
  }
  const std::uint64_t size = std::filesystem::file_size(next, ignored);
  if (size <= kPreambleSize) {  // cut off as it was begun
    problems_.torn_bytes += size;
    remark(next + ": was cut off at its beginning");
    return false;
  }
  const RecordingReader other(next, damage_);
  if (!continues(other, part_ + 1)) {
    remark(next + " belongs to another recording and was not read");
    return false;
  }
  file_ = next;
  stream_.emplace(next);
  begin_part();
  return true;
}

bool RecordingReader::continues(const RecordingReader& other, int part) const {
  return other.info_.started_utc_ns == info_.started_utc_ns &&
         other.info_.started == info_.started && other.part_ == part;
}

/// Where the next part is not there: one after it tells that the recording did not end here.
void RecordingReader::look_for_later_parts() {
  const auto later = recording_part_after(base_, part_ + 1);
  if (!later) return;
  const std::string file = recording_part(base_, *later);
  try {
    if (!continues(RecordingReader(file, damage_), *later)) return;
  } catch (const Error&) {  // nobody can say whose it is
    return;
  }
  for (int part = part_ + 1; part < *later && problems_.missing.size() < kRemarks; ++part)
    problems_.missing.push_back(recording_part(base_, part));
  remark(problems_.missing.front() + " is missing: " + file +
         " belongs to this recording, too, and was not read; put the missing part back, or read "
         "the later one by itself");
}

std::optional<RecordedReport> RecordingReader::next() {
  return text_ ? next_line() : next_record();
}

std::optional<RecordedReport> RecordingReader::next_record() {
  for (;;) {
    if (stream_->peek(1).empty()) {
      if (!begin_next_part()) return std::nullopt;
      continue;
    }
    const ByteSpan bytes = whole_record(*stream_, kMaxBody);
    auto record = bytes.empty() ? std::nullopt : decode_body(bytes.subspan(kRecordHead));
    if (!record) {
      handle_damage();
      continue;
    }
    record_begin_ = stream_->offset();
    stream_->skip(bytes.size());
    if (const auto* note = std::get_if<RecordedNote>(&*record); note && notes_.size() < kNotes)
      notes_.push_back(*note);
    if (const auto* dropped = std::get_if<DroppedRecord>(&*record))
      problems_.dropped += dropped->reports;
    if (auto* report = std::get_if<RecordedReport>(&*record)) {
      know_device(report->device, "");
      return std::move(*report);
    }
  }
}

std::string RecordingReader::place() const {
  return text_ ? file_ + ":" + std::to_string(line_)
               : file_ + ", byte " + std::to_string(record_begin_);
}

/// Goes to the next whole record. Where none follows, the recording ends here: writing was cut off.
void RecordingReader::handle_damage() {
  const std::uint64_t begin = stream_->offset();
  do stream_->skip(1);
  while (!stream_->peek(1).empty() && whole_record(*stream_, kMaxBody).empty());
  const std::uint64_t bytes = stream_->offset() - begin;
  const std::string count = std::to_string(bytes) + " bytes";
  if (stream_->peek(1).empty()) {
    problems_.torn_bytes += bytes;
    return remark(file_ + ": the last " + count + " are no whole record and are lost");
  }
  const std::string where = file_ + ", byte " + std::to_string(begin);
  if (damage_ == DamagePolicy::refuse) refuse(count + " are damaged", where);
  problems_.damaged_bytes += bytes;
  remark(where + ": " + count + " are damaged and were skipped");
}

/// Without its end; longer ones are cut into several.
std::optional<std::string> RecordingReader::take_line() {
  const ByteSpan bytes = stream_->peek(kLongestLine);
  if (bytes.empty()) return std::nullopt;
  const auto end = std::ranges::find(bytes, '\n');
  std::string line(bytes.begin(), end);
  line_ended_ = end != bytes.end();
  stream_->skip(line.size() + (line_ended_ ? 1 : 0));
  ++line_;
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

std::optional<RecordedReport> RecordingReader::next_line() {
  while (const auto text = take_line()) {
    const std::size_t first = text->find_first_not_of(" \t");
    if (first == std::string::npos || (*text)[first] == '#') continue;
    TextLine line;
    const std::string wrong = parse_text_line(*text, line);
    if (wrong.empty()) return report_of_line(line.device, {0, line.arrival, std::move(line.bytes)});
    handle_bad_line(wrong, text->size(), line_ended_);
  }
  return std::nullopt;
}

/// A number is the index; names get theirs in order of appearance. Both in one recording would be
/// a guess.
RecordedReport RecordingReader::report_of_line(const std::string& word, RecordedReport report) {
  const auto number = device_number(word);
  if (number.has_value() ? !index_of_name_.empty()
                         : !info_.devices.empty() && index_of_name_.empty())
    throw Error({"\"" + word + "\": some devices have names and others numbers", place(),
                 "write one or the other on all lines"});
  if (!number) {
    const auto next = static_cast<int>(index_of_name_.size());
    report.device = index_of_name_.try_emplace(word, next).first->second;
    if (report.device > 0xffff)
      throw Error(
          {"there are more than 65536 devices", place(), "begin each line with the camera's name"});
  }
  report.device = number.value_or(report.device);
  know_device(report.device, number ? "" : word);
  return report;
}

void RecordingReader::handle_bad_line(const std::string& what, std::size_t size, bool ended) {
  const std::string where = place();
  if (!ended && stream_->peek(1).empty()) {
    problems_.torn_bytes += size;
    return remark(where + ": the last " + std::to_string(size) +
                  " bytes are no whole line: " + what);
  }
  if (damage_ == DamagePolicy::refuse) refuse(what, where);
  problems_.damaged_bytes += size;
  remark(where + ": skipped: " + what);
}

void RecordingReader::refuse(const std::string& what, const std::string& where) const {
  const std::string whole = text_ ? "correct the line (device arrival_ns hex-bytes)"
                                  : "copy the file again from where it was recorded";
  throw Error({what, where, whole + ", or read around it with --skip-damage"});
}

void RecordingReader::remark(const std::string& what) {
  if (problems_.remarks.size() < kRemarks) problems_.remarks.push_back(what);
}

void RecordingReader::know_device(int index, const std::string& name) {
  if (std::ranges::find(info_.devices, index, &RecordedDevice::index) == info_.devices.end())
    info_.devices.push_back({index, name});
}

}  // namespace vindu
