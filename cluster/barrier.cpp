#include "cluster/barrier.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace vindu {

void UsualTime::add(Duration duration) {
  if (last_.size() < kKept)
    last_.push_back(duration);
  else
    last_[next_++ % kKept] = duration;
}

std::optional<Duration> UsualTime::p95() const {
  constexpr std::size_t kFew = 20;
  if (last_.size() < kFew) return std::nullopt;
  std::vector<Duration> sorted = last_;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 95 / 100);
  std::ranges::nth_element(sorted, place);
  return *place;
}

Barrier::Barrier(std::uint64_t epoch, std::span<const std::string> tiles,
                 const BarrierOptions& options)
    : epoch_(epoch), options_(options) {
  assert(epoch != 0);
  for (const std::string& tile : tiles) members_[tile];
  newest_.number = 0;
}

void Barrier::begin(FrameState state, std::uint64_t scene_revision, Time now) {
  assert(open());
  state.number = newest_.number + 1;
  begun(state.number) = {.time = now, .drawn = !same_picture(state, scene_revision)};
  newest_ = state;
  scene_revision_ = scene_revision;
  present_time_.reset();
  for (auto& [tile, member] : members_) {
    if (!member.caught_up || member.active) continue;
    member.active = true;
    note(tile, MemberChange::admitted);
  }
}

bool Barrier::same_picture(const FrameState& state, std::uint64_t scene_revision) const {
  FrameState next = state;
  next.number = newest_.number + 1;
  return newest_.number != 0 && scene_revision == scene_revision_ &&
         content_hash_of(next) == content_hash_of(newest_);
}

std::optional<Duration> Barrier::age(std::uint64_t number, Time now) const {
  if (number == 0 || number > newest_.number || number + kBegun <= newest_.number)
    return std::nullopt;
  return now - begun(number).time;
}

bool Barrier::hear(const ReadyMessage& ready, Time now) {
  const auto found = members_.find(ready.tile);
  if (found == members_.end() || ready.epoch != epoch_ || ready.number > newest_.number)
    return false;
  Member& member = found->second;
  if (member.incarnation != ready.incarnation) {
    if (member.incarnation != 0) note(ready.tile, MemberChange::restarted);
    member = {.incarnation = ready.incarnation, .busy = member.busy};
  }
  if (ready.number > member.number) {
    member.number = ready.number;
    // One that is no slower than what is waited for has caught up, even if the wall has gone on
    // meanwhile: software renderers take longer for a frame than the wall waits between two.
    const auto took = age(ready.number, now);
    member.caught_up = took && *took <= patience() && !member.busy;
    // What is not drawn says nothing of how long drawing takes.
    if (member.caught_up && begun(ready.number).drawn) usual_.add(*took);
  }
  return ready.presented < ready.number && ready.number <= released_;
}

void Barrier::set_busy(const std::string& tile, bool busy) {
  const auto found = members_.find(tile);
  if (found == members_.end()) return;
  Member& member = found->second;
  member.busy = busy;
  if (!busy) return;
  if (member.active) note(tile, MemberChange::loads);
  member.active = member.caught_up = false;
}

void Barrier::leave(const std::string& tile) {
  const auto found = members_.find(tile);
  if (found == members_.end() || found->second.number == 0) return;
  found->second = {.incarnation = found->second.incarnation, .busy = found->second.busy};
  note(tile, MemberChange::lost);
}

Duration Barrier::patience() const {
  const auto p95 = usual_.p95();
  if (!p95) return options_.first_patience;
  return std::clamp(3 * *p95, options_.least_patience, options_.most_patience);
}

Time Barrier::deadline() const {
  if (open() || active() == 0) return Time::max();
  return begun(newest_.number).time + patience();
}

bool Barrier::settle(Time now) {
  if (open()) return false;
  const auto holds_up = [&](const auto& entry) {
    return entry.second.active && entry.second.number < newest_.number;
  };
  const bool waiting = std::ranges::any_of(members_, holds_up);
  if (waiting && options_.lock != FrameLock::free && now < deadline()) return false;
  for (auto& entry : members_) {
    if (!holds_up(entry) || options_.lock == FrameLock::free) continue;
    entry.second.active = entry.second.caught_up = false;
    note(entry.first, MemberChange::evicted, now - begun(newest_.number).time);
  }
  release(now);
  return true;
}

void Barrier::release(Time now) {
  released_ = newest_.number;
  if (options_.lock == FrameLock::timed) present_time_ = now + options_.timed_margin;
}

FrameMessage Barrier::message(Time now) const {
  return {.epoch = epoch_,
          .newest = newest_,
          .released = released_,
          .present_time = present_time_,
          .scene_revision = scene_revision_,
          .active_tiles = static_cast<std::uint32_t>(active()),
          .sent_time = now};
}

bool Barrier::takes_part(const std::string& tile) const {
  const auto found = members_.find(tile);
  return found != members_.end() && found->second.active;
}

std::size_t Barrier::active() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(members_, [](const auto& entry) { return entry.second.active; }));
}

void Barrier::note(const std::string& tile, MemberChange change, Duration waited) {
  events_.push_back({tile, change, newest_.number, waited});
}

}  // namespace vindu
