// A wall's tiles from a grid of a few numbers: flat, with bezels, curved, with exceptions.
#include "core/wall.h"

#include "tests/core/matchers.h"
#include "tests/core/random_walls.h"

namespace vindu {
namespace {

using testing::IsNearPoint;
using testing::IsNearRotation;
using testing::tromso_grid;

constexpr double kExact_m = 1e-12;

const TileCorners& corners_of(const Wall& wall, int column, int row) {
  return wall.find(tile_name(column, row))->corners;
}

TEST(FlatWall, CountsTilesFromTheLowerLeft) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  ASSERT_EQ(wall.tiles.size(), 28u);
  EXPECT_EQ(wall.tiles.front().name, "tile-0-0");
  EXPECT_EQ(wall.tiles.back().name, "tile-6-3");
  EXPECT_THAT(corners_of(wall, 0, 0).lower_left_in_wall,
              IsNearPoint(Vec3(-5.185 / 2, -2.238 / 2, 0), kExact_m));
  EXPECT_THAT(corners_of(wall, 6, 3).upper_right_in_wall(),
              IsNearPoint(Vec3(5.185 / 2, 2.238 / 2, 0), kExact_m));
}

TEST(FlatWall, HasNeitherGapsNorOverlaps) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 6; ++column) {
      const TileCorners& tile = corners_of(wall, column, row);
      EXPECT_THAT(tile.lower_right_in_wall,
                  IsNearPoint(corners_of(wall, column + 1, row).lower_left_in_wall, kExact_m));
      EXPECT_THAT(tile.upper_left_in_wall,
                  IsNearPoint(corners_of(wall, column, row + 1).lower_left_in_wall, kExact_m));
    }
}

TEST(FlatWall, FacesTheViewer) {
  for (const Tile& tile : expand_wall(tromso_grid(), {}, {}).tiles)
    EXPECT_THAT(tile.corners.normal_in_wall(), IsNearPoint(Vec3(0, 0, 1), kExact_m));
}

TEST(TileCorners, KnowTheirCentreAndSize) {
  const TileCorners tile{{1, 2, 0}, {4, 2, 4}, {1, 4, 0}};
  EXPECT_DOUBLE_EQ(tile.width_m(), 5);
  EXPECT_DOUBLE_EQ(tile.height_m(), 2);
  EXPECT_THAT(tile.centre_in_wall(), IsNearPoint(Vec3(2.5, 3, 2), kExact_m));
  EXPECT_THAT(tile.upper_right_in_wall(), IsNearPoint(Vec3(4, 4, 4), kExact_m));
  EXPECT_THAT(tile.normal_in_wall(), IsNearPoint(Vec3(-0.8, 0, 0.6), kExact_m));
}

TEST(TileCorners, HaveTheirOwnFrameInTheMiddleOfThePicture) {
  const TileCorners tile{{1, 2, 0}, {4, 2, 4}, {1, 4, 0}};
  EXPECT_THAT(tile.wall_from_screen() * Vec3(-2.5, -1, 0), IsNearPoint(Vec3(1, 2, 0), kExact_m));
  EXPECT_THAT(tile.wall_from_screen() * Vec3(2.5, -1, 0), IsNearPoint(Vec3(4, 2, 4), kExact_m));
  EXPECT_THAT(tile.wall_from_screen() * Vec3(-2.5, 1, 0), IsNearPoint(Vec3(1, 4, 0), kExact_m));
}

TEST(Bezels, LieBetweenPicturesAndLeaveTheOuterSizeAsItIs) {
  WallGrid grid = tromso_grid();
  grid.bezel_x_mm = 10;
  grid.bezel_y_mm = 20;
  const Wall wall = expand_wall(grid, {}, {});
  EXPECT_THAT(corners_of(wall, 0, 0).lower_left_in_wall,
              IsNearPoint(Vec3(-5.185 / 2, -2.238 / 2, 0), kExact_m));
  EXPECT_THAT(corners_of(wall, 6, 3).upper_right_in_wall(),
              IsNearPoint(Vec3(5.185 / 2, 2.238 / 2, 0), kExact_m));
  const Vec3 gap_x =
      corners_of(wall, 4, 1).lower_left_in_wall - corners_of(wall, 3, 1).lower_right_in_wall;
  const Vec3 gap_y =
      corners_of(wall, 3, 2).lower_left_in_wall - corners_of(wall, 3, 1).upper_left_in_wall;
  EXPECT_THAT(gap_x, IsNearPoint(Vec3(0.010, 0, 0), kExact_m));
  EXPECT_THAT(gap_y, IsNearPoint(Vec3(0, 0.020, 0), kExact_m));
}

/// A curved wall of so many columns; odd numbers have a column in the middle, even ones a seam.
class CurvedWall : public ::testing::TestWithParam<int> {
 protected:
  Wall wall(double curve_deg = 30, double bezel_x_mm = 0) const {
    WallGrid grid = tromso_grid();
    grid.columns = GetParam();
    grid.curve_deg = curve_deg;
    grid.bezel_x_mm = bezel_x_mm;
    return expand_wall(grid, {}, {});
  }
  int last() const { return GetParam() - 1; }
};

TEST_P(CurvedWall, NeighboursShareAnEdge) {
  const Wall curved = wall();
  for (int column = 0; column < last(); ++column) {
    const TileCorners &left = corners_of(curved, column, 0),
                      &right = corners_of(curved, column + 1, 0);
    EXPECT_THAT(left.lower_right_in_wall, IsNearPoint(right.lower_left_in_wall, kExact_m));
    EXPECT_THAT(left.upper_right_in_wall(), IsNearPoint(right.upper_left_in_wall, kExact_m));
  }
}

TEST_P(CurvedWall, KeepsTheSizeOfItsPictures) {
  for (const Tile& tile : wall().tiles) {
    EXPECT_NEAR(tile.corners.width_m(), 5.185 / GetParam(), kExact_m);
    EXPECT_NEAR(tile.corners.height_m(), 2.238 / 4, kExact_m);
  }
}

TEST_P(CurvedWall, TurnsEveryColumnByTheSameAngleTowardsTheViewer) {
  const Wall curved = wall();
  const Vec3 first = corners_of(curved, 0, 0).normal_in_wall();
  const Vec3 final = corners_of(curved, last(), 0).normal_in_wall();
  EXPECT_NEAR(degrees(std::acos(first.dot(final))), 30, 1e-9);
  EXPECT_GT(first.x(), 0);  // the left column looks to the right
  EXPECT_LT(final.x(), 0);
  for (int column = 0; column < last(); ++column) {
    const Vec3 here = corners_of(curved, column, 0).normal_in_wall();
    const Vec3 next = corners_of(curved, column + 1, 0).normal_in_wall();
    EXPECT_NEAR(degrees(std::acos(here.dot(next))), 30.0 / last(), 1e-6);
  }
}

TEST_P(CurvedWall, NormalsFromTheMiddlesMeetOnOneAxis) {
  const Wall curved = wall();
  const auto axis_seen_from = [&](int column) -> Vec3 {
    const TileCorners& tile = corners_of(curved, column, 0);
    const Vec3 middle = 0.5 * (tile.lower_left_in_wall + tile.lower_right_in_wall);
    const double step_rad = radians(30.0) / last();
    return middle + tile.normal_in_wall() * (tile.width_m() / 2) / std::tan(step_rad / 2);
  };
  for (int column = 0; column <= last(); ++column)
    EXPECT_THAT(axis_seen_from(column), IsNearPoint(axis_seen_from(0), 1e-9));
  EXPECT_NEAR(axis_seen_from(0).x(), 0, 1e-9);
  EXPECT_GT(axis_seen_from(0).z(), 0);
}

TEST_P(CurvedWall, HasItsMiddleAtTheOriginAndBendsTowardsTheViewer) {
  const Wall curved = wall();
  const int middle = GetParam() / 2;
  const TileCorners& tile = corners_of(curved, middle, 0);
  const Vec3 nearest = GetParam() % 2 == 1
                           ? Vec3(0.5 * (tile.lower_left_in_wall + tile.lower_right_in_wall))
                           : tile.lower_left_in_wall;
  EXPECT_THAT(nearest, IsNearPoint(Vec3(0, -2.238 / 2, 0), kExact_m));
  for (const Tile& each : curved.tiles) {
    EXPECT_GE(each.corners.lower_left_in_wall.z(), -kExact_m);
    EXPECT_GE(each.corners.lower_right_in_wall.z(), -kExact_m);
  }
}

TEST_P(CurvedWall, IsMirrorSymmetric) {
  const Wall curved = wall(50, 6);
  for (int column = 0; column <= last(); ++column) {
    const Vec3 left = corners_of(curved, column, 2).lower_left_in_wall;
    const Vec3 right = corners_of(curved, last() - column, 2).lower_right_in_wall;
    EXPECT_THAT(left, IsNearPoint(Vec3(-right.x(), right.y(), right.z()), kExact_m));
  }
}

TEST_P(CurvedWall, BecomesFlatAsTheAngleVanishes) {
  const Wall nearly_flat = wall(1e-6), flat = wall(0);
  for (std::size_t i = 0; i < flat.tiles.size(); ++i)
    EXPECT_THAT(nearly_flat.tiles[i].corners.lower_left_in_wall,
                IsNearPoint(flat.tiles[i].corners.lower_left_in_wall, 1e-7));
}

INSTANTIATE_TEST_SUITE_P(Columns, CurvedWall, ::testing::Values(2, 3, 4, 7, 8),
                         ::testing::PrintToStringParamName());

TEST(CurvedWallOfOneColumn, IsFlat) {
  WallGrid grid = tromso_grid();
  grid.columns = 1;
  grid.curve_deg = 30;
  EXPECT_THAT(expand_wall(grid, {}, {}).tiles[0].corners.lower_left_in_wall,
              IsNearPoint(Vec3(-5.185 / 2, -2.238 / 2, 0), kExact_m));
}

TEST(Overrides, ChangeWhatTheyNameAndNothingElse) {
  const TileCorners measured{{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}};
  WallGrid grid = tromso_grid();
  grid.mount = {.mirror = true, .rotate_deg = 0};
  const Wall wall = expand_wall(grid,
                                {{.name = "tile-3-1", .corners = measured, .host = {}, .mount = {}},
                                 {.name = "tile-0-0",
                                  .corners = {},
                                  .host = "spare",
                                  .mount = TileMount{.mirror = false, .rotate_deg = 90}}},
                                {});
  const Tile &moved = *wall.find("tile-3-1"), &replaced = *wall.find("tile-0-0");
  EXPECT_THAT(moved.corners.upper_left_in_wall, IsNearPoint(Vec3(0, 1, 0.1), 0));
  EXPECT_EQ(moved.host, "tile-3-1");
  EXPECT_TRUE(moved.mount.mirror);
  EXPECT_EQ(replaced.host, "spare");
  EXPECT_EQ(replaced.mount, (TileMount{.mirror = false, .rotate_deg = 90}));
  EXPECT_THAT(replaced.corners.lower_left_in_wall,
              IsNearPoint(Vec3(-5.185 / 2, -2.238 / 2, 0), kExact_m));
}

TEST(Hosts, FollowThePattern) {
  EXPECT_EQ(expand_host("tile-{x}-{y}", 6, 3), "tile-6-3");
  EXPECT_EQ(expand_host("pc{y}{x}.lab", 12, 0), "pc012.lab");
  EXPECT_EQ(expand_host("{x}{x}", 1, 2), "11");
  EXPECT_EQ(expand_host("localhost", 1, 2), "localhost");
  EXPECT_EQ(expand_host("", 1, 2), "");
}

TEST(Wall, FindsATileByItsNameOnly) {
  const Wall wall = expand_wall(tromso_grid(), {}, {});
  ASSERT_NE(wall.find("tile-6-3"), nullptr);
  EXPECT_EQ(wall.find("tile-6-3")->column, 6);
  EXPECT_EQ(wall.find("tile-6-3")->row, 3);
  EXPECT_EQ(wall.find("tile-7-0"), nullptr);
  EXPECT_EQ(wall.find(""), nullptr);
}

TEST(Wall, HasOnePixelPitch) {
  EXPECT_NEAR(1e3 * expand_wall(tromso_grid(), {}, {}).pixel_pitch_m(), 0.7234, 1e-4);
}

TEST(PointOfPicture, CountsPixelsFromTheUpperLeftOfAllTilesTogether) {
  const Wall wall = expand_wall(tromso_grid(), {}, room_from_wall_at(1.55, 0));
  const auto point = point_of_picture(wall, {7168 - 512, 384});
  ASSERT_TRUE(point);
  EXPECT_EQ(point->tile->name, "tile-6-3");
  EXPECT_THAT(point->in_wall, IsNearPoint(wall.find("tile-6-3")->corners.centre_in_wall(), 1e-9));
  EXPECT_THAT(point_of_picture(wall, {0, 0})->in_wall,
              IsNearPoint(wall.find("tile-0-3")->corners.upper_left_in_wall, 1e-9));
}

TEST(PointOfPicture, SkipsBezels) {
  WallGrid grid = tromso_grid();
  grid.bezel_x_mm = 50;
  const Wall wall = expand_wall(grid, {}, room_from_wall_at(1.55, 0));
  const Vec3 before = point_of_picture(wall, {1024 - 1e-6, 0})->in_wall;
  const Vec3 after = point_of_picture(wall, {1024, 0})->in_wall;
  EXPECT_NEAR((after - before).x(), 0.050, 1e-6);
}

TEST(PointOfPicture, TakesWhatIsBesideItForItsEdgeAndRefusesWhatIsNoNumber) {
  const Wall wall = expand_wall(tromso_grid(), {}, room_from_wall_at(1.55, 0));
  EXPECT_THAT(point_of_picture(wall, {-1e300, 1e300})->in_wall,
              IsNearPoint(wall.find("tile-0-0")->corners.lower_left_in_wall, 1e-9));
  EXPECT_FALSE(point_of_picture(wall, {std::nan(""), 0}));
}

TEST(Fingerprint, IsThatOfWhatTilesShowAndOfNothingElse) {
  const Wall wall = expand_wall(tromso_grid(), {}, room_from_wall_at(1.55, 0));
  EXPECT_EQ(fingerprint_of(wall).size(), 16u);
  EXPECT_EQ(fingerprint_of(wall),
            fingerprint_of(expand_wall(tromso_grid(), {}, room_from_wall_at(1.4, 2))));

  std::vector<Wall> others(5, wall);
  others[0].tiles[3].corners.upper_left_in_wall.z() += 2e-6;
  others[1].tiles[3].mount.rotate_deg = 180;
  others[2].tiles[3].name = "other";
  others[3].tiles[3].width_px = 1025;
  others[4].tiles.pop_back();
  for (const Wall& other : others) EXPECT_NE(fingerprint_of(other), fingerprint_of(wall));
  others[0].tiles[3].corners.upper_left_in_wall.z() -= 2e-6;
  EXPECT_EQ(fingerprint_of(others[0]), fingerprint_of(wall));
}

TEST(SingleScreen, IsAWallOfOneTileAtTheDefaultHeight) {
  const Wall wall = single_screen(0.6, 0.34, 1920, 1080);
  ASSERT_EQ(wall.tiles.size(), 1u);
  EXPECT_THAT(wall.tiles[0].corners.upper_left_in_wall, IsNearPoint(Vec3(-0.3, 0.17, 0), kExact_m));
  EXPECT_EQ(wall.tiles[0].width_px, 1920);
  EXPECT_EQ(wall.tiles[0].height_px, 1080);
  EXPECT_THAT(wall.room_from_wall.translation, IsNearPoint(Vec3(0, 1.55, 0), 0));
}

TEST(RoomFromWall, LeansTheUpperEdgeTowardsTheViewer) {
  const Rigid3 room_from_wall = room_from_wall_at(1.2, 30);
  EXPECT_THAT(room_from_wall * Vec3(0, 0, 0), IsNearPoint(Vec3(0, 1.2, 0), kExact_m));
  EXPECT_THAT(room_from_wall * Vec3(0, 1, 0),
              IsNearPoint(Vec3(0, 1.2 + std::sqrt(0.75), 0.5), kExact_m));
  EXPECT_THAT(room_from_wall_at(1.2, 0).rotation, IsNearRotation(Quat::Identity(), 0));
}

}  // namespace
}  // namespace vindu
