// A file as a window of bytes that moves forward, for the recording's reader: large files are never
// in memory as a whole.
#pragma once

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace vindu {

/// Bound to one thread.
class RecordingStream {
 public:
  /// Throws Error where the file cannot be read.
  explicit RecordingStream(const std::string& file);

  /// The next `size` bytes, fewer at the file's end; valid until the next call.
  std::span<const std::uint8_t> peek(std::size_t size);
  /// Bytes that were peeked.
  void skip(std::size_t size);
  /// From the file's beginning.
  std::uint64_t offset() const { return offset_; }

 private:
  std::ifstream file_;
  std::vector<std::uint8_t> window_;
  std::size_t begin_ = 0;
  std::uint64_t offset_ = 0;
};

}  // namespace vindu
