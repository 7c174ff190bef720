// A wall before which nobody moves, in simulated time: tiles draw nothing, and the first motion is
// on all of them at the next tick.
#include <gtest/gtest.h>

#include "tests/cluster/simulated_wall.h"

namespace vindu {
namespace {

using testing::Link;
using testing::SimulatedTile;
using testing::SimulatedWall;

constexpr double kTick_s = 1.0 / 60, kLook_s = 0.0005;  // how often the master looks

/// A wall whose eye has moved for two seconds and then stood still for two.
class StillWall : public ::testing::Test {
 protected:
  StillWall() {
    for (auto& tile : wall.tiles) tile->spec.refresh_hz = 1000;
    wall.run(2);
    wall.still_eye_x_m = 0.25;
    wall.run(2);
  }
  std::vector<int> draws() const {
    std::vector<int> draws;
    for (const auto& tile : wall.tiles) draws.push_back(tile->draws);
    return draws;
  }

  SimulatedWall wall{6};
};

TEST_F(StillWall, DrawsNothing) {
  const std::vector<int> before = draws();
  wall.run(60);
  EXPECT_EQ(draws(), before);
}

TEST_F(StillWall, ShowsTwoFramesASecondToKnowWhoIsThere) {
  const std::uint64_t begun = wall.begun();
  wall.run(10);
  EXPECT_NEAR(static_cast<double>(wall.begun() - begun), 20, 1);
  EXPECT_EQ(wall.master().active(), 6u);
  EXPECT_EQ(wall.count(MemberChange::evicted), 0u);
  for (const auto& tile : wall.tiles) EXPECT_EQ(tile->tile().status().late_frames, 0u);
}

TEST_F(StillWall, DrawsTheFirstMotionAtTheNextTick) {
  for (const double x_m : {0.3, 0.35, -0.2}) {
    const std::vector<int> before = draws();
    const Time moved = wall.world.now();
    wall.still_eye_x_m = x_m;
    wall.run(2);
    for (std::size_t i = 0; i < wall.tiles.size(); ++i) {
      EXPECT_EQ(wall.tiles[i]->draws, before[i] + 1);
      const auto first = std::ranges::find(wall.tiles[i]->shown, x_m, &testing::Shown::eye_x_m);
      ASSERT_NE(first, wall.tiles[i]->shown.end());
      EXPECT_LE(seconds(wall.ticks.at(first->number) - moved), kTick_s + kLook_s);
    }
  }
}

TEST_F(StillWall, GivesThePictureToATileThatStartsAndTakesItIn) {
  SimulatedTile& tile = *wall.tiles[3];
  tile.kill();
  wall.run(3);
  EXPECT_EQ(wall.master().active(), 5u);
  const std::size_t before = tile.shown.size();
  tile.start(2);
  wall.announce(3, PresenceChange::alive);
  wall.run(0.2);
  ASSERT_GT(tile.shown.size(), before);
  EXPECT_EQ(tile.shown.back().eye_x_m, 0.25);
  wall.run(0.3);
  EXPECT_EQ(wall.master().active(), 6u);
}

TEST_F(StillWall, NoticesATileThatDies) {
  wall.tiles[1]->kill();
  wall.run(2);
  EXPECT_EQ(wall.master().active(), 5u);
  EXPECT_EQ(wall.count(MemberChange::evicted), 1u);
}

// What takes no time while nothing is drawn is no measure of how long drawing may take.
TEST_F(StillWall, HasPatienceWithTilesThatDrawSlowlyHoweverLongItStood) {
  SimulatedWall slow(6);
  for (auto& tile : slow.tiles) tile->spec = {.draw_ms = 300, .draw_jitter_ms = 20};
  slow.run(20);
  ASSERT_EQ(slow.master().active(), 6u);
  slow.still_eye_x_m = 0.5;
  slow.run(600);
  slow.still_eye_x_m.reset();
  slow.run(5);
  EXPECT_EQ(slow.count(MemberChange::evicted), 0u);
}

TEST_F(StillWall, IsFollowedWhenAnotherMasterTakesItOver) {
  wall.kill_master();
  wall.run(5);
  wall.start_master(2);
  wall.run(1);
  EXPECT_EQ(wall.master().active(), 6u);
  const std::vector<int> before = draws();
  wall.run(5);
  EXPECT_EQ(draws(), before);
}

TEST(StillWallOfABadNetwork, ForgetsNoTile) {
  SimulatedWall wall(28, 5, Link{.loss = 0.05, .least_ms = 0.05, .most_ms = 20});
  wall.still_eye_x_m = 1;
  wall.run(60);
  EXPECT_EQ(wall.master().active(), 28u);
  EXPECT_EQ(wall.count(MemberChange::evicted), 0u);
  for (const auto& tile : wall.tiles) EXPECT_LE(tile->draws, 2);
}

TEST(ATileOfAStillWall, DrawsAgainWhereSomethingElseWasDrawnOverIt) {
  SimulatedWall wall(2);
  wall.still_eye_x_m = 0;
  wall.run(2);
  const int before = wall.tiles[0]->draws, other = wall.tiles[1]->draws;
  wall.tiles[0]->tile().spoiled();
  wall.run(1);
  EXPECT_EQ(wall.tiles[0]->draws, before + 1);
  EXPECT_EQ(wall.tiles[1]->draws, other);
}

}  // namespace
}  // namespace vindu
