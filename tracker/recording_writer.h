// Writes a recording while it happens. Reader threads add reports to a queue in memory; one thread
// of the writer's own brings them to disk twice a second, so that a crash loses no more than that.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "tracker/recording.h"

namespace vindu {

struct RecordingOptions {
  std::uint64_t rotate_bytes = 0;                  ///< a file grows no larger; 0: one file
  std::size_t queue_bytes = std::size_t{8} << 20;  ///< what waits at most for a slow disk
};

struct RecordingStatus {
  std::vector<std::uint64_t> reports;  ///< added and not dropped, in the order of info.devices
  std::uint64_t dropped = 0;           ///< while the queue was full, or after a failure
  std::uint64_t bytes = 0;             ///< on disk, all files together
  int files = 1;
  std::string failure;  ///< why nothing more is written; "" while all is well
};

/// Thread-safe.
class RecordingWriter {
 public:
  /// Throws Error where the file or a later part of its name exists already, where it cannot be
  /// written, and where two devices have one index. Its beginning is on disk when this returns.
  RecordingWriter(std::string file, RecordingInfo info, const RecordingOptions& options = {});
  /// Writes what waits.
  ~RecordingWriter();

  /// Bounded work: copies the report, never waits for the disk. `device` is the index of one of
  /// info.devices; 1 to kMaxRecordedReport bytes.
  void add(int device, Time arrival, std::span<const std::uint8_t> report);

  /// Bounded work, as add(); at most kMaxRecordedReport bytes of the text.
  void note(Time time, std::string text);

  /// Brings all that was added before to disk.
  void flush();

  RecordingStatus status() const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void run(const std::stop_token& stop);
  std::vector<std::uint8_t> take_queue();
  void write_records(std::span<const std::uint8_t> records);
  void open_part(int part);
  void write(std::span<const std::uint8_t> bytes);
  void sync();

  const std::string file_;
  const RecordingInfo info_;
  const RecordingOptions options_;

  std::mutex disk_mutex_;  // of the file and what is known of it; taken before queue_mutex_
  std::unique_ptr<std::FILE, CloseFile> part_file_;
  std::uint64_t part_bytes_ = 0;
  std::uint64_t start_bytes_ = 0;

  mutable std::mutex queue_mutex_;  // of the queue and the status
  std::condition_variable_any queue_filled_;
  std::vector<std::uint8_t> queue_;
  std::uint64_t dropped_unsaid_ = 0;  // not yet in the recording
  RecordingStatus status_;

  std::jthread thread_;
};

}  // namespace vindu
