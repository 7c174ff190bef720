// A wall's frame: tiles in their places, tiles that cannot be drawn, scenes that are replaced, and
// what the viewer sees of all that.
#include "renderer/wall_renderer.h"

#include "core/error.h"
#include "renderer/eye_picture.h"
#include "renderer/scene_preparation.h"
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class WallRendererGl : public GlTest {};

FrameState seen_from(const Vec3& eye_in_wall) {
  FrameState state;
  state.eye_in_wall = eye_in_wall;
  return state;
}

/// 3 x 2 tiles of 1 m and 20 pixels.
Wall small_wall(double bezel_mm = 0) {
  WallGrid grid{.columns = 3,
                .rows = 2,
                .width_m = 3 + 2e-3 * bezel_mm,
                .height_m = 2 + 1e-3 * bezel_mm,
                .tile_width_px = 20,
                .tile_height_px = 20,
                .bezel_x_mm = bezel_mm,
                .bezel_y_mm = bezel_mm,
                .mount = {}};
  return expand_wall(grid, {}, {});
}

/// A coloured square in the screen plane for each tile of small_wall(), its number in red.
Scene numbered_squares() {
  Scene scene;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column)
      add_square(scene, plain(static_cast<float>(10 + 3 * row + column) / 255, 0, 0),
                 moved_by(static_cast<float>(column) - 1, static_cast<float>(row) - 0.5f, 0) *
                     scaled_by(.5f, .5f, 1));
  return scene;
}

TEST_F(WallRendererGl, DrawsEveryTileAtItsPlace) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  wall.show(pack(numbered_squares()));
  const WallFrame frame = wall.draw(seen_from({0.7, 0.2, 1.1}));
  EXPECT_THAT(frame.black_tiles, IsEmpty());
  for (std::size_t index = 0; index < 6; ++index) {
    const auto number = static_cast<std::uint8_t>(10 + index);
    EXPECT_THAT(wall.read_tile(index).pixels, Each(Rgba8{number, 0, 0, 255})) << index;
  }
  const Image whole = wall.picture().read();
  EXPECT_EQ(whole.at(0, 39)[0], 10);  // lower left
  EXPECT_EQ(whole.at(59, 0)[0], 15);  // upper right
}

TEST_F(WallRendererGl, LeavesBezelsBlack) {
  WallRenderer wall(small_wall(100), 1, Look{Style::unlit});
  wall.show(pack(square_scene(plain(1, 1, 1), scaled_by(5, 5, 1))));
  wall.draw({});
  const Image whole = wall.picture().read();
  EXPECT_EQ(whole.width_px, 64);
  EXPECT_EQ(whole.at(19, 5), kWhite);
  EXPECT_EQ(whole.at(20, 5), kBlack);
  EXPECT_EQ(whole.at(21, 5), kBlack);
  EXPECT_EQ(whole.at(22, 5), kWhite);
}

TEST_F(WallRendererGl, DrawsOneTileAlone) {
  const Wall geometry = small_wall();
  WallRenderer wall(geometry, 1, Look{Style::unlit});
  wall.show(pack(numbered_squares()));
  wall.draw({}, geometry.find("tile-1-1"));
  EXPECT_THAT(wall.read_tile(4).pixels, Each(Rgba8{14, 0, 0, 255}));
  EXPECT_THAT(wall.read_tile(3).pixels, Each(kBlack));
  EXPECT_THAT(wall.read_tile(1).pixels, Each(kBlack));
}

TEST_F(WallRendererGl, DrawsTilesOfSeveralPixelSizes) {
  Wall geometry = small_wall();
  geometry.tiles[5].width_px = 31;
  WallRenderer wall(geometry, 1, Look{Style::unlit});
  wall.show(pack(numbered_squares()));
  wall.draw({});
  EXPECT_EQ(wall.read_tile(5).width_px, 31);
  EXPECT_THAT(wall.read_tile(5).pixels, Each(Rgba8{15, 0, 0, 255}));
  EXPECT_THAT(wall.read_tile(0).pixels, Each(Rgba8{10, 0, 0, 255}));
}

TEST_F(WallRendererGl, BlackensATileWhoseBackTheEyeSeesAndNamesIt) {
  Wall geometry = small_wall();
  // tile-0-0 turned about its left edge by a quarter: it faces right.
  geometry.tiles[0].corners = {{-1.5, -1, 0}, {-1.5, -1, -1}, {-1.5, 0, 0}};
  WallRenderer wall(geometry, 1, Look{Style::lit});
  wall.show(pack(square_scene(plain(1, 1, 1), moved_by(0, 0, -1) * scaled_by(50, 50, 1))));
  const WallFrame from_left = wall.draw(seen_from({-2.5, 0, 2}));
  const Image black = wall.read_tile(0);
  const WallFrame from_right = wall.draw(seen_from({1, 0, 2}));
  EXPECT_THAT(from_left.black_tiles, ElementsAre("tile-0-0"));
  EXPECT_THAT(black.pixels, Each(kBlack));
  EXPECT_THAT(from_right.black_tiles, IsEmpty());
  EXPECT_THAT(wall.read_tile(0).pixels, Each(::testing::Not(kBlack)));
}

TEST_F(WallRendererGl, BlackensAllTilesForAnEyeBehindTheWallAndComesBack) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  wall.show(pack(square_scene(plain(1, 1, 1), scaled_by(5, 5, 1))));
  wall.draw({});
  EXPECT_EQ(wall.draw(seen_from({0, 0, -1})).black_tiles.size(), 6u);
  EXPECT_THAT(wall.picture().read().pixels, Each(kBlack));
  EXPECT_THAT(wall.draw({}).black_tiles, IsEmpty());
  EXPECT_THAT(wall.picture().read().pixels, Each(kWhite));
}

TEST_F(WallRendererGl, DrawsNothingBeforeASceneIsShown) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  EXPECT_EQ(wall.draw({}).count.draws, 0);
  EXPECT_THAT(wall.picture().read().pixels, Each(kBlack));
}

TEST_F(WallRendererGl, ReplacesTheScene) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  wall.show(pack(square_scene(plain(1, 0, 0), scaled_by(5, 5, 1))));
  wall.draw({});
  wall.show(pack(square_scene(plain(0, 0, 1), scaled_by(5, 5, 1))));
  wall.draw({});
  EXPECT_THAT(wall.picture().read().pixels, Each(kBlue));
}

/// 700 x 700 points of all colours, 17 MB with their triangles, over a picture of 5 MB.
Scene large_scene() {
  constexpr int kSide = 700;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  const auto along = [](std::uint32_t at) { return static_cast<float>(at) / kSide; };
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const auto red = static_cast<std::uint8_t>(x), green = static_cast<std::uint8_t>(y);
      vertices.push_back({.position_in_node = {2 * along(x) - 1, 2 * along(y) - 1, 0},
                          .uv = {along(x), along(y)},
                          .colour = {red, green, 99, 255}});
      const std::uint32_t at = y * kSide + x;
      if (x > 0 && y > 0)
        indices.insert(indices.end(), {at, at - 1, at - kSide, at - kSide, at - 1, at - kSide - 1});
    }
  Material material = plain(1, 1, 1);
  material.double_sided = true;
  material.texture(TextureRole::base_colour).image = 0;
  Scene scene;
  const int mesh = add_mesh(scene, vertices, indices, material);
  scene.nodes.push_back(empty_node(scaled_by(5, 5, 1)));
  scene.nodes.back().meshes = {mesh};
  scene.textures.push_back(Image::filled(1024, 1024, {200, 150, 250, 255}));
  return scene;
}

TEST_F(WallRendererGl, TakesASceneThatCameToTheGpuInShortStepsBesideTheOneThatIsShown) {
  for (const Style style : {Style::unlit, Style::lit}) {
    const Look look{style, 1, Shadows::none};
    WallRenderer wall(small_wall(), 1, look);
    wall.show(pack(large_scene()));
    wall.draw({});
    const Image at_once = wall.picture().read();
    wall.show(pack(square_scene(plain(1, 0, 0), scaled_by(5, 5, 1))));
    ScenePreparation coming(pack(large_scene()), look);
    int steps = 1;
    for (; !coming.step(); ++steps) {
      wall.draw({});
      ASSERT_THAT(wall.picture().read().pixels, Each(kRed)) << "after step " << steps;
    }
    EXPECT_GE(steps, 5);
    wall.prepare(coming.take());
    wall.draw({});
    EXPECT_THAT(wall.picture().read().pixels, Each(kRed));
    wall.show_prepared();
    wall.draw({});
    EXPECT_EQ(wall.picture().read().pixels, at_once.pixels);
    EXPECT_NE(at_once.at(10, 10), at_once.at(50, 30));
  }
}

TEST_F(WallRendererGl, FollowsNavigation) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  wall.show(pack(square_scene(plain(1, 1, 1))));
  FrameState state = seen_from({0, 0, 2});
  state.navigation.scale = 0.5;
  state.navigation.wall_from_scene.translation = {-1, 0.5, 0};
  wall.draw(state);
  const Image whole = wall.picture().read();
  EXPECT_EQ(std::ranges::count(whole.pixels, kWhite), 20 * 20);
  EXPECT_EQ(whole.at(0, 0), kWhite);
  EXPECT_EQ(whole.at(20, 0), kBlack);
}

TEST_F(WallRendererGl, DrawsTheSameBitsAgain) {
  WallRenderer wall(small_wall(), 3, Look{Style::lit});
  Material lit = plain(.6f, .3f, .2f);
  lit.unlit = false;
  wall.show(pack(cube_scene(lit)));
  FrameState state = seen_from({0.3, 0.2, 1.7});
  state.navigation.wall_from_scene = {Quat(Eigen::AngleAxisd(.7, Vec3(1, 2, 3).normalized())),
                                      {0.1, 0, -1}};
  wall.draw(state);
  const Image once = wall.picture().read();
  wall.draw(seen_from({-1, 0, 1}));
  EXPECT_NE(wall.picture().read(), once);
  wall.draw(state);
  EXPECT_EQ(wall.picture().read(), once);
}

TEST_F(WallRendererGl, RefusesAWallThatIsTooLargeForTheGpu) {
  try {
    WallRenderer wall(single_screen(5, 2, 1 << 20, 100), 1, Look{Style::lit});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("1048576x100"));
    EXPECT_THAT(error.what(), HasSubstr("--scale"));
  }
}

TEST_F(WallRendererGl, ShowsTheEyeTheWallsPicture) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  wall.show(pack(numbered_squares()));
  const Vec3 eye(0, 0, 3);
  wall.draw(seen_from(eye));
  const Image seen = picture_from_eye(wall, eye, {300, 200});
  EXPECT_EQ(seen.at(60, 150)[0], 10);   // tile-0-0, lower left
  EXPECT_EQ(seen.at(240, 150)[0], 12);  // tile-2-0
  EXPECT_EQ(seen.at(60, 50)[0], 13);    // tile-0-1, above it
  EXPECT_EQ(seen.at(0, 0), kBlack);     // beside the wall
}

class EyesOfNoUse : public WallRendererGl, public ::testing::WithParamInterface<Vec3> {};

TEST_P(EyesOfNoUse, StillGiveAPicture) {
  WallRenderer wall(small_wall(), 1, Look{Style::unlit});
  wall.show(pack(numbered_squares()));
  wall.draw(seen_from(GetParam()));
  EXPECT_EQ(picture_from_eye(wall, GetParam(), {30, 20}).width_px, 30);
}

INSTANTIATE_TEST_SUITE_P(WallRendererGl, EyesOfNoUse,
                         ::testing::Values(Vec3(0, 0, 0), Vec3(0, 3, 0), Vec3(0, -3, 0),
                                           Vec3(0, 0, -2), Vec3(9, 0, 0)));

}  // namespace
}  // namespace vindu
