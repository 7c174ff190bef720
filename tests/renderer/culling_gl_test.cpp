// Leaving out what is not in view must never change a picture: random boxes, eyes and tiles.
#include <cstdio>
#include <random>

#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;

constexpr int kTrials = 6000;

class Random {
 public:
  double between(double least, double largest) {
    return std::uniform_real_distribution<double>(least, largest)(engine_);
  }
  Vec3 in_box(const Vec3& least, const Vec3& largest) {
    return {between(least.x(), largest.x()), between(least.y(), largest.y()),
            between(least.z(), largest.z())};
  }
  std::size_t index(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_);
  }
  Mat3 rotation() {
    return Eigen::AngleAxisd(between(0, kPi), in_box({-1, -1, -1}, {1, 1, 1}).normalized())
        .toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_{20260101};
};

/// The thesis' wall, flat or bent, or its upper right tile tilted.
Wall random_wall(Random& random) {
  WallGrid grid{.columns = 7,
                .rows = 4,
                .width_m = 5.185,
                .height_m = 2.238,
                .tile_width_px = 1024,
                .tile_height_px = 768,
                .mount = {}};
  if (random.index(3) == 0) grid.curve_deg = random.between(5, 60);
  Wall wall = expand_wall(grid, {}, {});
  wall.tiles.back().corners.upper_left_in_wall.z() += 0.2;
  return wall;
}

/// In the middle of the room, 0.3 m from the wall, beside it, or nearly in its plane.
Vec3 random_eye(Random& random) {
  switch (random.index(4)) {
    case 0:
      return random.in_box({-2.5, -1, 0.5}, {2.5, 1, 4});
    case 1:
      return random.in_box({-2.5, -1, 0.25}, {2.5, 1, 0.35});
    case 2:
      return random.in_box({-8, -1, 0.1}, {-3, 1, 3});
    default:
      return random.in_box({-3, -2, 0.011}, {3, 2, 0.05});
  }
}

/// A point on the ray through a point near the tile's border: where a frustum that is a little too
/// narrow would cut.
Vec3 near_border(Random& random, const TileCorners& corners, const Vec3& eye_in_wall) {
  double across = random.between(0, 1), along = random.index(2) ? 0.06 : 0.94;
  along += random.between(-0.08, 0.08);
  if (random.index(2)) std::swap(across, along);
  const Vec3 on_tile = corners.lower_left_in_wall +
                       across * (corners.lower_right_in_wall - corners.lower_left_in_wall) +
                       along * (corners.upper_left_in_wall - corners.lower_left_in_wall);
  return eye_in_wall + std::pow(10, random.between(-1, 1)) * (on_tile - eye_in_wall);
}

/// Long and thin, flat or round; at the frustum's border, around the eye, or anywhere.
Mat4 random_box(Random& random, const TileCorners& corners, const Vec3& eye_in_wall) {
  const std::size_t kind = random.index(3);
  const Vec3 middle = kind == 0   ? near_border(random, corners, eye_in_wall)
                      : kind == 1 ? eye_in_wall + random.in_box({-.5, -.5, -.5}, {.5, .5, .5})
                                  : random.in_box({-8, -5, -20}, {8, 5, 5});
  const double border_m = 0.03 * (middle - eye_in_wall).norm();
  const Vec3 size_exponents = random.in_box({-3, -3, -3}, {1, 1, 1});
  const Vec3 half_size =
      kind == 0
          ? Vec3(border_m * random.in_box({.1, .1, .1}, {1, 1, 1}))
          : Vec3(size_exponents.unaryExpr([](double exponent) { return std::pow(10, exponent); }));
  Mat4 wall_from_cube = Mat4::Identity();
  wall_from_cube.topLeftCorner<3, 3>() = random.rotation() * half_size.asDiagonal();
  wall_from_cube.topRightCorner<3, 1>() = middle;
  return wall_from_cube;
}

/// Draws one scene on a small canvas.
class Tester {
 public:
  int drawn_pixels(const View& view, GpuScene& scene, const Mat4& wall_from_scene, bool& culled) {
    scene.pose(wall_from_scene, 0);
    const GpuScene* scenes[] = {&scene};
    canvas_.begin();
    culled = renderer_.draw(view, scenes).culled > 0;
    canvas_.resolve(picture_);
    const Image image = picture_.read();
    return static_cast<int>(std::ranges::count(image.pixels, kWhite));
  }

 private:
  static constexpr SizePx kSize{32, 24};
  SceneRenderer renderer_{Style::unlit};
  Canvas canvas_{kSize, Look{Style::unlit}};
  Picture picture_{kSize, Style::unlit};
};

class CullingGl : public GlTest {};

/// The same cube, its bounds so large that it is never left out.
Scene cube_never_culled() {
  Scene scene = cube_scene(plain(1, 1, 1));
  scene.meshes.front().bounds_in_node =
      Box3f(Eigen::Vector3f::Constant(-1e7f), Eigen::Vector3f::Constant(1e7f));
  return scene;
}

TEST_F(CullingGl, NeverLeavesOutABoxThatHasAPixel) {
  Random random;
  Tester tester;
  GpuScene cube = uploaded(pack(cube_scene(plain(1, 1, 1))), Look{Style::unlit});
  GpuScene whole = uploaded(pack(cube_never_culled()), Look{Style::unlit});
  int culled_boxes = 0, seen = 0, drawn_for_nothing = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Wall wall = random_wall(random);
    const Vec3 eye = random_eye(random);
    const Tile& tile = wall.tiles[random.index(wall.tiles.size())];
    const auto view = tile_view(tile.corners, eye);
    if (!view) continue;
    const Mat4 wall_from_cube = random_box(random, tile.corners, eye);
    bool culled = false, never = false;
    const int with_culling = tester.drawn_pixels(*view, cube, wall_from_cube, culled);
    const int without = tester.drawn_pixels(*view, whole, wall_from_cube, never);
    ASSERT_FALSE(never);
    ASSERT_EQ(with_culling, without) << tile.name << " for the eye " << eye.transpose();
    culled_boxes += culled;
    seen += without > 0;
    drawn_for_nothing += !culled && without == 0;
  }
  std::printf("%d boxes seen, %d left out, %d drawn without a pixel\n", seen, culled_boxes,
              drawn_for_nothing);
  EXPECT_GT(seen, 500);
  EXPECT_GT(culled_boxes, 2000);
}

TEST_F(CullingGl, LeavesOutMostOfWhatATileDoesNotShow) {
  Scene scene;
  for (int index = 0; index < 100; ++index)
    add_square(scene, plain(1, 1, 1),
               moved_by(static_cast<float>(index) - 50, 0, -1) * scaled_by(.4f, .4f, 1));
  GpuScene gpu_scene = uploaded(pack(scene), Look{Style::unlit});
  const SceneRenderer renderer(Style::unlit);
  Canvas canvas(kStage_px, Look{Style::unlit});
  const GpuScene* scenes[] = {&gpu_scene};
  canvas.begin();
  const DrawCount count = renderer.draw(*tile_view(stage(), {0, 0, 2}), scenes);
  EXPECT_EQ(count.draws, 100);
  EXPECT_GE(count.culled, 95);
  EXPECT_LT(count.culled, 100);
}

}  // namespace
}  // namespace vindu
