// One run of a lock: tile processes are started, the first frame in which all take part is waited
// for, and after a while the frames that count are taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/frame_lock/locks.h"

namespace vindu {

struct RunLength {
  std::uint64_t warm_up = 30;  ///< frames after the first with all tiles that do not count
  std::uint64_t frames = 120;
};

/// Of one run, or of several that were added up.
struct LockResult {
  LockFigures figures;
  std::vector<double> start_ms;  ///< from the first fork to the last swap of the first whole frame
  std::vector<double> master_cores;  ///< CPU time over time, while frames count
  std::vector<double> tiles_cores;   ///< of all tiles together
  std::uint64_t evictions = 0;
  std::uint64_t wrong = 0;  ///< swaps out of order, and frames with a swap before all were ready

  void add(const LockResult& other);
};

/// Throws Error where the tiles do not come together within half a minute.
LockResult run_lock(const LockKind& kind, const LockPlan& plan, const RunLength& length);

/// In the process of a tile. Never returns; ends when its master does.
void play_tile(const std::string& kind, int tile, int sheet_file);

}  // namespace vindu
