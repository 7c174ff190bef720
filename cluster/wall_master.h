// The master on the bus: frames out, what tiles say in, the frame lock between them, and scenes
// that all tiles change to in one frame. It never waits: who calls asks when to come back.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cluster/barrier.h"
#include "cluster/bus.h"
#include "cluster/clock_offset.h"
#include "cluster/repeats.h"
#include "cluster/roll.h"
#include "cluster/succession.h"

namespace vindu {

/// What the master knows of a tile.
struct TileReport {
  std::optional<StatusMessage> status{};  ///< empty: never heard of
  bool present = false;
  bool locked = false;  ///< the others wait for it
  Duration draw_time{};
  std::optional<OffsetEstimate> clock{};  ///< the tile's, against the master's
};

/// A tile's swap.
struct TileSwap {
  std::string tile{};
  Time shown{};  ///< on the master's clock
  TileParts parts{};
};

/// The swaps of one frame, over tiles.
struct FrameSkew {
  std::uint64_t number = 0;
  std::vector<TileSwap> swaps{};  ///< the first one first; at least one
  Duration uncertainty{};         ///< of the clocks; 0 where all tiles are on the master's host

  const TileSwap& last() const { return swaps.back(); }
  Duration skew() const { return last().shown - swaps.front().shown; }
};

class WallMaster {
 public:
  static Topics publishes() { return {Topic::frame, Topic::scene, Topic::report}; }
  static Topics hears() { return {Topic::ready, Topic::tile_status, Topic::presence}; }

  struct Options {
    std::uint64_t epoch = 0;  ///< not 0, and larger than that of the master before
    Participant self{};       ///< tiles on its host share its clock
    std::vector<std::string> tiles{};
    BarrierOptions barrier{};
  };

  /// The bus, joined with these topics at least, must outlive it.
  WallMaster(Bus& bus, Options options);

  /// Takes in what was heard; releases, evicts, and says again what a tile seems to have missed.
  void poll(Time now);

  /// When poll() has something to do though nothing is heard.
  Time wake_time() const;

  /// Whether the next frame may begin.
  bool open() const { return barrier_.open(); }
  /// Whether a frame of that state would look as the newest does.
  bool shows(const FrameState& state) const { return barrier_.same_picture(state, shown_scene_); }
  /// Whether a frame of that state is to begin now: it looks otherwise than the newest, or tiles
  /// are coming and going, or the last one is half a second ago, so that who is late gets in and
  /// who is gone is noticed.
  bool due(const FrameState& state, Time now) const;
  void begin(const FrameState& state, Time now, const FrameOrigin& origin = {});

  /// Tiles load it, and change to it in one frame when none is left that still loads. A scene that
  /// was asked for before and not shown yet is given up.
  /// Returns its revision.
  std::uint64_t show(const std::string& path, const std::string& sha256, Placement placement);
  /// Tiles that the change waits for.
  std::vector<std::string> loading() const;
  std::uint64_t shown_scene() const { return shown_scene_; }

  /// What the master measured, to all who want to know; the epoch is given here.
  void report(ReportMessage report);

  const std::map<std::string, TileReport>& tiles() const { return tiles_; }
  std::vector<MemberEvent> take_events() { return barrier_.take_events(); }
  /// Of frames whose tiles have all reported, or that are too old to wait for more.
  std::vector<FrameSkew> take_skews();
  std::size_t active() const { return barrier_.active(); }
  /// Another one of this wall that was on the bus before this one; of both that say when they came.
  std::optional<Participant> older_master() const;
  /// The number of the newest frame; 0: none was begun.
  std::uint64_t newest() const { return newest_; }

 private:
  bool hear(const ReadyMessage& ready, Time now);  ///< whether it has to be answered
  void hear(const StatusMessage& status, Time now);
  void hear(const Presence& presence, Time now);
  bool speaks_for(const std::string& tile, std::uint64_t incarnation, Time now);
  void warn_once(const std::string& tile, const std::string& what);
  void complain();
  void note_swap(const ReadyMessage& ready, TileReport& report);
  void change_scene();
  void publish(Time now);
  void repeat(Time now);
  void send(Time now);
  Time repeat_time() const;

  Bus& bus_;
  Options options_;
  Barrier barrier_;
  Roll roll_;
  std::vector<std::string> complaints_;  // that were told
  std::map<std::string, TileReport> tiles_;
  std::map<std::string, Succession> processes_;  // by tile
  std::set<std::string> warned_of_;              // tiles that run twice, or that are not the wall's
  std::map<std::string, ClockOffset> clocks_;
  std::map<std::string, std::uint64_t>
      shown_;                                 // newest frame that each tile has said to have shown
  std::map<std::uint64_t, FrameSkew> swaps_;  // by frame
  std::uint64_t asked_scene_, shown_scene_;   // from the epoch on: no two masters' are alike
  std::uint64_t newest_ = 0;
  FrameOrigin origin_;  // of the newest
  Repeats repeats_;
  Time published_{}, begun_{};
  Time stirred_{};          // when something last changed: what is seen, or who sees it
  std::size_t active_ = 0;  // when it was last looked at
};

}  // namespace vindu
