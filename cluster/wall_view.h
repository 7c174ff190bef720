// What a console knows of a running wall from what everybody on the bus hears: which tiles there
// are, what each of them does, and what is missing.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cluster/bus.h"
#include "cluster/roll.h"
#include "cluster/succession.h"

namespace vindu {

/// A tile as it is now.
struct TileNow {
  std::string name{};
  std::string state = "missing";          ///< or silent, gone, evicted, or a TileState's name
  StatusMessage last{};                   ///< the newest that it said
  std::optional<ReportMessage> report{};  ///< the master's newest about it
  int restarts = 0;                       ///< as the master counted, or since this console listens
  /// An older process for it, that still speaks.
  struct Twin {
    std::string host;
    std::uint32_t process;
  };
  std::optional<Twin> twin{};

  bool good() const;     ///< ready, and in the frame lock
  bool missing() const;  ///< nothing was ever heard of it
};

struct WallNow {
  std::optional<Participant> master{};
  std::uint64_t epoch = 0;
  std::uint64_t frame = 0;                ///< newest; 0: none was heard
  Pattern pattern = Pattern::none;        ///< of that frame
  bool blank = false;                     ///< the same
  bool touch_page = false;                ///< the same: it shows one
  double frames_per_s = 0;                ///< over the last seconds
  bool still = false;                     ///< what is seen has not changed for half a second
  std::uint32_t active_tiles = 0;         ///< in the frame lock
  std::optional<ReportMessage> report{};  ///< the master's newest about the whole wall
  std::vector<TileNow> tiles{};           ///< in the wall file's order
  std::vector<std::string> trackers{};
  std::vector<std::string> complaints{};  ///< about who is there (cluster/roll.h)

  /// Whose poses the wall follows; empty: no tracker's.
  std::string heard_tracker() const;
  /// A master, and all tiles ready.
  bool good() const;
};

/// Bound to one thread.
class WallView {
 public:
  static Topics hears() {
    return {Topic::tile_status, Topic::presence, Topic::frame, Topic::report};
  }

  /// `tiles`: names of those that should be there. `self`: who listens.
  WallView(const std::vector<std::string>& tiles, Participant self);

  /// Takes in what the bus, joined with these topics at least, has heard.
  void poll(Bus& bus, Time now);
  void hear(const StatusMessage& status, Time now);
  void hear(const Presence& presence);
  void hear(const FrameMessage& frame, Time now);
  void hear(const ReportMessage& report);

  const WallNow& now() const { return now_; }

 private:
  struct Beat {
    Time heard;
    std::uint64_t number;
  };

  TileNow* find(const std::string& tile);

  Roll roll_;
  std::map<std::string, Succession> processes_;  // by tile, as the next
  std::map<std::string, Time> twins_heard_;
  WallNow now_;
  std::deque<Beat> beats_;                          // of the last seconds, of one epoch
  std::pair<std::uint64_t, std::uint64_t> seen_{};  // hash and scene of the newest frame
  Time changed_{};                                  // when that was heard first
};

/// A table with a line for each kind of tile, equal ones folded, and lines for what is missing.
std::string table_of(const WallNow& wall);
/// The same in a few words: "28 ready, 59.9 fps".
std::string summary_of(const WallNow& wall);

}  // namespace vindu
