// What a run of the wall's master measured: frames, waits, skew of the swaps, and how long light
// takes from a tick.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cluster/wall_master.h"

namespace vindu::app {

class WallFigures {
 public:
  Duration length{};
  std::map<std::string, TileReport> tiles{};  ///< in the end

  void begun(Time now, std::optional<Duration> capture_age, Duration solve);
  void add(const FrameSkew& skew);
  void add(const MemberEvent& event);

  std::uint64_t frames() const { return frames_; }
  /// From a tick to the last tile's swap: a running mean.
  Duration to_light() const { return from_seconds(to_light_s_); }

  std::string table() const;
  std::string json() const;

 private:
  std::uint64_t frames_ = 0;
  std::map<std::uint64_t, Time> begun_;  // frames whose swaps are not known yet
  double to_light_s_ = 1 / 60.0;
  std::vector<double> skews_ms_, to_light_ms_, capture_ages_ms_, solves_ms_, gaps_ms_;
  std::optional<Time> last_begun_;
  std::map<MemberChange, std::uint64_t> changes_;
};

}  // namespace vindu::app
