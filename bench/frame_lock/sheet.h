// What a bench's master and its tile processes know of each other beside what they say: the run's
// plan, and when each tile had each frame ready and swapped to it, in memory that they share.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <string>

#include "bench/frame_lock/figures.h"
#include "core/clock.h"
#include "core/random.h"

namespace vindu {

constexpr int kMostTiles = 64;
constexpr std::uint64_t kMostFrames = 1 << 14;  // four and a half minutes

/// One run of one lock.
struct LockPlan {
  char wall[48] = {};      ///< a name that no other wall has
  std::uint16_t port = 0;  ///< of the raw UDP lock's group
  pid_t parent = 0;
  int tiles = 1;
  double rate_hz = 60;
  double least_draw_ms = 8, most_draw_ms = 12;
  std::uint64_t seed = 1;
};

/// All zero at first. Marks are by tile, so that no two processes write to one cache line.
struct Sheet {
  LockPlan plan;
  std::uint64_t wrong_swaps;  ///< to a frame that is not newer than the one before
  std::uint64_t evictions;
  std::uint64_t locked[kMostFrames];
  TileMark marks[kMostTiles][kMostFrames];

  void release(std::uint64_t number, std::size_t tiles) {
    std::atomic_ref(locked[number % kMostFrames]).store(tiles);
  }
  void ready(int tile, std::uint64_t number, Time now) {
    std::atomic_ref(marks[tile][number % kMostFrames].ready_ns).store(ns(now));
  }
  void swapped(int tile, std::uint64_t number, Time now) {
    std::atomic_ref(marks[tile][number % kMostFrames].swapped_ns).store(ns(now));
  }
  void wrong() { ++std::atomic_ref(wrong_swaps); }

  FrameMarks frame(std::uint64_t number);

  static std::int64_t ns(Time time) { return Duration(time.time_since_epoch()).count(); }
};

/// The mapping of a sheet: of a new one, or of the one that a parent process handed on.
class SharedSheet {
 public:
  explicit SharedSheet(const LockPlan& plan);
  explicit SharedSheet(int file);
  ~SharedSheet();
  SharedSheet(const SharedSheet&) = delete;
  SharedSheet& operator=(const SharedSheet&) = delete;

  int file() const { return file_; }
  Sheet& operator*() const { return *sheet_; }
  Sheet* operator->() const { return sheet_; }

 private:
  void map();
  int file_;
  Sheet* sheet_ = nullptr;
};

/// Drawing as it is played: a sleep, as long in every lock, of a length that the seed draws.
class PlayedDrawing {
 public:
  PlayedDrawing(const LockPlan& plan, int tile)
      : plan_(plan), random_(plan.seed * kMostTiles + static_cast<std::uint64_t>(tile)) {}
  void draw() {
    const double length_ms = random_.uniform(plan_.least_draw_ms, plan_.most_draw_ms);
    if (length_ms > 0) clock_.sleep_until(clock_.now() + from_seconds(1e-3 * length_ms));
  }

 private:
  LockPlan plan_;
  Random random_;
  MonotonicClock clock_;
};

/// Ticks of a rate; one that cannot be kept is skipped.
class Ticks {
 public:
  Ticks(Time start, double rate_hz) : start_(start), next_(start), rate_hz_(rate_hz) {}
  Time next() const { return next_; }
  void pass(Time now) {
    const auto passed = static_cast<std::int64_t>(seconds(now - start_) * rate_hz_ + 1e-6);
    next_ = start_ + from_seconds(static_cast<double>(passed + 1) / rate_hz_);
  }

 private:
  Time start_, next_;
  double rate_hz_;
};

}  // namespace vindu
