// Levels of detail in pictures: without holes, as full detail looks, and the same on every tile.
#include "renderer/levels.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <set>

#include "bench/detail/scan.h"
#include "renderer/chunks.h"
#include "renderer/skinning.h"
#include "renderer/wall_renderer.h"
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;

const Scene& scan() {
  static const Scene scene = [] {
    Scene made = scan_scene({.triangles = 150000});
    cut_into_chunks(made);
    make_levels(made);
    return made;
  }();
  return scene;
}

/// The same, of one level.
Scene full_detail() {
  Scene scene = scan_scene({.triangles = 150000});
  cut_into_chunks(scene);
  return scene;
}

constexpr SizePx kSize{256, 192};

/// A screen of 1.6 x 1.2 m; the scan, as a ball of 0.5 m around a place.
FrameState seen_from(const Vec3& eye, const Vec3& middle) {
  FrameState state{.eye_in_wall = eye};
  state.navigation.wall_from_scene.translation = middle;
  state.navigation.scale = 0.5;
  return state;
}

struct Drawn {
  Image picture;
  std::uint64_t triangles = 0;
};

Drawn draw(const Wall& wall, const Look& look, const Scene& scene, const FrameState& state,
           const Tile* only = nullptr) {
  WallRenderer renderer(wall, 1, look);
  renderer.show(pack(scene));
  const WallFrame frame = renderer.draw(state, only);
  return {renderer.picture().read(), frame.count.triangles - frame.count.culled_triangles};
}

Wall one_screen() { return single_screen(1.6, 1.2, kSize.width, kSize.height); }

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t part = 0; part < 3; ++part)
      sum += std::abs(int{a.pixels[i][part]} - int{b.pixels[i][part]});
  return sum / (3.0 * static_cast<double>(a.pixels.size()));
}

/// By more than one level.
int pixels_that_differ(const Image& a, const Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t part = 0; part < 3; ++part)
      count += std::abs(int{a.pixels[i][part]} - int{b.pixels[i][part]}) > 1;
  return count;
}

/// The scan is never black where light is not drawn.
bool is_background(const Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y) * image.width_px + x] == kBlack;
}

class LevelsGl : public GlTest {};

const std::vector<std::pair<Vec3, Vec3>> kEyesAndMiddles = {
    {{0, 0, 2}, {0, 0, -0.6}},       // before it
    {{0.2, 0.1, 0.75}, {0, 0, 0}},   // so near that its front is finer than its sides
    {{-1.5, 0.3, 0.6}, {0, 0, -1}},  // from aside
    {{0, 0, 2}, {0.5, 0, -6}},       // far away
};

TEST_F(LevelsGl, HaveNoHoles) {
  for (const auto& [eye, middle] : kEyesAndMiddles) {
    const FrameState state = seen_from(eye, middle);
    const Image image = draw(one_screen(), Look{Style::unlit}, scan(), state).picture;
    const Image whole = draw(one_screen(), Look{Style::unlit}, full_detail(), state).picture;
    int inside = 0, holes = 0;
    for (int y = 2; y < kSize.height - 2; ++y)
      for (int x = 2; x < kSize.width - 2; ++x) {
        bool border = false;
        for (int dy = -2; dy <= 2; ++dy)
          for (int dx = -2; dx <= 2; ++dx) border |= is_background(whole, x + dx, y + dy);
        if (border) continue;
        ++inside;
        holes += is_background(image, x, y);
      }
    EXPECT_EQ(holes, 0) << eye.transpose();
    EXPECT_GT(inside, 500);
  }
}

TEST_F(LevelsGl, LookLikeFullDetailWithFewerTriangles) {
  for (const auto& [eye, middle] : kEyesAndMiddles) {
    const FrameState state = seen_from(eye, middle);
    for (const Look& look :
         {Look{Style::lit, 4, Shadows::none}, Look{Style::lit, 1, Shadows::crisp},
          Look{Style::lit, 4, Shadows::soft}}) {
      const Drawn levels = draw(one_screen(), look, scan(), state);
      const Drawn full = draw(one_screen(), look, full_detail(), state);
      const double difference = mean_difference(levels.picture, full.picture);
      std::printf("mean difference %.3f levels, %zu of %zu triangles\n", difference,
                  static_cast<std::size_t>(levels.triangles),
                  static_cast<std::size_t>(full.triangles));
      EXPECT_LT(difference, 1) << eye.transpose();
      EXPECT_LT(levels.triangles, full.triangles);
    }
  }
}

/// Against the definition, read off every draw there is.
TEST_F(LevelsGl, AreChosenFromTheTopAsTheyAreDefined) {
  GpuScene scene = uploaded(pack(scan()), Look{Style::unlit});
  scene.pose(Mat4::Identity(), 0);
  for (const double error_m : {0.0, 0.003, 0.01, 0.05, 1e6}) {
    const auto is_fine = [&](int coarsening) {
      return scan().coarsenings[coarsening].error_in_node <= error_m;
    };
    std::set<const GpuScene::Draw*> expected;
    for (const GpuScene::Draw& draw : scene.draws())
      if ((draw.mesh.made_by < 0 || is_fine(draw.mesh.made_by)) &&
          (draw.mesh.replaced_by < 0 || !is_fine(draw.mesh.replaced_by)))
        expected.insert(&draw);
    EXPECT_THAT(scene.draws_within(error_m), ::testing::UnorderedElementsAreArray(expected))
        << error_m;
  }
  EXPECT_THAT(scene.coarsest(), ::testing::UnorderedElementsAreArray(scene.draws_within(1e6)));
}

Wall twelve_tiles() {
  const WallGrid grid{.columns = 4,
                      .rows = 3,
                      .width_m = 1.6,
                      .height_m = 1.2,
                      .tile_width_px = 64,
                      .tile_height_px = 64,
                      .mount = {}};
  return expand_wall(grid, {}, {});
}

/// Of a scene's draws those that its levels' definition chooses and the planes do not miss.
template <class IsFine>
std::set<const GpuScene::Draw*> expected_of(const GpuScene& scene, const ViewPlanes& planes,
                                            IsFine is_fine) {
  std::set<const GpuScene::Draw*> expected;
  for (const GpuScene::Draw& draw : scene.draws())
    if ((draw.mesh.made_by < 0 || is_fine(draw.mesh.made_by)) &&
        (draw.mesh.replaced_by < 0 || !is_fine(draw.mesh.replaced_by)) &&
        !planes.miss(scene.bounds_in_world(draw)))
      expected.insert(&draw);
  return expected;
}

/// What the eye needs and the tile does not miss; the others are counted, none twice.
TEST_F(LevelsGl, ThatATileShowsAreThoseOfTheEyeThatItSees) {
  GpuScene scene = uploaded(pack(scan()), Look{Style::unlit});
  const Wall tiles = twelve_tiles();
  for (const auto& place : kEyesAndMiddles) {
    const Vec3& eye = place.first;
    const Mat4 world_from_scene = matrix_of(Rigid3{.translation = place.second}, 0.5);
    scene.pose(world_from_scene, 0);
    const DetailNeed need = detail_need(tiles, eye, 1);
    const auto is_fine = [&](int coarsening) {
      const Coarsening& level = scan().coarsenings[coarsening];
      return fine_enough(need, eye, moved(level.bounds_in_node, world_from_scene.cast<float>()),
                         0.5 * level.error_in_node);
    };
    std::size_t seen_by_all = 0;
    for (const Tile& tile : tiles.tiles) {
      View view = *tile_view(tile.corners, eye);
      view.detail = need;
      const auto expected = expected_of(scene, ViewPlanes(view.clip_from_world), is_fine);
      const GpuScene::Seen seen = scene.seen_by(view);
      EXPECT_THAT(seen.solid, ::testing::UnorderedElementsAreArray(expected)) << tile.name;
      EXPECT_THAT(seen.blended, ::testing::IsEmpty());
      EXPECT_EQ(seen.count.draws - seen.count.culled, static_cast<int>(expected.size()));
      std::uint64_t triangles = 0;
      for (const GpuScene::Draw* draw : expected) triangles += draw->mesh.index_count / 3;
      EXPECT_EQ(seen.count.triangles - seen.count.culled_triangles, triangles);
      seen_by_all += expected.size();
    }
    EXPECT_GT(seen_by_all, 20u);
  }
}

TEST_F(LevelsGl, MeetAtTheSeamsOfTiles) {
  const Wall tiles = twelve_tiles();
  for (const auto& [eye, middle] : kEyesAndMiddles) {
    const FrameState state = seen_from(eye, middle);
    const Image joined = draw(tiles, Look{Style::unlit}, scan(), state).picture;
    const Image one = draw(one_screen(), Look{Style::unlit}, scan(), state).picture;
    ASSERT_EQ(joined.pixels.size(), one.pixels.size());
    EXPECT_LE(pixels_that_differ(one, joined), 10) << eye.transpose();
  }
}

TEST_F(LevelsGl, OfATileAloneAreThoseOfTheWall) {
  WallGrid grid{.columns = 2,
                .rows = 1,
                .width_m = 1.6,
                .height_m = 1.2,
                .tile_width_px = 128,
                .tile_height_px = 192,
                .mount = {}};
  grid.curve_deg = 40;
  const Wall wall = expand_wall(grid, {}, {});
  const FrameState state = seen_from({-0.4, 0.1, 0.8}, {0, 0, -0.5});
  WallRenderer together(wall, 1, Look{Style::lit, 1}), alone(wall, 1, Look{Style::lit, 1});
  together.show(pack(scan()));
  alone.show(pack(scan()));
  const WallFrame all = together.draw(state), one = alone.draw(state, &wall.tiles[1]);
  EXPECT_EQ(one.tile_counts[1].triangles, all.tile_counts[1].triangles);
  EXPECT_LT(all.tile_counts[1].triangles, scan().triangle_count());
  EXPECT_LE(pixels_that_differ(alone.read_tile(1), together.read_tile(1)), 10);
}

}  // namespace
}  // namespace vindu
