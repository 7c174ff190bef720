#include "bench/frame_lock/run.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <ctime>

#include "bench/frame_lock/process.h"
#include "core/error.h"

namespace vindu {
namespace {

double cpu_s(clockid_t clock) {
  timespec time{};
  return clock_gettime(clock, &time) == 0
             ? static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)
             : 0;
}

/// This program, as a tile.
std::vector<std::string> words_of_tile(const LockKind& kind, int tile, int sheet_file) {
  return {"/proc/self/exe", "tile", kind.name, std::to_string(tile), std::to_string(sheet_file)};
}

/// Tile processes; killed at the end of its scope.
class TileProcesses {
 public:
  TileProcesses(const LockKind& kind, const SharedSheet& sheet) {
    for (int tile = 0; tile < sheet->plan.tiles; ++tile)
      tiles_.emplace_back(words_of_tile(kind, tile, sheet.file()));
  }
  ~TileProcesses() {
    for (const Process& tile : tiles_) tile.send(SIGKILL);
  }
  TileProcesses(const TileProcesses&) = delete;
  TileProcesses& operator=(const TileProcesses&) = delete;

  double used_cpu_s() const {
    double sum_s = 0;
    for (const Process& tile : tiles_)
      if (clockid_t clock{}; clock_getcpuclockid(tile.id(), &clock) == 0) sum_s += cpu_s(clock);
    return sum_s;
  }

 private:
  std::vector<Process> tiles_;
};

/// What the master is asked for while it runs: has everybody come, and is it enough?
class Watch {
 public:
  Watch(Sheet& sheet, const TileProcesses& tiles, const RunLength& length)
      : sheet_(sheet), tiles_(tiles), length_(length), started_(clock_.now()) {}

  bool go_on(std::uint64_t begun) {
    if (first_whole_ == 0 && !look_for_whole(begun)) return true;
    if (begun >= from() && !before_) before_ = used();
    if (begun < to()) return true;
    after_ = used();
    return false;
  }

  std::uint64_t first_whole() const { return first_whole_; }
  /// The frames that count: to() is the first that does not.
  std::uint64_t from() const { return first_whole_ + length_.warm_up; }
  std::uint64_t to() const { return from() + length_.frames; }
  double master_cores() const { return (after_.master_s - before_->master_s) / length_s(); }
  double tiles_cores() const { return (after_.tiles_s - before_->tiles_s) / length_s(); }

 private:
  struct Used {
    Time time{};
    double master_s = 0, tiles_s = 0;
  };

  bool look_for_whole(std::uint64_t begun) {
    constexpr std::uint64_t kSwapping = 4;  // frames that may not be swapped everywhere yet
    for (; looked_ < begun; ++looked_) {
      if (whole(sheet_.frame(looked_))) {
        first_whole_ = looked_;
        return true;
      }
      if (looked_ + kSwapping >= begun) break;
    }
    if (clock_.now() - started_ > std::chrono::seconds(30))
      throw Error({fmt::format("{} tiles did not come together in 30 s", sheet_.plan.tiles),
                   fmt::format("frame {}", begun),
                   "ask for fewer, on a machine that is less busy"});
    return false;
  }
  Used used() const { return {clock_.now(), cpu_s(CLOCK_PROCESS_CPUTIME_ID), tiles_.used_cpu_s()}; }
  double length_s() const { return seconds(after_.time - before_->time); }

  MonotonicClock clock_;
  Sheet& sheet_;
  const TileProcesses& tiles_;
  RunLength length_;
  Time started_;
  std::uint64_t looked_ = 1, first_whole_ = 0;
  std::optional<Used> before_;
  Used after_;
};

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void LockResult::add(const LockResult& other) {
  append(figures.skew_us, other.figures.skew_us);
  append(figures.cost_us, other.figures.cost_us);
  figures.frames += other.figures.frames;
  figures.early += other.figures.early;
  append(start_ms, other.start_ms);
  append(master_cores, other.master_cores);
  append(tiles_cores, other.tiles_cores);
  evictions += other.evictions;
  wrong += other.wrong;
}

LockResult run_lock(const LockKind& kind, const LockPlan& plan, const RunLength& length) {
  MonotonicClock clock;
  const SharedSheet sheet(plan);
  const Time started = clock.now();
  const TileProcesses tiles(kind, sheet);
  Watch watch(*sheet, tiles, length);
  kind.master(*sheet, [&](std::uint64_t begun) { return watch.go_on(begun); });
  clock.sleep_until(clock.now() + std::chrono::milliseconds(50));  // for the last swaps
  LockResult result;
  for (std::uint64_t number = watch.from(); number < watch.to(); ++number)
    result.figures.add(sheet->frame(number));
  const std::int64_t first_ns = last_swap_ns(sheet->frame(watch.first_whole()));
  result.start_ms = {1e-6 * static_cast<double>(first_ns - Sheet::ns(started))};
  result.master_cores = {watch.master_cores()};
  result.tiles_cores = {watch.tiles_cores()};
  result.evictions = sheet->evictions;
  result.wrong = sheet->wrong_swaps + result.figures.early;
  return result;
}

void play_tile(const std::string& kind, int tile, int sheet_file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const SharedSheet sheet(sheet_file);
  if (getppid() != sheet->plan.parent) return;
  (kind == kBusLock.name ? kBusLock : kUdpLock).tile(*sheet, tile);
}

}  // namespace vindu
