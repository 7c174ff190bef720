// A line of comma-separated values for each frame: its parts, motion to photon and skew. Written
// at least every second, so that a process that is killed loses no more.
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "core/frame_parts.h"
#include "core/pose.h"

namespace vindu::app {

struct FrameLine {
  std::uint64_t number = 0;
  Time tick{};
  std::optional<TrackingLevel> level{};  ///< empty: nothing is tracked
  std::size_t tiles = 0;                 ///< that have said when they swapped
  std::string last_tile{};               ///< the one that swapped last: the parts are its
  FrameParts parts{};                    ///< with no tiles: capture age and solve alone
  Duration skew{};                       ///< from the first tile's swap to the last's
};

/// "frame,time_s,..." with units, without an end of line.
std::string csv_header();
/// What is not known is empty. `start`: time_s is from there.
std::string csv_line(const FrameLine& line, Time start);

class FrameCsv {
 public:
  /// Throws Error when the file cannot be written.
  explicit FrameCsv(const std::string& file);
  FrameCsv(const FrameCsv&) = delete;
  FrameCsv& operator=(const FrameCsv&) = delete;
  ~FrameCsv();
  /// Lines come in the order of their frames. A disk that is full is said once.
  void add(const FrameLine& line);

 private:
  void write();

  std::string file_;
  std::ofstream stream_;
  std::string pending_;
  std::optional<Time> start_;
  Time written_{};
  bool failed_ = false;
};

}  // namespace vindu::app
