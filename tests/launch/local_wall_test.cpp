// Which processes a wall on one machine is made of.
#include "cluster/launch/local_wall.h"

#include <gmock/gmock.h>

#include <memory>
#include <thread>

#include "core/error.h"

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

Wall wall_of(int columns, int rows) {
  WallGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.width_m = columns;
  grid.height_m = rows;
  grid.tile_width_px = grid.tile_height_px = 100;
  return expand_wall(grid, {}, {});
}

const LaunchRequest kRequest{.program = "/opt/vindu",
                             .wall_file = "my wall; rm -rf $HOME.toml",
                             .master_arguments = {"it's \"a\" model.glb", "--mode", "loop"},
                             .tile_arguments = {"--headless"}};

TEST(LocalWall, HasAMasterAndATileInEachProcess) {
  const auto plans = local_wall(kRequest, wall_of(2, 1), 1);
  ASSERT_THAT(plans, SizeIs(3));
  EXPECT_TRUE(plans[0].leads);
  EXPECT_THAT(plans[0].words, ElementsAre("/opt/vindu", "master", "--wall", kRequest.wall_file,
                                          "it's \"a\" model.glb", "--mode", "loop"));
  EXPECT_EQ(plans[2].name, "tile-1-0");
  EXPECT_FALSE(plans[2].leads);
  EXPECT_THAT(plans[2].words, ElementsAre("/opt/vindu", "tile", "tile-1-0", "--wall",
                                          kRequest.wall_file, "--headless"));
}

TEST(LocalWall, PutsSeveralTilesIntoAProcess) {
  const auto plans = local_wall(kRequest, wall_of(3, 2), 4);
  ASSERT_THAT(plans, SizeIs(3));
  EXPECT_EQ(plans[1].name, "tile-0-[0-1],tile-[1-2]-0");
  EXPECT_THAT(plans[2].words, ElementsAre("/opt/vindu", "tile", "tile-1-1", "tile-2-1", "--wall",
                                          kRequest.wall_file, "--headless"));
}

TEST(WallClaim, IsWaitedForUntilItsHolderEnds) {
  const ClusterConfig cluster{.name = "waited-for"};
  EXPECT_TRUE(wait_until_ended(cluster, Duration::zero()));
  auto claim = std::make_unique<WallClaim>(cluster);
  EXPECT_FALSE(wait_until_ended(cluster, std::chrono::milliseconds(1)));
  std::thread holder([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    claim.reset();
  });
  EXPECT_TRUE(wait_until_ended(cluster, std::chrono::seconds(60)));
  holder.join();
}

TEST(WallClaim, IsHeldByOneAndGivenBack) {
  const ClusterConfig here{.name = "claimed" + std::to_string(getpid())};
  {
    const WallClaim first(here);
    EXPECT_THROW(WallClaim{here}, Error);
    EXPECT_NO_THROW(WallClaim({.name = here.name, .domain = 1}));
  }
  EXPECT_NO_THROW(WallClaim{here});
}

}  // namespace
}  // namespace vindu
