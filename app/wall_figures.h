// What a run of the wall's master measured: frames, the parts of motion to photon, and skew of the
// swaps; at the end as a table, while it runs as reports to all and as lines of a file.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/frame_csv.h"
#include "app/run_spread.h"
#include "app/wall_reports.h"
#include "cluster/wall_master.h"

namespace vindu::app {

class WallFigures {
 public:
  Duration length{};
  std::map<std::string, TileReport> tiles{};  ///< in the end

  /// `display`: from a swap to the light. `csv_file`: empty: none; throws Error when it cannot be
  /// written.
  WallFigures(const std::vector<std::string>& names, Duration display, const std::string& csv_file);

  /// What a frame is of.
  struct Kind {
    std::optional<TrackingLevel> level{};  ///< of the head that the eye is of; empty: none is
    bool drawn = true;                     ///< else it shows what was shown before
  };
  void begun(const FrameOrigin& origin, const Kind& kind);
  /// A tick began no frame, since nothing had changed.
  void rested() { last_begun_.reset(); }
  void add(const FrameSkew& skew, Time now);
  void add(const MemberEvent& event);
  /// What to tell everybody now, if anything.
  std::optional<ReportMessage> report(Time now,
                                      const std::map<std::string, TileReport>& tiles_now) {
    return reports_.next(now, tiles_now);
  }
  /// Frames of which nothing more will be heard.
  void end() { forget_before(frames_ + 1); }

  std::uint64_t frames() const { return frames_; }
  /// Whether any tile showed one.
  bool shown() const { return shown_; }
  /// From a tick to the last tile's swap: a running mean.
  Duration to_light() const { return from_seconds(to_light_s_); }

  std::string table() const;
  std::string json() const;

 private:
  struct Begun {
    FrameOrigin origin{};
    Kind kind{};
  };

  void forget_before(std::uint64_t number);
  void write(std::uint64_t number, const Begun& begun, const FrameSkew* skew);

  Duration display_;
  std::optional<FrameCsv> csv_;
  WallReports reports_;
  std::uint64_t frames_ = 0;
  std::uint64_t undrawn_ = 0;
  bool shown_ = false;
  std::map<std::uint64_t, Begun> begun_;  // frames whose swaps are not known yet
  double to_light_s_ = 1 / 60.0;
  RunSpread skews_ms_, to_light_ms_, to_photon_ms_, gaps_ms_;
  std::array<RunSpread, kParts> parts_ms_;
  std::optional<Time> last_begun_;
  std::map<MemberChange, std::uint64_t> changes_;
};

}  // namespace vindu::app
