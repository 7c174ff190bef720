// What a frame lock is worth, from when each tile had each frame ready and swapped to it: the skew
// of the swaps, what the barrier costs, and swaps that came before all tiles were ready.
#pragma once

#include <cstdint>
#include <vector>

namespace vindu {

/// Of one tile and frame, in ns of CLOCK_MONOTONIC; 0: it did not happen.
struct TileMark {
  std::int64_t ready_ns = 0;    ///< before it says so
  std::int64_t swapped_ns = 0;  ///< when it would call swap
};

struct FrameMarks {
  std::size_t locked = 0;  ///< tiles that the master waited for
  std::vector<TileMark> tiles;
};

/// Whether all tiles took part and have swapped.
bool whole(const FrameMarks& frame);

/// The last swap. Of a whole frame.
std::int64_t last_swap_ns(const FrameMarks& frame);

struct LockFigures {
  std::vector<double> skew_us;  ///< of each whole frame: from the first swap to the last
  std::vector<double> cost_us;  ///< of each whole frame: from the last tile ready to the last swap
  std::size_t frames = 0;       ///< whole or not
  std::size_t early = 0;        ///< whole, but a tile swapped before all were ready

  void add(const FrameMarks& frame);
};

}  // namespace vindu
