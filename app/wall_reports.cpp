#include "app/wall_reports.h"

#include <fmt/format.h>

#include <algorithm>

namespace vindu::app {

WallReports::WallReports(const std::vector<std::string>& tiles) {
  subjects_.push_back({.tile = ""});
  for (const std::string& tile : tiles) subjects_.push_back({.tile = tile});
}

WallReports::Subject& WallReports::of(const std::string& tile) {
  const auto found = std::ranges::find(subjects_, tile, &Subject::tile);
  return found == subjects_.end() ? subjects_.front() : *found;
}

void WallReports::add(const FrameSkew& frame, const FrameOrigin& origin, Duration display,
                      Time now) {
  const auto parts = [&](const TileSwap& swap) {
    return parts_of(origin, swap.parts, swap.shown, display);
  };
  subjects_.front().tally.add(now, parts(frame.last()), frame.skew());
  for (const TileSwap& swap : frame.swaps)
    of(swap.tile).tally.add(now, parts(swap), swap.shown - frame.swaps.front().shown);
}

void WallReports::add(const MemberEvent& event) {
  const auto note = [&](Subject& subject) {
    subject.evictions += event.change == MemberChange::evicted;
    subject.restarts += event.change == MemberChange::restarted;
    subject.event =
        fmt::format("{}: {} at frame {}", event.tile, name_of(event.change), event.number);
  };
  note(subjects_.front());
  if (Subject& tile = of(event.tile); !tile.tile.empty()) note(tile);
}

std::optional<ReportMessage> WallReports::next(Time now,
                                               const std::map<std::string, TileReport>& tiles) {
  const Duration turn = std::chrono::nanoseconds(std::chrono::seconds(1)) / subjects_.size();
  if (now - said_ < turn) return std::nullopt;
  said_ = now;
  Subject& subject = subjects_[next_++ % subjects_.size()];
  ReportMessage report{.tile = subject.tile,
                       .frames = subject.tally.summary(now),
                       .evictions = subject.evictions,
                       .restarts = subject.restarts,
                       .level = level_.value_or(TrackingLevel::lost),
                       .event = subject.event};
  for (const auto& [name, tile] : tiles)
    report.locked += tile.locked && (subject.tile.empty() || subject.tile == name);
  return report;
}

}  // namespace vindu::app
