// The frame lock in simulated time: what tiles show and what the others wait for, whatever happens.
#include <gmock/gmock.h>

#include "tests/cluster/simulated_wall.h"

namespace vindu {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::Link;
using testing::Shown;
using testing::SimulatedTile;
using testing::SimulatedWall;

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

TEST(FrameLock, FollowsTheNewerOfTwoProcessesOfATileAndTheOtherOnceThatIsGone) {
  SimulatedWall wall(4);
  wall.run(1);
  const Link link;
  SimulatedTile twin(wall.world, link, "tile-1-0");
  twin.bus.others = {&wall.bus()};
  wall.bus().others.push_back(&twin.bus);
  twin.start(7);
  ::testing::internal::CaptureStderr();
  wall.run(5);
  EXPECT_EQ(wall.count(MemberChange::restarted), 1u);
  EXPECT_EQ(wall.master().active(), 4u);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, ::testing::HasSubstr("tile-1-0: runs twice"));
  EXPECT_EQ(said.find("runs twice"), said.rfind("runs twice")) << "said once";

  twin.kill();
  wall.run(5);
  EXPECT_EQ(wall.count(MemberChange::restarted), 2u);
  EXPECT_EQ(wall.master().active(), 4u);
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

/// Whoever hears them must not be kept from drawing by them.
TEST(FrameLock, SaysLittleWhileItWaitsForSlowTiles) {
  SimulatedWall wall(28);
  for (auto& tile : wall.tiles) tile->spec = {.draw_ms = 40, .draw_jitter_ms = 2};
  wall.tiles[5]->spec = {.draw_ms = 5, .draw_jitter_ms = 1};
  wall.run(5);
  const auto before = wall.begun();
  const std::size_t by_master = wall.bus().published, by_tile = wall.tiles[5]->bus.published;
  wall.run(10);
  const auto frames = static_cast<double>(wall.begun() - before);
  EXPECT_GT(frames, 150);
  EXPECT_EQ(wall.master().active(), 28u);
  const double of_master = static_cast<double>(wall.bus().published - by_master) / frames;
  const double of_tile = static_cast<double>(wall.tiles[5]->bus.published - by_tile) / frames;
  std::printf("  a frame of 40 ms: %.1f messages by the master, %.1f by a tile\n", of_master,
              of_tile);
  EXPECT_LT(of_master, 9);  // begin, five repeats, release, an answer or two
  EXPECT_LT(of_tile, 8);    // ready, four repeats, shown; its state now and then
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
    if (skew.number > 100) skew_ms.push_back(1e3 * seconds(skew.skew()));
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

TEST(FrameLock, NobodyWaitsForATileThatSaysThatItLoads) {
  SimulatedWall wall(8);
  wall.run(2);
  SimulatedTile& tile = *wall.tiles[3];
  const Time said = wall.world.now();
  tile.tile().loads(said);
  wall.run(0.002);
  tile.stop();
  wall.run(0.5);
  EXPECT_EQ(wall.master().active(), 7u);
  EXPECT_LT(longest_gap_s(*wall.tiles[0], said), 0.04);
  tile.go_on();
  wall.run(0.5);
  EXPECT_EQ(wall.master().active(), 7u) << "it has not said that it is done";
  tile.tile().loaded(1);
  wall.run(0.5);
  EXPECT_EQ(wall.master().active(), 8u);
  EXPECT_EQ(wall.count(MemberChange::loads), 1u);
  EXPECT_EQ(wall.count(MemberChange::evicted), 0u);
  expect_right_frames(wall);
}

TEST(TileBarrier, DrawsAFrameAgainThatWasSpoiledBeforeItWasShown) {
  TileBarrier tile(1);
  const Time now{milliseconds(5)};
  FrameMessage frame{.epoch = 1, .newest = {.number = 7}, .released = 6};
  tile.hear(frame, now);
  tile.drew(7, now, now);
  tile.spoiled();
  frame.released = 7;
  tile.hear(frame, now);
  EXPECT_FALSE(tile.show_time(now));
  ASSERT_TRUE(tile.to_draw());
  tile.drew(7, now, now);
  EXPECT_TRUE(tile.show_time(now));
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

TEST(FrameLock, AccountsForAllTimeFromTheTickToTheSwapOnEveryTile) {
  SimulatedWall wall(4);
  for (auto& tile : wall.tiles) tile->spec.refresh_hz = 1000;
  wall.tiles[2]->spec.draw_ms = 12;
  wall.run(5);
  std::size_t checked = 0;
  for (const FrameSkew& frame : wall.skews) {
    if (frame.number < 30 || frame.swaps.size() < 4) continue;
    const Time tick = wall.ticks.at(frame.number);
    Time before{};
    for (const TileSwap& swap : frame.swaps) {
      EXPECT_GE(swap.shown, before);  // in order
      before = swap.shown;
      const FrameParts parts =
          parts_of({.tick_time = tick, .eye_time = tick}, swap.parts, swap.shown, milliseconds(16));
      EXPECT_EQ(parts.motion_to_photon(), swap.shown - tick + milliseconds(16));
      const double slow_ms = swap.tile == "tile-2-0" ? 12 : 8;
      EXPECT_GE(parts[Part::draw], from_seconds(1e-3 * slow_ms));
      EXPECT_LE(parts[Part::draw], from_seconds(1e-3 * (slow_ms + 2)));
      EXPECT_GE(parts[Part::barrier], Duration{});
      // The clocks of two hosts are known to within the network's delay.
      EXPECT_GE(parts[Part::publish], -milliseconds(1));
      if (swap.tile == "tile-2-0") {
        EXPECT_LT(parts[Part::barrier], milliseconds(3));  // nobody is waited for longer
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 500u);
}

TEST(FrameLock, LetsATileReckonItsOwnFrames) {
  SimulatedWall wall(2);
  for (auto& tile : wall.tiles) tile->spec.refresh_hz = 1000;
  wall.run(2);
  const auto parts = wall.tiles[1]->tile().presented_frame(milliseconds(5));
  ASSERT_TRUE(parts);
  EXPECT_TRUE(parts->tracked);
  EXPECT_EQ((*parts)[Part::capture_age], milliseconds(7));
  EXPECT_EQ((*parts)[Part::display], milliseconds(5));
  for (const Part part : {Part::publish, Part::pickup, Part::draw, Part::barrier})
    EXPECT_GE((*parts)[part], Duration{}) << name_of(part);
}

}  // namespace
}  // namespace vindu
