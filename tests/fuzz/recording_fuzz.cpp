// Any bytes as a recording, binary or text: nothing crashes, reading ends, and every report that is
// read can be written and comes back the same. For libFuzzer; tests/fuzz/run.sh builds and runs it.
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <cstdlib>

#include "core/error.h"
#include "tracker/recording_format.h"
#include "tracker/recording_reader.h"

namespace {

using namespace vindu;

void require(bool holds) {
  if (!holds) std::abort();
}

/// A file in memory, at a path.
class MemoryFile {
 public:
  explicit MemoryFile(ByteSpan bytes) : descriptor_(memfd_create("recording", 0)) {
    require(write(descriptor_, bytes.data(), bytes.size()) == std::ssize(bytes));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

void check_report(const RecordedReport& report) {
  Bytes record;
  append_report(record, report.device, report.arrival, report.bytes);
  require(record_is_whole(record) && record_size(record) == record.size());
  const auto decoded = decode_body(ByteSpan(record).subspan(kRecordHead));
  require(decoded && std::get<RecordedReport>(*decoded) == report);
  TextLine line;
  require(parse_text_line(text_line("left", report), line).empty());
  require(line.arrival == report.arrival && line.bytes == report.bytes);
}

void check_file(ByteSpan bytes, DamagePolicy damage) {
  const MemoryFile file(bytes);
  try {
    RecordingReader reader(file.path(), damage);
    std::size_t reports = 0;
    while (const auto report = reader.next()) {
      check_report(*report);
      require(++reports <= bytes.size());
    }
    const RecordingProblems& problems = reader.problems();
    require(problems.torn_bytes + problems.damaged_bytes <= bytes.size());
  } catch (const Error&) {
    return;  // what is no recording is refused
  }
}

void append_u32(Bytes& to, std::size_t value) {
  for (int i = 0; i < 4; ++i) to.push_back(static_cast<std::uint8_t>(value >> 8 * i & 0xff));
}

/// Bodies with right checksums, which no chance would find: two bytes of length, then so many of
/// body; again and again. The first is that of the start record.
Bytes recording_of(ByteSpan bodies) {
  Bytes bytes(kRecordingMagic.begin(), kRecordingMagic.end());
  append_u32(bytes, kRecordingFormat);
  while (bodies.size() >= 2) {
    const std::size_t length =
        std::min<std::size_t>(bodies[0] + 256 * bodies[1], bodies.size() - 2);
    const ByteSpan body = bodies.subspan(2, length);
    append_u32(bytes, length);
    append_u32(bytes, crc32(0, body.data(), static_cast<uInt>(length)));
    bytes.insert(bytes.end(), body.begin(), body.end());
    bodies = bodies.subspan(2 + length);
  }
  return bytes;
}

}  // namespace

/// The first byte says whether the others are a file or the bodies of records, and what is done
/// about damage.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const ByteSpan rest(data + 1, size - 1);
  const Bytes bytes = data[0] & 1 ? recording_of(rest) : Bytes(rest.begin(), rest.end());
  check_file(bytes, data[0] & 2 ? DamagePolicy::skip : DamagePolicy::refuse);
  return 0;
}
