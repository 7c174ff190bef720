// Views against matrices that GLM builds on its own, and the camera that looks at a whole wall.
#include "renderer/view.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/core/matchers.h"

namespace vindu {
namespace {

using testing::IsNearPoint;

/// Where a point comes out, x and y from -1 to 1; depth is judged by the renderer's tests.
Vec2 ndc_of(const View& view, const Vec3& x_in_world) {
  const Vec4 clip = view.clip_from_world * x_in_world.homogeneous();
  return clip.head<2>() / clip.w();
}

glm::dvec3 glm_from(const Vec3& value) { return {value.x(), value.y(), value.z()}; }

Vec2 ndc_by_glm(const Camera& camera, const Vec3& x_in_world) {
  const glm::dmat4 clip_from_world =
      glm::infinitePerspective(camera.fov_y_rad, camera.aspect, 0.01) *
      glm::lookAt(glm_from(camera.eye_in_world), glm_from(camera.target_in_world),
                  glm::dvec3(0, 1, 0));
  const glm::dvec4 clip = clip_from_world * glm::dvec4(glm_from(x_in_world), 1);
  return {clip.x / clip.w, clip.y / clip.w};
}

class RandomPoints {
 public:
  Vec3 next(double reach_m) {
    std::uniform_real_distribution<double> along(-reach_m, reach_m);
    return {along(random_), along(random_), along(random_)};
  }

 private:
  std::mt19937 random_{7};
};

bool before(const Camera& camera, const Vec3& x_in_world) {
  const Vec3 forward = (camera.target_in_world - camera.eye_in_world).normalized();
  return forward.dot(x_in_world - camera.eye_in_world) > 0.1;
}

TEST(CameraView, ShowsEveryPointWhereLookAtAndPerspectiveOfGlmDo) {
  RandomPoints points;
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Camera camera{.eye_in_world = points.next(3),
                        .target_in_world = points.next(3),
                        .fov_y_rad = 0.3 + 0.01 * trial,
                        .aspect = 0.5 + 0.01 * trial};
    const View view = camera_view(camera);
    for (int index = 0; index < 20; ++index) {
      const Vec3 point = points.next(10);
      if (!before(camera, point)) continue;
      const Vec2 wanted = ndc_by_glm(camera, point);
      ASSERT_LE((ndc_of(view, point) - wanted).norm(), 1e-7 * (1 + wanted.norm()));
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(CameraView, HasReversedInfiniteDepth) {
  const View view = camera_view({.eye_in_world = {0, 0, 0}, .target_in_world = {0, 0, -1}});
  const auto depth = [&](double distance_m) {
    const Vec4 clip = view.clip_from_world * Vec4(0, 0, -distance_m, 1);
    return clip.z() / clip.w();
  };
  EXPECT_NEAR(depth(kNear_m), 1, 1e-12);
  EXPECT_NEAR(depth(1), kNear_m, 1e-12);
  EXPECT_GT(depth(1e6), 0);
}

class CameraWithoutADirection : public ::testing::TestWithParam<Vec3> {};

TEST_P(CameraWithoutADirection, StillHasAFiniteView) {
  const View view = camera_view({.eye_in_world = {1, 2, 3}, .target_in_world = GetParam()});
  EXPECT_TRUE(view.clip_from_world.allFinite());
  EXPECT_GT(view.clip_from_world.row(3).head<3>().norm(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(StraightUpStraightDownAndTheEyeItself, CameraWithoutADirection,
                         ::testing::Values(Vec3(1, 7, 3), Vec3(1, -7, 3), Vec3(1, 2, 3)));

Wall tromso_like(double curve_deg = 0) {
  WallGrid grid{.columns = 7,
                .rows = 4,
                .width_m = 5.185,
                .height_m = 2.238,
                .tile_width_px = 1024,
                .tile_height_px = 768,
                .mount = {}};
  grid.curve_deg = curve_deg;
  return expand_wall(grid, {}, {});
}

/// The farthest any corner of the wall lies from the picture's middle; 1 is the border.
double farthest_corner(const Wall& wall, const View& view) {
  double farthest = 0;
  for (const Tile& tile : wall.tiles)
    for (const Vec3& corner : {tile.corners.lower_left_in_wall, tile.corners.lower_right_in_wall,
                               tile.corners.upper_left_in_wall, tile.corners.upper_right_in_wall()})
      farthest = std::max(farthest, ndc_of(view, corner).cwiseAbs().maxCoeff());
  return farthest;
}

struct Onlooker {
  Vec3 eye_in_wall;
  double aspect;
  double curve_deg;
};

class CameraOnWall : public ::testing::TestWithParam<Onlooker> {};

TEST_P(CameraOnWall, HasAllCornersInViewAndFillsThePicture) {
  const auto& [eye, aspect, curve_deg] = GetParam();
  const Wall wall = tromso_like(curve_deg);
  const View view = camera_view(camera_on_wall(wall, eye, aspect));
  const double farthest = farthest_corner(wall, view);
  EXPECT_LE(farthest, 1.0);
  EXPECT_GE(farthest, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Eyes, CameraOnWall,
                         ::testing::Values(Onlooker{{0, 0.1, 2}, 16.0 / 9, 0},
                                           Onlooker{{-2, 0.5, 2.5}, 16.0 / 9, 0},
                                           Onlooker{{3, -1, 6}, 1.0, 0},
                                           Onlooker{{0, 0, 40}, 0.5, 0},
                                           Onlooker{{0.5, 0.2, 2.5}, 16.0 / 9, 60}));

TEST(CameraOnWall, IsNeverWiderThanAPictureCanBeLookedAt) {
  for (const Vec3& eye : {Vec3(0, 0, 0.05), Vec3(2.5, 0, 0.1), Vec3(-4, 0, 0.01), Vec3(0, 3, 0)})
    for (const double aspect : {0.5, 16.0 / 9, 3.0}) {
      const Camera camera = camera_on_wall(tromso_like(), eye, aspect);
      const double half_height = std::tan(camera.fov_y_rad / 2);
      EXPECT_LE(std::atan(half_height), radians(60) + 1e-9);
      EXPECT_LE(std::atan(half_height * aspect), radians(70) + 1e-9);
      EXPECT_GT(camera.fov_y_rad, 0);
    }
}

TEST(DirectionFromNdc, PointsAtWhatIsSeenThere) {
  const TileCorners corners{{-1, -0.5, 0}, {1, -0.4, 0.3}, {-1.1, 0.6, 0.1}};
  RandomPoints points;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 eye = Vec3(0, 0, 2.5) + points.next(1.5);
    const auto view = tile_view(corners, eye);
    ASSERT_TRUE(view);
    const Vec3 point = corners.centre_in_wall() + points.next(0.5);
    const Vec2 ndc = ndc_of(*view, point);
    const Vec3 direction = direction_from_ndc(*view) * Vec3(ndc.x(), ndc.y(), 1);
    EXPECT_THAT(direction.normalized(), IsNearPoint((point - eye).normalized(), 1e-9));
  }
}

TEST(TileView, IsEmptyForAnEyeAtOrBehindTheTile) {
  const TileCorners corners{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  EXPECT_TRUE(tile_view(corners, {0, 0, 0.02}));
  EXPECT_FALSE(tile_view(corners, {0, 0, 0}));
  EXPECT_FALSE(tile_view(corners, {5, 0, 0}));
  EXPECT_FALSE(tile_view(corners, {0, 0, -1}));
}

TEST(TileView, PutsTheTilesCornersInThePicturesCorners) {
  const TileCorners corners{{-1, -0.5, 0}, {1, -0.4, 0.3}, {-1.1, 0.6, 0.1}};
  const auto view = tile_view(corners, {0.3, 2, 1.5});
  ASSERT_TRUE(view);
  EXPECT_LE((ndc_of(*view, corners.lower_left_in_wall) - Vec2(-1, -1)).norm(), 1e-12);
  EXPECT_LE((ndc_of(*view, corners.lower_right_in_wall) - Vec2(1, -1)).norm(), 1e-12);
  EXPECT_LE((ndc_of(*view, corners.upper_left_in_wall) - Vec2(-1, 1)).norm(), 1e-12);
  EXPECT_LE((ndc_of(*view, corners.upper_right_in_wall()) - Vec2(1, 1)).norm(), 1e-12);
}

TEST(PartOfTile, ShowsWhatTheWholeTileShowsThere) {
  const Tile screen = single_screen(0.53, 0.3, 1920, 1080).tiles.front();
  const Vec2 upper_left_px(300, 200);
  const SizePx size{640, 480};
  const Vec3 eye(0.1, 0.05, 0.6);
  const View whole = *tile_view(screen.corners, eye);
  const View part = *tile_view(part_of_tile(screen, upper_left_px, size), eye);

  RandomPoints points;
  for (int i = 0; i < 100; ++i) {
    const Vec3 point = points.next(0.2) - Vec3(0, 0, 0.5);
    const Vec2 in_whole = ndc_of(whole, point), in_part = ndc_of(part, point);
    const Vec2 whole_px(960 * (1 + in_whole.x()), 540 * (1 - in_whole.y()));
    const Vec2 part_px(320 * (1 + in_part.x()), 240 * (1 - in_part.y()));
    ASSERT_LE((whole_px - (upper_left_px + part_px)).norm(), 1e-9);
  }
}

TEST(PartOfTile, OfAllPixelsIsTheTile) {
  const Tile screen = single_screen(0.53, 0.3, 1920, 1080).tiles.front();
  const TileCorners part = part_of_tile(screen, {0, 0}, {1920, 1080});
  EXPECT_THAT(part.lower_left_in_wall, IsNearPoint(screen.corners.lower_left_in_wall, 1e-12));
  EXPECT_THAT(part.lower_right_in_wall, IsNearPoint(screen.corners.lower_right_in_wall, 1e-12));
  EXPECT_THAT(part.upper_left_in_wall, IsNearPoint(screen.corners.upper_left_in_wall, 1e-12));
}

}  // namespace
}  // namespace vindu
