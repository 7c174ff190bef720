// The master's side of the frame lock: when all living tiles have drawn a frame it is released, and
// a tile that keeps the others waiting is left out until it has caught up. No clock, no network:
// who calls says what was heard and when.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cluster/messages.h"

namespace vindu {

struct BarrierOptions {
  FrameLock lock = FrameLock::barrier;
  /// How long the others wait for a tile: three times the running p95 of what tiles take from a
  /// frame's beginning to being ready, within these bounds.
  Duration least_patience = std::chrono::milliseconds(50);
  Duration most_patience = std::chrono::seconds(3);
  Duration first_patience = std::chrono::seconds(1);  ///< while nothing is known of what is usual
  /// FrameLock::timed: from the release to the swap; more than the message takes to all tiles.
  Duration timed_margin = std::chrono::milliseconds(3);
};

enum class MemberChange { admitted, loads, evicted, lost, restarted };

constexpr std::string_view name_of(MemberChange change) {
  constexpr std::string_view names[] = {"admitted", "loads", "evicted", "lost", "restarted"};
  return names[static_cast<int>(change)];
}

struct MemberEvent {
  std::string tile;
  MemberChange change{};
  std::uint64_t number = 0;  ///< of the frame at which it happened
  Duration waited{};         ///< evicted: how long the others waited
};

/// The running p95 of the last durations that it was told.
class UsualTime {
 public:
  void add(Duration duration);
  /// Empty with fewer than 20.
  std::optional<Duration> p95() const;

 private:
  static constexpr std::size_t kKept = 256;
  std::vector<Duration> last_;
  std::size_t next_ = 0;
};

class Barrier {
 public:
  /// `epoch`: of this master, not 0, larger than that of the one before. Only these tiles count.
  Barrier(std::uint64_t epoch, std::span<const std::string> tiles,
          const BarrierOptions& options = {});

  /// Whether the newest frame was released, so that the next may begin.
  bool open() const { return released_ == newest_.number; }

  /// The next frame; its number is given here. Tiles that have caught up take part from now on.
  /// Asserts open().
  void begin(FrameState state, std::uint64_t scene_revision, Time now);

  /// Whether a frame of that state would show what the newest does: tiles need not draw it.
  bool same_picture(const FrameState& state, std::uint64_t scene_revision) const;

  /// Returns whether the tile waits for a release that it seems not to have heard: the message
  /// should go out again.
  bool hear(const ReadyMessage& ready, Time now);

  /// A tile that has other things to do, or is done with them: nobody waits for it meanwhile.
  void set_busy(const std::string& tile, bool busy);

  /// A tile that is known to be gone or hung holds nobody up.
  void leave(const std::string& tile);

  /// Releases the newest frame if all are ready, or the time of those that are not is over. Returns
  /// whether it did.
  bool settle(Time now);

  /// When settle() will evict; Time::max() where nobody is waited for.
  Time deadline() const;

  /// What tiles have to be told now.
  FrameMessage message(Time now) const;

  bool takes_part(const std::string& tile) const;
  std::size_t active() const;
  Duration patience() const;

  /// Since the last call.
  std::vector<MemberEvent> take_events() { return std::exchange(events_, {}); }

 private:
  struct Member {
    std::uint64_t incarnation = 0;  // 0: never heard of
    std::uint64_t number = 0;       // newest frame that it has ready
    bool active = false;            // the others wait for it
    bool caught_up = false;         // active from the next frame on
    bool busy = false;              // never caught up
  };
  struct Begun {
    Time time{};
    bool drawn = true;  // else it is the picture before
  };

  Begun& begun(std::uint64_t number) { return begun_[number % kBegun]; }
  const Begun& begun(std::uint64_t number) const { return begun_[number % kBegun]; }
  std::optional<Duration> age(std::uint64_t number, Time now) const;
  void note(const std::string& tile, MemberChange change, Duration waited = {});
  void release(Time now);

  static constexpr std::size_t kBegun = 64;  // frames whose beginnings are remembered

  std::uint64_t epoch_;
  BarrierOptions options_;
  std::map<std::string, Member> members_;
  FrameState newest_;
  std::uint64_t scene_revision_ = 0;
  std::uint64_t released_ = 0;
  std::optional<Time> present_time_;
  std::array<Begun, kBegun> begun_{};  // by number modulo kBegun
  UsualTime usual_;
  std::vector<MemberEvent> events_;
};

}  // namespace vindu
