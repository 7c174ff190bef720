// Reads a recording, binary or text, report by report and from file to file where it was rotated.
// A torn end is a remark; damage before it is an error, unless the caller wants it skipped.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tracker/recording.h"
#include "tracker/recording_stream.h"

namespace vindu {

enum class DamagePolicy { refuse, skip };

struct RecordingProblems {
  std::uint64_t torn_bytes = 0;      ///< at the end, where writing was cut off
  std::uint64_t damaged_bytes = 0;   ///< that were skipped
  std::uint64_t dropped = 0;         ///< reports that the recorder itself had to leave out
  std::vector<std::string> missing;  ///< files of a rotated recording, before others of it
  std::vector<std::string> remarks;  ///< for people, each with its file; the first few
};

/// Bound to one thread.
class RecordingReader {
 public:
  /// Throws Error where the file cannot be read or is no recording.
  explicit RecordingReader(const std::string& file, DamagePolicy damage = DamagePolicy::refuse);

  /// In the order of the file, which between devices need not be that of time. Empty at the end.
  /// Throws Error with file and place (a byte's offset, or a line) where the recording is damaged.
  std::optional<RecordedReport> next();

  /// Where the recording itself does not name its devices, those that appeared so far.
  const RecordingInfo& info() const { return info_; }
  const RecordingProblems& problems() const { return problems_; }
  /// Of what was read so far; the first thousand.
  const std::vector<RecordedNote>& notes() const { return notes_; }
  /// Where the last report stands: "walk.txt:12", or "walk.vrec, byte 345".
  std::string place() const;

 private:
  void begin_part();
  bool begin_next_part();
  bool continues(const RecordingReader& other, int part) const;
  void look_for_later_parts();
  std::optional<RecordedReport> next_record();
  std::optional<RecordedReport> next_line();
  std::optional<std::string> take_line();
  RecordedReport report_of_line(const std::string& device_word, RecordedReport report);
  void handle_damage();
  void handle_bad_line(const std::string& what, std::size_t size, bool ended);
  void refuse(const std::string& what, const std::string& where) const;
  void remark(const std::string& what);
  void know_device(int index, const std::string& name);

  std::string base_;  // of part 0
  std::string file_;  // the one that is being read
  DamagePolicy damage_;
  std::optional<RecordingStream> stream_;
  bool text_ = false;
  int part_ = 0;
  std::uint64_t line_ = 0;          // the last one
  std::uint64_t record_begin_ = 0;  // of the last one, from the file's beginning
  bool line_ended_ = false;         // by a newline
  RecordingInfo info_;
  RecordingProblems problems_;
  std::vector<RecordedNote> notes_;
  std::map<std::string, int> index_of_name_;  // text only
};

}  // namespace vindu
