// A wall in simulated time: one master and its tiles over a network that delays, loses and
// overtakes. Master and tiles are the product's code; drawing, refreshes and faults are played.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "cluster/wall_master.h"
#include "cluster/wall_tile.h"

namespace vindu::testing {

/// Time, and what happens at which.
class World {
 public:
  explicit World(std::uint64_t seed) : random_(seed) {}
  Time now() const { return now_; }
  void at(Time time, std::function<void()> event) { events_.emplace(time, std::move(event)); }
  void after(Duration delay, std::function<void()> event) { at(now_ + delay, std::move(event)); }
  void run_until(Time end) {
    while (!events_.empty() && events_.begin()->first <= end) {
      auto event = events_.extract(events_.begin());
      now_ = std::max(now_, event.key());
      event.mapped()();
    }
    now_ = end;
  }
  double uniform(double least, double most) {
    return std::uniform_real_distribution(least, most)(random_);
  }

 private:
  Time now_{};
  std::multimap<Time, std::function<void()>> events_;
  std::mt19937_64 random_;
};

struct Link {
  double loss = 0;
  double least_ms = 0.05, most_ms = 0.3;
};

/// A bus of that world. What is lost of a reliable topic comes later.
class SimulatedBus final : public Bus {
 public:
  SimulatedBus(World& world, const Link& link, std::function<void()> woken)
      : world_(world), link_(link), woken_(std::move(woken)) {}

  std::vector<SimulatedBus*> others;
  bool plugged = true;
  bool awake = true;
  std::size_t published = 0;  // messages

  void publish(const Message& message) override {
    ++published;
    if (!plugged) return;
    for (SimulatedBus* other : others) {
      double delay_ms = world_.uniform(link_.least_ms, link_.most_ms);
      while (world_.uniform(0, 1) < link_.loss) {
        if (!rules_of(topic_of(message)).reliable) delay_ms = -1;
        if (delay_ms < 0) break;
        delay_ms += 20;
      }
      if (delay_ms < 0) continue;
      world_.after(from_seconds(1e-3 * delay_ms), [other, message] { other->arrive(message); });
    }
  }
  std::vector<Message> take(Topic topic) override {
    std::vector<Message> taken;
    for (auto& [key, message] : inbox_[topic]) taken.push_back(std::move(message));
    inbox_[topic].clear();
    return taken;
  }
  bool wait(Topics, Time) override { return false; }

  void arrive(const Message& message) {
    if (!plugged) return;
    inbox_[topic_of(message)].insert_or_assign(key_of(message), message);  // the last of each key
    if (awake) woken_();
  }

 private:
  World& world_;
  const Link& link_;
  std::function<void()> woken_;
  std::map<Topic, std::map<std::string, Message>> inbox_;
};

/// What a tile showed, and when.
struct Shown {
  Time time{};
  std::uint64_t number = 0;
  double eye_x_m = 0;
  std::uint64_t scene = 0;
};

struct TileSpec {
  double draw_ms = 8, draw_jitter_ms = 2;
  double refresh_hz = 60, refresh_phase = 0;
};

class SimulatedTile {
 public:
  SimulatedTile(World& world, const Link& link, const std::string& name)
      : bus(world, link, [this] { step(); }), world_(world), name_(name) {
    start(1);
  }

  SimulatedBus bus;
  TileSpec spec;
  std::vector<Shown> shown;
  int draws = 0;

  void start(std::uint64_t incarnation) {
    ++life_;
    busy_ = false;
    bus.awake = bus.plugged = true;
    tile_.emplace(
        bus, StatusMessage{.host = name_, .incarnation = incarnation, .state = TileState::ready},
        std::vector{name_});
    wake();
  }
  void kill() {
    ++life_;
    tile_.reset();
    bus.plugged = false;
  }
  /// SIGSTOP and SIGCONT.
  void stop() { bus.awake = false; }
  void go_on() {
    bus.awake = true;
    wake();
  }
  WallTile& tile() { return *tile_; }

 private:
  void wake() {
    step();
    world_.after(std::chrono::milliseconds(1), [this, life = life_] {
      if (life == life_ && bus.awake) wake();
    });
  }

  // The product's tile loop, with drawing and refresh played.
  void step() {
    if (!tile_ || busy_ || !bus.awake) return;
    const Time now = world_.now();
    tile_->poll(now);
    switch (tile_->next(now, now >= surface_free_)) {
      case WallTile::Next::show: {
        const double period_s = 1 / spec.refresh_hz;
        const double refreshes = seconds(now.time_since_epoch()) / period_s - spec.refresh_phase;
        surface_free_ =
            Time(from_seconds((std::floor(refreshes) + 1 + spec.refresh_phase) * period_s));
        tile_->showed(now, now);
        shown.push_back({now, drawn_.number, drawn_.eye_in_wall.x(), scene_});
        return step();
      }
      case WallTile::Next::draw: {
        const FrameMessage frame = *tile_->to_draw();
        if (tile_->drawn_already()) return drew(frame, now, life_);
        busy_ = true;
        ++draws;
        const Duration draw =
            from_seconds(1e-3 * (spec.draw_ms + world_.uniform(0, spec.draw_jitter_ms)));
        world_.after(draw, [this, frame, now, life = life_] { drew(frame, now, life); });
        return;
      }
      case WallTile::Next::wait:
        return;
    }
  }

  void drew(const FrameMessage& frame, Time started, int life) {
    if (life != life_) return;
    if (!bus.awake)
      return world_.after(std::chrono::milliseconds(1), [=, this] { drew(frame, started, life); });
    busy_ = false;
    drawn_ = frame.newest;
    scene_ = frame.scene_revision;
    tile_->drew(frame.newest.number, started, world_.now());
    step();
  }

  World& world_;
  std::string name_;
  std::optional<WallTile> tile_;
  Time surface_free_{};
  FrameState drawn_{};
  std::uint64_t scene_ = 0;
  bool busy_ = false;
  int life_ = 0;
};

inline std::vector<std::string> names_of(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back("tile-" + std::to_string(i % 7) + "-" + std::to_string(i / 7));
  return names;
}

/// A master that ticks at 60 Hz, and its tiles.
class SimulatedWall {
 public:
  explicit SimulatedWall(std::size_t count, std::uint64_t seed = 1, const Link& link = {},
                         const BarrierOptions& options = {})
      : world(seed),
        link_(link),
        options_(options),
        names_(names_of(count)),
        bus_(world, link_, [this] { step(); }) {
    for (const std::string& name : names_) {
      auto& tile = tiles.emplace_back(std::make_unique<SimulatedTile>(world, link_, name));
      tile->spec.refresh_phase = world.uniform(0, 1);
      tile->bus.others = {&bus_};
      bus_.others.push_back(&tile->bus);
    }
    start_master(1);
    for (std::size_t i = 0; i < count; ++i) announce(i, PresenceChange::alive);
  }

  World world;
  std::vector<std::unique_ptr<SimulatedTile>> tiles;
  std::map<std::uint64_t, double> eye_x_m;  // what the master said of each frame
  std::map<std::uint64_t, Time> ticks;      // when it began each
  std::vector<MemberEvent> events;
  std::vector<FrameSkew> skews;
  std::optional<double> still_eye_x_m;  // of all frames from now on

  SimulatedBus& bus() { return bus_; }
  WallMaster& master() { return *master_; }

  void start_master(std::uint64_t epoch) {
    ++life_;
    begun_ = 0;
    tick_due_ = 0;
    eye_x_m.clear();
    master_.emplace(bus_, WallMaster::Options{.epoch = epoch,
                                              .self = {.role = Role::master, .host = "master"},
                                              .tiles = names_,
                                              .barrier = options_});
    start_ = world.now();
    wake();
  }
  void kill_master() {
    ++life_;
    master_.reset();
  }

  /// What the bus tells the master half a second later.
  void announce(std::size_t tile, PresenceChange change) {
    bus_.arrive(Presence{change, {.role = Role::tile, .name = names_[tile], .host = names_[tile]}});
  }
  void run(double length_s) { world.run_until(world.now() + from_seconds(length_s)); }
  std::uint64_t begun() const { return begun_; }

  std::size_t count(MemberChange change) const {
    return static_cast<std::size_t>(std::ranges::count(events, change, &MemberEvent::change));
  }

 private:
  void wake() {
    step();
    world.after(std::chrono::microseconds(500), [this, life = life_] {
      if (life == life_) wake();
    });
  }

  void begin(Time now) {
    const double x_m = still_eye_x_m.value_or(world.uniform(-1, 1));
    const FrameState state{.eye_in_wall = Vec3(x_m, 0, 2)};
    if (!master_->due(state, now)) return;
    eye_x_m[++begun_] = x_m;
    ticks[begun_] = now;
    master_->begin(
        state, now,
        {.capture_time = now - std::chrono::milliseconds(7), .tick_time = now, .eye_time = now});
  }

  void step() {
    if (!master_) return;
    const Time now = world.now();
    master_->poll(now);
    if (master_->open() && now >= start_ + from_seconds(static_cast<double>(tick_due_) / 60)) {
      begin(now);
      tick_due_ = static_cast<std::int64_t>(seconds(now - start_) * 60 + 1e-6) + 1;
    }
    for (MemberEvent& event : master_->take_events()) events.push_back(event);
    for (const FrameSkew& skew : master_->take_skews()) skews.push_back(skew);
  }

  Link link_;
  BarrierOptions options_;
  std::vector<std::string> names_;
  SimulatedBus bus_;
  std::optional<WallMaster> master_;
  Time start_{};
  std::int64_t tick_due_ = 0;
  std::uint64_t begun_ = 0;
  int life_ = 0;
};

}  // namespace vindu::testing
