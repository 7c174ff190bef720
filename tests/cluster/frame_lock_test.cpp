// The frame lock in simulated time: one master and the tiles of a wall over a network that delays,
// loses and overtakes. The tiles' code is the product's; drawing, refreshes and faults are played.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "cluster/wall_master.h"
#include "cluster/wall_tile.h"

namespace vindu {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

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

  void publish(const Message& message) override {
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

  void start(std::uint64_t incarnation) {
    ++life_;
    busy_ = false;
    bus.awake = bus.plugged = true;
    tile_.emplace(bus, StatusMessage{.host = name_, .incarnation = incarnation},
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
    world_.after(milliseconds(1), [this, life = life_] {
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
        tile_->showed(now);
        shown.push_back({now, drawn_.number, drawn_.eye_in_wall.x(), scene_});
        return step();
      }
      case WallTile::Next::draw: {
        const FrameMessage frame = *tile_->to_draw();
        busy_ = true;
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
    if (!bus.awake) return world_.after(milliseconds(1), [=, this] { drew(frame, started, life); });
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

std::vector<std::string> names_of(std::size_t count) {
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
  std::vector<MemberEvent> events;
  std::vector<FrameSkew> skews;

  WallMaster& master() { return *master_; }

  void start_master(std::uint64_t epoch) {
    ++life_;
    begun_ = 0;
    tick_due_ = 0;
    eye_x_m.clear();
    master_.emplace(bus_,
                    WallMaster::Options{
                        .epoch = epoch, .host = "master", .tiles = names_, .barrier = options_});
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
    world.after(microseconds(500), [this, life = life_] {
      if (life == life_) wake();
    });
  }

  void step() {
    if (!master_) return;
    const Time now = world.now();
    master_->poll(now);
    if (master_->open() && now >= start_ + from_seconds(static_cast<double>(tick_due_) / 60)) {
      ++begun_;
      eye_x_m[begun_] = world.uniform(-1, 1);
      master_->begin({.number = 0, .eye_in_wall = Vec3(eye_x_m[begun_], 0, 2)}, now);
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

/// Every tile shows frames in order, each as the master said it.
void expect_right_frames(const SimulatedWall& wall) {
  for (const auto& tile : wall.tiles) {
    std::uint64_t last = 0;
    for (const Shown& shown : tile->shown) {
      ASSERT_GT(shown.number, last);
      ASSERT_EQ(shown.eye_x_m, wall.eye_x_m.at(shown.number));
      last = shown.number;
    }
  }
}

double longest_gap_s(const SimulatedTile& tile, Time from = {}) {
  double longest_s = 0;
  for (std::size_t i = 1; i < tile.shown.size(); ++i)
    if (tile.shown[i - 1].time >= from)
      longest_s = std::max(longest_s, seconds(tile.shown[i].time - tile.shown[i - 1].time));
  return longest_s;
}

TEST(FrameLock, ShowsEveryFrameOnAllTilesAtTheWallsRate) {
  SimulatedWall wall(28);
  for (auto& tile : wall.tiles) tile->spec.refresh_hz = 1000;
  wall.run(10);
  expect_right_frames(wall);
  EXPECT_NEAR(static_cast<double>(wall.begun()), 600, 3);
  EXPECT_EQ(wall.master().active(), 28u);
  EXPECT_EQ(wall.count(MemberChange::evicted), 0u);
  for (const auto& tile : wall.tiles) EXPECT_GE(tile->shown.size() + 2, wall.begun());
}

TEST(FrameLock, SwapsWithinWhatTheNetworkTakes) {
  SimulatedWall wall(28);
  for (auto& tile : wall.tiles) tile->spec.refresh_hz = 10000;
  wall.run(5);
  std::map<std::uint64_t, std::pair<Time, Time>> swaps;
  for (const auto& tile : wall.tiles)
    for (const Shown& shown : tile->shown) {
      auto [entry, added] = swaps.try_emplace(shown.number, shown.time, shown.time);
      auto& [first, last] = entry->second;
      first = std::min(first, shown.time);
      last = std::max(last, shown.time);
    }
  for (const auto& [number, swap] : swaps)
    if (number > 10) {
      EXPECT_LE(swap.second - swap.first, microseconds(300)) << number;
    }
}

TEST(FrameLock, KeepsItsRateThoughProjectorsRefreshWhenTheyLike) {
  SimulatedWall wall(28);
  for (auto& tile : wall.tiles) tile->spec.refresh_hz = wall.world.uniform(59.9, 60.1);
  wall.run(60);
  expect_right_frames(wall);
  EXPECT_GE(static_cast<double>(wall.begun()) / 60, 59);
  for (const auto& tile : wall.tiles) EXPECT_GE(static_cast<double>(tile->shown.size()) / 60, 59);
}

TEST(FrameLock, LosesNoTileWhereTheNetworkLosesAndDelays) {
  for (const Link& link : {Link{.loss = 0.01}, Link{.loss = 0.05},
                           Link{.loss = 0.01, .least_ms = 0.05, .most_ms = 20}}) {
    SimulatedWall wall(28, 3, link);
    for (auto& tile : wall.tiles) tile->spec.refresh_hz = 1000;
    wall.run(20);
    expect_right_frames(wall);
    EXPECT_EQ(wall.count(MemberChange::evicted), 0u) << link.loss;
    std::printf("  loss %.0f %%, up to %.1f ms: %.1f frames/s\n", 100 * link.loss, link.most_ms,
                static_cast<double>(wall.begun()) / 20);
  }
}

TEST(FrameLock, WaitsOnceForATileThatDiesAndTakesItInAgain) {
  SimulatedWall wall(28);
  wall.run(3);
  const Time killed = wall.world.now();
  wall.tiles[9]->kill();
  wall.run(0.5);
  wall.announce(9, PresenceChange::silent);
  wall.run(1);
  EXPECT_EQ(wall.master().active(), 27u);
  ASSERT_EQ(wall.count(MemberChange::evicted), 1u);
  EXPECT_EQ(wall.events[28].tile, "tile-2-1");
  for (std::size_t i = 0; i < wall.tiles.size(); ++i)
    if (i != 9) {
      EXPECT_LE(longest_gap_s(*wall.tiles[i], killed - milliseconds(20)), 0.10);
    }
  const Time restarted = wall.world.now();
  wall.announce(9, PresenceChange::alive);
  wall.tiles[9]->start(2);
  wall.run(1);
  EXPECT_EQ(wall.master().active(), 28u);
  for (std::size_t i = 0; i < wall.tiles.size(); ++i)
    EXPECT_LE(longest_gap_s(*wall.tiles[i], restarted), 0.05) << i;
  expect_right_frames(wall);
}

TEST(FrameLock, WaitsOnceForATileThatIsStoppedOrCutOff) {
  for (const bool cable : {false, true}) {
    SimulatedWall wall(28);
    wall.run(3);
    const Time fault = wall.world.now();
    SimulatedTile& tile = *wall.tiles[4];
    cable ? void(tile.bus.plugged = false) : tile.stop();
    wall.run(2);
    EXPECT_EQ(wall.master().active(), 27u);
    cable ? void(tile.bus.plugged = true) : tile.go_on();
    wall.run(1);
    EXPECT_EQ(wall.master().active(), 28u);
    EXPECT_EQ(wall.count(MemberChange::evicted), 1u);
    for (std::size_t i = 0; i < wall.tiles.size(); ++i)
      if (i != 4) {
        EXPECT_LE(longest_gap_s(*wall.tiles[i], fault - milliseconds(20)), 0.10);
      }
    expect_right_frames(wall);
  }
}

TEST(FrameLock, GoesOnWithoutATileThatIsFarSlowerThanTheOthers) {
  SimulatedWall wall(28);
  wall.tiles[0]->spec = {.draw_ms = 400};
  wall.run(20);
  expect_right_frames(wall);
  EXPECT_EQ(wall.master().active(), 27u);
  EXPECT_GT(wall.begun(), 1000u);
  EXPECT_GT(wall.tiles[0]->shown.size(), 30u);
}

TEST(FrameLock, HoldsTogetherWhereAllAreSlow) {
  SimulatedWall wall(8);
  for (auto& tile : wall.tiles) tile->spec = {.draw_ms = 200, .draw_jitter_ms = 150};
  wall.run(30);
  expect_right_frames(wall);
  EXPECT_EQ(wall.master().active(), 8u);
  EXPECT_EQ(wall.count(MemberChange::evicted), 0u);
  EXPECT_GT(wall.begun(), 80u);
}

TEST(FrameLock, FollowsAMasterThatStartsAgain) {
  SimulatedWall wall(28);
  wall.run(3);
  wall.kill_master();
  wall.run(1);
  for (auto& tile : wall.tiles) tile->shown.clear();
  wall.start_master(2);
  wall.run(2);
  expect_right_frames(wall);
  EXPECT_EQ(wall.master().active(), 28u);
  for (auto& tile : wall.tiles) EXPECT_GT(tile->shown.size(), 100u);
}

TEST(FrameLock, ReleasesAtATimeThatAllKnowWhereItIsTimed) {
  SimulatedWall wall(28, 1, {.least_ms = 0.05, .most_ms = 2}, {.lock = FrameLock::timed});
  for (auto& tile : wall.tiles) tile->spec.refresh_hz = 100000;
  wall.run(10);
  expect_right_frames(wall);
  ASSERT_GT(wall.skews.size(), 400u);
  std::vector<double> skew_ms;
  for (const FrameSkew& skew : wall.skews)
    if (skew.number > 100) skew_ms.push_back(1e3 * seconds(skew.skew));
  std::ranges::sort(skew_ms);
  EXPECT_LT(skew_ms[skew_ms.size() / 2], 1.2);
}

TEST(FrameLock, NeverWaitsWhereItIsFree) {
  SimulatedWall wall(4, 1, {}, {.lock = FrameLock::free});
  wall.tiles[0]->spec.draw_ms = 200;
  wall.run(5);
  expect_right_frames(wall);
  EXPECT_NEAR(static_cast<double>(wall.begun()), 300, 3);
  EXPECT_GT(wall.tiles[1]->shown.size(), 290u);
  EXPECT_GT(wall.tiles[0]->shown.size(), 20u);
}

TEST(FrameLock, ChangesTheSceneInOneFrameOnceAllHaveIt) {
  SimulatedWall wall(28);
  wall.run(1);
  const std::uint64_t before = wall.master().shown_scene();
  wall.master().show("fjord.glb", "", Placement::fit);
  wall.run(0.5);
  EXPECT_EQ(wall.master().loading().size(), 28u);
  std::uint64_t asked = 0;
  for (std::size_t i = 0; i < wall.tiles.size(); ++i) {
    const auto scene = wall.tiles[i]->tile().take_scene();
    ASSERT_TRUE(scene);
    asked = scene->revision;
    if (i == 3)
      wall.tiles[i]->tile().could_not_load(asked, "no such file");
    else
      wall.tiles[i]->tile().loaded(asked);
    wall.run(0.3);
    EXPECT_EQ(wall.master().shown_scene(), i + 1 < wall.tiles.size() ? before : asked);
  }
  wall.run(1);
  std::map<std::uint64_t, std::uint64_t> scene_of_frame;
  for (const auto& tile : wall.tiles)
    for (const Shown& shown : tile->shown) {
      const auto [entry, added] = scene_of_frame.try_emplace(shown.number, shown.scene);
      EXPECT_EQ(entry->second, shown.scene);
    }
  EXPECT_EQ(scene_of_frame.rbegin()->second, asked);
}

TEST(FrameLock, OneThatDiesWhileItLoadsHoldsUpNoChange) {
  SimulatedWall wall(4);
  wall.run(1);
  wall.master().show("fjord.glb", "", Placement::fit);
  wall.run(0.3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto scene = wall.tiles[i]->tile().take_scene();
    wall.tiles[i]->tile().loaded(scene->revision);
  }
  wall.tiles[3]->kill();
  wall.run(0.5);
  EXPECT_EQ(wall.master().loading().size(), 1u);
  wall.announce(3, PresenceChange::silent);
  wall.run(0.1);
  EXPECT_TRUE(wall.master().loading().empty());
}

// Whatever happens, in whatever order: no tile shows a wrong frame, and the others wait once each.
TEST(FrameLock, ShowsNoWrongFrameInTenMinutesOfFaults) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SimulatedWall wall(28, seed, {.loss = 0.01, .least_ms = 0.05, .most_ms = 2});
    wall.run(2);
    std::size_t faults = 0;
    std::uint64_t incarnation = 10;
    for (double time_s = 0; time_s < 200; time_s += 2.5, ++faults) {
      const auto i = static_cast<std::size_t>(wall.world.uniform(0, 28));
      SimulatedTile& tile = *wall.tiles[i];
      const int kind = static_cast<int>(wall.world.uniform(0, 3));
      if (kind == 0) tile.kill();
      if (kind == 1) tile.stop();
      if (kind == 2) tile.bus.plugged = false;
      wall.run(0.5);
      wall.announce(i, PresenceChange::silent);
      wall.run(1);
      if (kind == 0) tile.start(++incarnation);
      if (kind == 1) tile.go_on();
      tile.bus.plugged = true;
      wall.announce(i, PresenceChange::alive);
      wall.run(1);
      ASSERT_EQ(wall.master().active(), 28u) << seed << " fault " << faults << " kind " << kind;
    }
    expect_right_frames(wall);
    EXPECT_LE(wall.count(MemberChange::evicted), faults);
    EXPECT_GT(static_cast<double>(wall.begun()), 0.95 * 60 * 200);
  }
}

}  // namespace
}  // namespace vindu
