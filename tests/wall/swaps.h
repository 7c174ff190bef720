// What tiles showed, as they write it with --shown: a line for each swap.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace vindu::testing {

struct Swap {
  std::int64_t time_ns = 0;  ///< CLOCK_MONOTONIC
  std::string epoch;
  std::uint64_t frame = 0;
  std::string tile;
  std::string pixels;  ///< the number that the picture shows; empty: it cannot be read
  std::string eye_x_m;
  std::size_t locked = 0;  ///< tiles in the lock
  double mean_level = 0;   ///< of all pixels, 0 to 255
};

/// The whole lines so far; none while there is no file.
std::vector<Swap> swaps_in(const std::string& file);

/// A file that grows, read on from where the last look ended.
class SwapReader {
 public:
  explicit SwapReader(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  /// What came since the last call is at the end.
  const std::vector<Swap>& read();

 private:
  std::string file_;
  std::streamoff read_ = 0;
  std::vector<Swap> swaps_;
};

/// What is wrong: a swap whose pixels show another frame than it says, one that is not later than
/// the one before it (of one tile, master and file), a frame with two eyes. A sentence each.
std::vector<std::string> wrong_swaps(const std::vector<std::vector<Swap>>& files);

}  // namespace vindu::testing
