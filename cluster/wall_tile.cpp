#include "cluster/wall_tile.h"

#include <algorithm>

namespace vindu {
namespace {

constexpr Duration kReport = std::chrono::milliseconds(200);
constexpr Duration kCount = std::chrono::seconds(1);

}  // namespace

WallTile::WallTile(Bus& bus, StatusMessage self, std::vector<std::string> tiles)
    : bus_(bus), tiles_(std::move(tiles)), barrier_(self.incarnation), status_(std::move(self)) {}

void WallTile::poll(Time now) {
  for (const FrameMessage& message : bus_.take<FrameMessage>()) barrier_.hear(message, now);
  for (SceneMessage& scene : bus_.take<SceneMessage>()) {
    scene_ = std::move(scene);
  }
  if (barrier_.waits() && now >= repeats_.due()) {
    repeats_.said_again(now);
    send_ready(now);
  }
  if (now - reported_ >= kReport) report(now);
}

Time WallTile::wake_time(Time now) const {
  Time wake = reported_ + kReport;
  if (barrier_.waits()) wake = std::min(wake, repeats_.due());
  if (const auto show = barrier_.show_time(now)) wake = std::min(wake, *show);
  return wake;
}

WallTile::Next WallTile::next(Time now, bool surface_free) const {
  const auto show = barrier_.show_time(now);
  if (show && *show <= now && surface_free) return Next::show;
  if (show && *show > now) return Next::wait;
  return barrier_.to_draw() ? Next::draw : Next::wait;
}

void WallTile::drew(std::uint64_t number, Time started, Time now) {
  barrier_.drew(number, started, now);
  status_.late_frames += barrier_.take_missed();
  say_ready(now);
}

void WallTile::say_ready(Time now) {
  repeats_.said(now);
  send_ready(now);
}

void WallTile::send_ready(Time now) {
  ReadyMessage ready = barrier_.ready(now);
  for (const std::string& tile : tiles_) {
    ready.tile = tile;
    bus_.publish(ready);
  }
}

// Said at once: the swap's time, and with it the skew, comes with the next frame's readiness else,
// which a tile that stops would never say.
void WallTile::showed(Time began, Time now) {
  barrier_.showed(began, now);
  say_ready(now);
  ++frames_;
}

void WallTile::report(Time now) {
  if (now - counted_ >= kCount) {
    if (counted_ != Time{})
      status_.frames_per_s = static_cast<double>(frames_) / seconds(now - counted_);
    frames_ = 0;
    counted_ = now;
  }
  status_.epoch = barrier_.epoch();
  status_.presented = barrier_.presented();
  for (const std::string& tile : tiles_) {
    status_.tile = tile;
    bus_.publish(status_);
  }
  reported_ = now;
}

void WallTile::loads(Time now) {
  status_.state = TileState::loading;
  report(now);
}

void WallTile::loaded(std::uint64_t revision) {
  status_.scene_revision = revision;
  status_.state = TileState::ready;
  status_.error.clear();
  reported_ = {};
}

void WallTile::could_not_load(std::uint64_t revision, const std::string& why) {
  status_.scene_revision = revision;
  status_.state = TileState::failed;
  status_.error = why;
  reported_ = {};
}

}  // namespace vindu
