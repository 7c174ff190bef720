#include "cluster/tile_barrier.h"

#include <cassert>
#include <utility>

namespace vindu {
namespace {

/// A master that is not heard for so long is gone, and an older one may come back.
constexpr Duration kMasterGone = std::chrono::seconds(2);

}  // namespace

TileBarrier::TileBarrier(std::uint64_t incarnation) : incarnation_(incarnation) {
  assert(incarnation != 0);
  heard_.newest.number = 0;
}

bool TileBarrier::follows(const FrameMessage& message, Time now) const {
  return message.epoch >= heard_.epoch || silence(now) > kMasterGone;
}

void TileBarrier::hear(const FrameMessage& message, Time now) {
  if (!follows(message, now)) return;
  if (message.epoch != heard_.epoch) {
    heard_ = {.epoch = message.epoch, .newest = {.number = 0}};
    offset_ = {};
    drawn_ = presented_ = 0;
    drawn_content_.reset();
    presented_parts_ = {};
  }
  sent_ = message.sent_time;
  received_ = now;
  offset_.add(message.sent_time, now);
  const bool overtaken =
      message.newest.number < heard_.newest.number || message.released < heard_.released;
  if (overtaken) return;
  if (message.newest.number > heard_.newest.number) heard_newest_ = now;
  heard_ = message;
}

const FrameMessage* TileBarrier::to_draw() const {
  return heard_.newest.number > drawn_ ? &heard_ : nullptr;
}

bool TileBarrier::drawn_already() const { return drawn_content_ == content(); }

void TileBarrier::drew(std::uint64_t number, Time started, Time now) {
  if (drawn_ != 0) missed_ += number - drawn_ - 1;
  drawn_ = number;
  drawn_content_ = content();
  draw_time_ = now - started;
  drew_ = now;
  drawn_origin_ = heard_.origin;
  pickup_ = started - heard_newest_;
}

void TileBarrier::spoiled() {
  drawn_ = presented_;
  drawn_content_.reset();
}

std::optional<Time> TileBarrier::show_time(Time now) const {
  if (drawn_ <= presented_ || drawn_ > heard_.released) return std::nullopt;
  if (!heard_.present_time || drawn_ < heard_.released) return now;
  return offset_.here(*heard_.present_time);
}

void TileBarrier::showed(Time began, Time now) {
  presented_ = drawn_;
  presented_time_ = now;
  presented_parts_ = {
      .pickup = pickup_, .draw = draw_time_, .barrier = began - drew_, .swap = now - began};
}

std::optional<FrameParts> TileBarrier::presented_frame(Duration display) const {
  const auto tick = offset_.here(drawn_origin_.tick_time);
  if (presented_ == 0 || presented_ != drawn_ || !tick) return std::nullopt;
  FrameOrigin here = drawn_origin_;
  here.tick_time = *tick;
  here.eye_time += *tick - drawn_origin_.tick_time;
  if (here.capture_time) *here.capture_time += *tick - drawn_origin_.tick_time;
  return parts_of(here, presented_parts_, presented_time_, display);
}

ReadyMessage TileBarrier::ready(Time now) const {
  return {.incarnation = incarnation_,
          .epoch = heard_.epoch,
          .number = drawn_,
          .presented = presented_,
          .presented_time = presented_time_,
          .presented_parts = presented_parts_,
          .draw_time = draw_time_,
          .frame_sent_time = sent_,
          .frame_received_time = received_,
          .sent_time = now};
}

}  // namespace vindu
