// A process with one tile or several on the bus: what to draw and when to show it, which scene to
// load, and the tiles' state told to everybody. It never waits: who calls asks when to come back.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cluster/bus.h"
#include "cluster/repeats.h"
#include "cluster/tile_barrier.h"

namespace vindu {

class WallTile {
 public:
  static Topics publishes() { return {Topic::ready, Topic::tile_status}; }
  static Topics hears() { return {Topic::frame, Topic::scene}; }

  /// `self`: host, incarnation, version, and the state loading; the rest of the status is kept
  /// here. The tiles are drawn and shown together. The bus, joined with these topics at least, must
  /// outlive it.
  WallTile(Bus& bus, StatusMessage self, std::vector<std::string> tiles);

  void renders_with(const std::string& renderer) { status_.renderer = renderer; }

  void poll(Time now);
  /// When poll() has something to do though nothing is heard.
  Time wake_time(Time now) const;

  /// What to do now. A frame that waits for its display's refresh (`surface_free` false) gives way
  /// to the next one: it must not hold up the wall.
  enum class Next { show, draw, wait };
  Next next(Time now, bool surface_free) const;

  const FrameMessage* to_draw() const { return barrier_.to_draw(); }
  /// Whether that looks like what was drawn last: nothing but drew() is to be called for it.
  bool drawn_already() const { return barrier_.drawn_already(); }
  void drew(std::uint64_t number, Time started, Time now);
  void showed(Time began, Time now);
  /// Something else was drawn over what was drawn: the next frame is drawn, whatever it shows.
  void spoiled() { barrier_.spoiled(); }
  /// Of the frame that was shown last; `display`: from the swap to the light.
  std::optional<FrameParts> presented_frame(Duration display) const {
    return barrier_.presented_frame(display);
  }
  /// Goes out with the next status.
  void measured(const DrawFigures& figures) { status_.draw = figures; }

  /// The newest scene that the master asks for, once.
  std::optional<SceneMessage> take_scene() { return std::exchange(scene_, std::nullopt); }
  /// From now on the tile does not answer until loaded() or could_not_load(): nobody waits for it.
  void loads(Time now);
  void loaded(std::uint64_t revision);
  /// It is shown as an error from the frame on in which the others change to it.
  void could_not_load(std::uint64_t revision, const std::string& why);

  /// Whether no master was heard of for so long that people should be told.
  bool alone(Time now) const { return barrier_.silence(now) > std::chrono::seconds(2); }
  const StatusMessage& status() const { return status_; }

 private:
  void report(Time now);
  void say_ready(Time now);
  void send_ready(Time now);

  Bus& bus_;
  std::vector<std::string> tiles_;
  TileBarrier barrier_;
  StatusMessage status_;
  std::optional<SceneMessage> scene_;
  Repeats repeats_;
  Time reported_{}, counted_{};
  std::uint64_t frames_ = 0;  // since counted_
};

}  // namespace vindu
