// What the master tells everybody about the wall and each tile, one after the other within a
// second: parts and skew of the last seconds' frames, and how often tiles were left out or came
// back.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cluster/wall_master.h"
#include "core/frame_tally.h"

namespace vindu::app {

class WallReports {
 public:
  explicit WallReports(const std::vector<std::string>& tiles);

  void add(const FrameSkew& frame, const FrameOrigin& origin, Duration display, Time now);
  void add(const MemberEvent& event);
  void follows(std::optional<TrackingLevel> level) { level_ = level; }

  /// The next one, when it is due.
  std::optional<ReportMessage> next(Time now, const std::map<std::string, TileReport>& tiles);

 private:
  struct Subject {
    std::string tile;  // empty: the whole wall
    FrameTally tally{};
    std::uint32_t evictions = 0, restarts = 0;
    std::string event{};
  };

  Subject& of(const std::string& tile);

  std::vector<Subject> subjects_;  // the wall first
  std::size_t next_ = 0;
  Time said_{};
  std::optional<TrackingLevel> level_;
};

}  // namespace vindu::app
