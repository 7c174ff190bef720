#include "cluster/wall_master.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/log.h"

namespace vindu {
namespace {

/// While nothing changes: how often the newest frame is said again, for who has just started; and
/// how often there is a new one.
constexpr Duration kHeartbeat = std::chrono::milliseconds(100);
constexpr Duration kStillFrame = std::chrono::milliseconds(500);
/// Every tick begins a frame for so long after a change.
constexpr Duration kSettling = std::chrono::milliseconds(500);

}  // namespace

WallMaster::WallMaster(Bus& bus, Options options)
    : bus_(bus),
      options_(std::move(options)),
      barrier_(options_.epoch, options_.tiles, options_.barrier),
      roll_(options_.self),
      asked_scene_(options_.epoch),
      shown_scene_(options_.epoch) {
  for (const std::string& tile : options_.tiles) tiles_[tile];
}

void WallMaster::poll(Time now) {
  for (const Presence& presence : bus_.take<Presence>()) hear(presence, now);
  for (const StatusMessage& status : bus_.take<StatusMessage>()) hear(status, now);
  bool news = false;  // for all who asked, or wait, one message
  for (const ReadyMessage& ready : bus_.take<ReadyMessage>()) news |= hear(ready, now);
  news |= barrier_.settle(now);
  if (news) publish(now);
  if (newest_ > 0 && now >= repeat_time()) repeat(now);
  for (auto& [tile, report] : tiles_) report.locked = barrier_.takes_part(tile);
  if (std::exchange(active_, barrier_.active()) != barrier_.active()) stirred_ = now;
  change_scene();
}

Time WallMaster::repeat_time() const {
  return barrier_.open() ? published_ + kHeartbeat : repeats_.due();
}

Time WallMaster::wake_time() const {
  return newest_ == 0 ? Time::max() : std::min(barrier_.deadline(), repeat_time());
}

bool WallMaster::due(const FrameState& state, Time now) const {
  return now - stirred_ < kSettling || now - begun_ >= kStillFrame || !shows(state);
}

void WallMaster::begin(const FrameState& state, Time now, const FrameOrigin& origin) {
  origin_ = origin;
  if (!shows(state)) stirred_ = now;
  begun_ = now;
  barrier_.begin(state, shown_scene_, now);
  ++newest_;
  barrier_.settle(now);  // with nobody to wait for
  publish(now);
}

void WallMaster::report(ReportMessage report) {
  report.epoch = options_.epoch;
  bus_.publish(report);
}

void WallMaster::publish(Time now) {
  repeats_.said(now);
  send(now);
}

void WallMaster::repeat(Time now) {
  repeats_.said_again(now);
  send(now);
}

void WallMaster::send(Time now) {
  FrameMessage message = barrier_.message(now);
  message.origin = origin_;
  bus_.publish(message);
  published_ = now;
}

bool WallMaster::hear(const ReadyMessage& ready, Time now) {
  const auto found = tiles_.find(ready.tile);
  if (found == tiles_.end() || ready.epoch != options_.epoch ||
      !speaks_for(ready.tile, ready.incarnation, now))
    return false;
  TileReport& report = found->second;
  if (!report.locked) stirred_ = now;  // it wants to come in
  report.draw_time = ready.draw_time;
  if (report.status && report.status->host == options_.self.host) {
    report.clock = OffsetEstimate{};
  } else {
    ClockOffset& clock = clocks_[ready.tile];
    clock.add({.sent_here = ready.frame_sent_time,
               .received_there = ready.frame_received_time,
               .sent_there = ready.sent_time,
               .received_here = now});
    report.clock = clock.at(now);
  }
  note_swap(ready, report);
  return barrier_.hear(ready, now);
}

void WallMaster::note_swap(const ReadyMessage& ready, TileReport& report) {
  std::uint64_t& shown = shown_[ready.tile];
  if (ready.presented == shown || ready.presented == 0 || ready.presented > newest_) return;
  shown = ready.presented;
  if (!report.clock || !report.locked) return;
  const Time time = ready.presented_time - report.clock->offset;
  FrameSkew& frame = swaps_[ready.presented];
  frame.number = ready.presented;
  frame.uncertainty = std::max(frame.uncertainty, report.clock->uncertainty);
  const auto later = std::ranges::upper_bound(frame.swaps, time, {}, &TileSwap::shown);
  frame.swaps.insert(later, {ready.tile, time, ready.presented_parts});
}

std::vector<FrameSkew> WallMaster::take_skews() {
  constexpr std::uint64_t kLate = 8;  // frames later nobody reports any more
  std::vector<FrameSkew> skews;
  while (!swaps_.empty() && (swaps_.begin()->first + kLate < newest_ ||
                             swaps_.begin()->second.swaps.size() >= barrier_.active())) {
    skews.push_back(std::move(swaps_.begin()->second));
    swaps_.erase(swaps_.begin());
  }
  return skews;
}

/// Else it is a process in whose place there is another.
bool WallMaster::speaks_for(const std::string& tile, std::uint64_t incarnation, Time now) {
  const Succession::Voice voice = processes_[tile].hear(incarnation, now);
  if (voice == Succession::Voice::successor) warned_of_.erase(tile);
  return voice != Succession::Voice::twin;
}

void WallMaster::warn_once(const std::string& tile, const std::string& what) {
  constexpr std::size_t kMostWarnings = 256;  // names come from the network
  if (warned_of_.size() < kMostWarnings && warned_of_.insert(tile).second) log_warning(tile, what);
}

std::optional<Participant> WallMaster::older_master() const {
  const std::uint64_t own = options_.self.epoch;
  for (const Participant& other : roll_.masters())
    if (other.epoch != 0 && other.epoch < own) return other;
  return std::nullopt;
}

/// What is new of what is wrong about who is there.
void WallMaster::complain() {
  std::vector<std::string> lines = roll_.complaints();
  for (const std::string& line : lines)
    if (std::ranges::find(complaints_, line) == complaints_.end()) log_warning("wall", line);
  complaints_ = std::move(lines);
}

void WallMaster::hear(const StatusMessage& status, Time now) {
  const auto found = tiles_.find(status.tile);
  if (found == tiles_.end()) return warn_once(status.tile, "is no tile of this wall: left out");
  if (!speaks_for(status.tile, status.incarnation, now)) {
    const StatusMessage followed = found->second.status.value_or(StatusMessage{});
    return warn_once(status.tile,
                     fmt::format("runs twice, as process {} on {} and {} on {}: end one of them",
                                 status.process, status.host, followed.process, followed.host));
  }
  const std::optional<StatusMessage>& before = found->second.status;
  if (!before || before->state != status.state || before->scene_revision != status.scene_revision)
    stirred_ = now;
  found->second.status = status;
  found->second.present = true;
  barrier_.set_busy(status.tile, status.state == TileState::loading);
}

void WallMaster::hear(const Presence& presence, Time now) {
  roll_.hear(presence);
  complain();
  const auto found = tiles_.find(presence.who.name);
  if (presence.who.role != Role::tile || found == tiles_.end()) return;
  stirred_ = now;
  if (presence.change == PresenceChange::left) processes_.erase(presence.who.name);
  const bool gone = presence.change == PresenceChange::silent ||
                    (presence.change == PresenceChange::left && !roll_.has_tile(presence.who.name));
  found->second.present = !gone && presence.change != PresenceChange::other_version;
  if (gone) barrier_.leave(presence.who.name);
}

std::uint64_t WallMaster::show(const std::string& path, const std::string& sha256,
                               Placement placement) {
  bus_.publish(SceneMessage{++asked_scene_, path, sha256, placement});
  return asked_scene_;
}

// A tile that cannot load it says so, reports the revision as its own, and shows why.
std::vector<std::string> WallMaster::loading() const {
  std::vector<std::string> loading;
  if (asked_scene_ == shown_scene_) return loading;
  for (const auto& [tile, report] : tiles_)
    if (report.present && (!report.status || report.status->scene_revision < asked_scene_))
      loading.push_back(tile);
  return loading;
}

void WallMaster::change_scene() {
  if (loading().empty()) shown_scene_ = asked_scene_;
}

}  // namespace vindu
