#include "cluster/wall_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "cluster/launch/node_set.h"

namespace vindu {
namespace {

constexpr auto kBeats = std::chrono::seconds(2);
constexpr auto kStill = std::chrono::milliseconds(500);
constexpr auto kTwin = std::chrono::seconds(1);  // after its last word it is gone
constexpr const char* kMissing = "missing";      // as a TileNow begins
constexpr const char* kEvicted = "evicted";

/// A tile that says ready does not know that the others no longer wait for it; the master does.
void mark_evicted(TileNow& tile) {
  if (tile.state != name_of(TileState::ready) && tile.state != kEvicted) return;
  const bool evicted = tile.report && tile.report->locked == 0 && tile.report->evictions > 0;
  tile.state = evicted ? kEvicted : name_of(TileState::ready);
}

/// Tiles that differ in figures alone.
struct Group {
  std::vector<std::string> names;
  std::vector<const TileNow*> tiles;
};

/// "1201-1204"; a dash for a tile that has never said anything.
template <class Get>
std::string span_of(const Group& group, Get get) {
  if (group.tiles.front()->last.incarnation == 0) return "-";
  const auto [first, last] = std::ranges::minmax(group.tiles, {}, get);
  const auto least = get(first), most = get(last);
  return least == most ? fmt::format("{}", least) : fmt::format("{}-{}", least, most);
}

/// "0.21-0.43", of those that know; a dash where nobody does.
template <class Get>
std::string ms_span_of(const Group& group, int digits, Get get) {
  double least = 0, most = 0;
  bool known = false;
  for (const TileNow* tile : group.tiles) {
    const std::optional<double> value_ms = get(*tile);
    if (!value_ms) continue;
    least = known ? std::min(least, *value_ms) : *value_ms;
    most = known ? std::max(most, *value_ms) : *value_ms;
    known = true;
  }
  if (!known) return "-";
  const std::string low = fmt::format("{:.{}f}", least, digits),
                    high = fmt::format("{:.{}f}", most, digits);
  return low == high ? low : low + "-" + high;
}

std::optional<double> gpu_ms(const TileNow& tile) {
  return tile.last.draw.gpu_ms > 0 ? std::optional(tile.last.draw.gpu_ms) : std::nullopt;
}

std::optional<double> skew_ms(const TileNow& tile) {
  if (!tile.report || tile.report->frames.frames == 0) return std::nullopt;
  return tile.report->frames.skew_ms.p99;
}

using Row = std::array<std::string, 9>;

Row row_of(const Group& group) {
  return {fold_names(group.names),
          group.tiles.front()->state,
          span_of(group, [](const TileNow* tile) { return tile->last.presented; }),
          span_of(group, [](const TileNow* tile) { return std::lround(tile->last.frames_per_s); }),
          ms_span_of(group, 1, gpu_ms),
          ms_span_of(group, 2, skew_ms),
          span_of(group, [](const TileNow* tile) { return tile->last.late_frames; }),
          span_of(group, [](const TileNow* tile) { return tile->restarts; }),
          group.tiles.front()->last.error};
}

std::vector<Row> rows_of(const WallNow& wall) {
  std::map<std::tuple<bool, std::string, std::string>, Group> groups;  // bad ones first
  for (const TileNow& tile : wall.tiles) {
    Group& group = groups[{tile.good(), tile.state, tile.last.error}];
    group.names.push_back(tile.name);
    group.tiles.push_back(&tile);
  }
  std::vector<Row> rows{
      {"TILES", "STATE", "FRAME", "FPS", "GPU ms", "SKEW ms", "LATE", "RESTARTS", "LAST ERROR"}};
  for (const auto& [key, group] : groups) rows.push_back(row_of(group));
  return rows;
}

std::string text_of(const std::vector<Row>& rows) {
  std::array<std::size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += fmt::format("{:<{}}", row[i], widths[i] + 2);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// "27 of 28". A master with another wall file may have more.
std::string locked_of(const WallNow& wall) {
  if (wall.active_tiles > wall.tiles.size()) return std::to_string(wall.active_tiles);
  return fmt::format("{} of {}", wall.active_tiles, wall.tiles.size());
}

std::string master_line(const WallNow& wall) {
  if (!wall.master) return "no master\n";
  std::string text = "master on " + wall.master->host;
  if (wall.frame == 0) return text + ", no frame yet\n";
  text +=
      fmt::format(": frame {}, {:.1f} fps{}, {} tiles in the frame lock", wall.frame,
                  wall.frames_per_s, wall.still ? " since nothing changes" : "", locked_of(wall));
  if (wall.report && wall.report->frames.tracked)
    text += fmt::format(", eye {}", name_of(wall.report->level));
  if (wall.pattern != Pattern::none) text += fmt::format(", pattern {}", name_of(wall.pattern));
  if (wall.blank) text += ", blank";
  if (wall.touch_page) text += ", points to be touched";
  return text + "\n";
}

std::string quantiles_text(const char* what, const Quantiles& ms, int digits) {
  return fmt::format("  {:<17}{:>8.{}f}{:>8.{}f}{:>8.{}f} ms\n", what, ms.p50, digits, ms.p99,
                     digits, ms.max, digits);
}

/// What the master measured over the last seconds: skew, and motion to photon with its parts.
std::string report_text(const WallNow& wall) {
  if (!wall.master || !wall.report || wall.report->frames.frames == 0) return "";
  const FrameSummary& frames = wall.report->frames;
  std::string text = fmt::format("  {:<17}{:>8}{:>8}{:>8}\n", "", "p50", "p99", "max");
  text += quantiles_text("skew of swaps", frames.skew_ms, 2);
  text += quantiles_text(frames.tracked ? "motion to photon" : "tick to photon",
                         frames.motion_to_photon_ms, 1);
  text += "  mean of parts:";
  for (int i = frames.tracked ? 0 : 1; i < kParts; ++i)
    text += fmt::format("{} {} {:.1f}", i > (frames.tracked ? 0 : 1) ? "," : "",
                        name_of(static_cast<Part>(i)), frames.mean_ms[static_cast<std::size_t>(i)]);
  return text + " ms\n";
}

/// They may have been given up, which nobody on the bus hears of.
std::string missing_text(const WallNow& wall) {
  std::vector<std::string> names;
  for (const TileNow& tile : wall.tiles)
    if (tile.missing()) names.push_back(tile.name);
  if (!wall.master || names.empty()) return "";
  return fold_names(names) +
         ": no word; see its lines (vindu logs; of a wall on one machine, where vindu launch "
         "runs)\n";
}

}  // namespace

bool WallNow::good() const {
  return master && complaints.empty() && std::ranges::all_of(tiles, &TileNow::good);
}

std::string WallNow::heard_tracker() const { return master && report ? report->tracker : ""; }

bool TileNow::missing() const { return state == TileNow{}.state; }

bool TileNow::good() const { return state == name_of(TileState::ready) && !twin; }

WallView::WallView(const std::vector<std::string>& tiles, Participant self)
    : roll_(std::move(self)) {
  for (const std::string& tile : tiles) now_.tiles.push_back({.name = tile});
}

void WallView::poll(Bus& bus, Time now) {
  for (const Presence& presence : bus.take<Presence>()) hear(presence);
  for (const StatusMessage& status : bus.take<StatusMessage>()) hear(status, now);
  for (const FrameMessage& frame : bus.take<FrameMessage>()) hear(frame, now);
  for (const ReportMessage& report : bus.take<ReportMessage>()) hear(report);
  for (TileNow& tile : now_.tiles)
    if (now - twins_heard_[tile.name] > kTwin) tile.twin.reset();
}

TileNow* WallView::find(const std::string& tile) {
  const auto found = std::ranges::find(now_.tiles, tile, &TileNow::name);
  return found == now_.tiles.end() ? nullptr : &*found;
}

void WallView::hear(const StatusMessage& status, Time now) {
  TileNow* const tile = find(status.tile);
  if (!tile) return;
  const Succession::Voice voice = processes_[status.tile].hear(status.incarnation, now);
  if (voice == Succession::Voice::twin) {
    tile->twin = {status.host, status.process};
    twins_heard_[status.tile] = now;
    return;
  }
  tile->restarts += voice == Succession::Voice::successor;
  tile->last = status;
  tile->state = name_of(status.state);
  mark_evicted(*tile);
}

void WallView::hear(const Presence& presence) {
  const bool gone = presence.change == PresenceChange::left;
  roll_.hear(presence);
  now_.master = roll_.master();
  now_.trackers = roll_.trackers();
  now_.complaints = roll_.complaints();
  TileNow* const tile = presence.who.role == Role::tile ? find(presence.who.name) : nullptr;
  if (tile && gone) tile->state = "gone";
  if (tile && presence.change == PresenceChange::silent) tile->state = "silent";
}

void WallView::hear(const FrameMessage& frame, Time now) {
  if (frame.epoch < now_.epoch) return;
  if (frame.epoch > now_.epoch) beats_.clear();
  now_.epoch = frame.epoch;
  now_.frame = frame.newest.number;
  now_.pattern = frame.newest.pattern;
  now_.blank = frame.newest.blank;
  now_.touch_page = frame.newest.touch_page.has_value();
  now_.active_tiles = frame.active_tiles;
  const std::pair seen(content_hash_of(frame.newest), frame.scene_revision);
  if (std::exchange(seen_, seen) != seen) changed_ = now;
  now_.still = now - changed_ >= kStill;
  beats_.push_back({now, frame.newest.number});
  while (now - beats_.front().heard > kBeats) beats_.pop_front();
  const double passed_s = seconds(now - beats_.front().heard);
  if (passed_s > 0)
    now_.frames_per_s = static_cast<double>(now_.frame - beats_.front().number) / passed_s;
}

void WallView::hear(const ReportMessage& report) {
  if (report.epoch < now_.epoch) return;  // of a master that was replaced
  if (report.tile.empty()) now_.report = report;
  TileNow* const tile = find(report.tile);
  if (!tile) return;
  tile->report = report;
  tile->restarts = std::max(tile->restarts, static_cast<int>(report.restarts));
  mark_evicted(*tile);
}

std::string table_of(const WallNow& wall) {
  std::string text = master_line(wall) + report_text(wall) + text_of(rows_of(wall));
  const std::string heard = wall.heard_tracker();
  for (const std::string& tracker : wall.trackers)
    text += tracker + (tracker == heard ? " is heard\n"
                       : heard.empty()  ? " is there\n"
                                        : " is in reserve\n");
  for (const TileNow& tile : wall.tiles)
    if (tile.twin)
      text += fmt::format("{} runs twice, as process {} on {} and {} on {}: end one of them\n",
                          tile.name, tile.twin->process, tile.twin->host, tile.last.process,
                          tile.last.host);
  for (const std::string& complaint : wall.complaints) text += complaint + "\n";
  return text + missing_text(wall);
}

std::string summary_of(const WallNow& wall) {
  if (!wall.master) return "no master";
  std::map<std::string, int> counts;
  for (const TileNow& tile : wall.tiles) ++counts[tile.state];
  std::string text;
  for (const auto& [state, count] : counts) text += fmt::format("{} {}, ", count, state);
  return text + fmt::format("{:.1f} fps{}", wall.frames_per_s, wall.still ? ", still" : "");
}

}  // namespace vindu
