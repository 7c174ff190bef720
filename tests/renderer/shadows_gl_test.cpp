// The key light's shadow: what throws one, where it falls, and when it is drawn anew.
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;

class ShadowsGl : public GlTest {
 protected:
  /// A white plate in z = 0, with this square of 0.4 m before it on the light's way to the plate's
  /// middle.
  static Scene plate_and(const Material& material) {
    Scene scene = square_scene(lit_white());
    const Eigen::Vector3f place = 0.5f * to_key_light().cast<float>();
    add_square(scene, material, moved_by(place.x(), place.y(), place.z()) * scaled_by(.2f, .2f, 1));
    return scene;
  }

  static Material lit_white() {
    Material material;
    material.base_colour = {.5f, .5f, .5f, 1};
    material.double_sided = true;
    return material;
  }

  static Image drawn(const GpuScene& scene, Shadows shadows, ShadowMap& map,
                     const Vec3& eye = {0, 0, 2}) {
    const Look look{.samples = 1, .shadows = shadows};
    const SceneRenderer renderer(look);
    Canvas canvas(kStage_px, look);
    Picture picture(kStage_px, Style::lit);
    const GpuScene* scenes[] = {&scene};
    map.update(scenes, Box3f(Eigen::Vector3f(-3, -3, -3), Eigen::Vector3f(3, 3, 3)));
    canvas.begin();
    renderer.draw(*tile_view(stage(), eye), scenes, {}, &map);
    canvas.resolve(picture);
    return picture.read();
  }

  static Image drawn(const Scene& scene, Shadows shadows = Shadows::crisp) {
    ShadowMap map(Look{.shadows = shadows});
    return drawn(uploaded(pack(scene), Look{}), shadows, map);
  }

  static int brightness(const Image& image, int x, int y) { return image.at(x, y)[1]; }
};

TEST_F(ShadowsGl, FallsWhereTheLightIsHiddenAndNowhereElse) {
  for (const Shadows shadows : {Shadows::crisp, Shadows::soft}) {
    const Image image = drawn(plate_and(lit_white()), shadows);
    const int dark = brightness(image, 32, 32), bright = brightness(image, 50, 50);
    EXPECT_GT(bright, dark + 40);
    EXPECT_NEAR(brightness(image, 56, 56), bright, 4);
    EXPECT_NEAR(brightness(image, 8, 56), bright, 12);
  }
}

TEST_F(ShadowsGl, DoesNotFallOnWhatThrowsIt) {
  const Image image = drawn(square_scene(lit_white()));
  for (int y = 0; y < kStage_px.height; y += 3)
    for (int x = 0; x < kStage_px.width; x += 3)
      EXPECT_GT(brightness(image, x, y), 150) << x << ", " << y;
}

TEST_F(ShadowsGl, IsThrownByNothingThatIsBlendedOrUnlit) {
  Material blended = lit_white(), unlit = lit_white();
  blended.alpha_mode = AlphaMode::blend;
  unlit.unlit = true;
  for (const Material& material : {blended, unlit}) {
    const Image image = drawn(plate_and(material));
    EXPECT_NEAR(brightness(image, 32, 32), brightness(image, 50, 50), 6);
  }
}

TEST_F(ShadowsGl, HasTheHolesOfAMask) {
  Material masked = lit_white();
  masked.alpha_mode = AlphaMode::mask;
  masked.base_colour.w() = 0.2f;
  const Image image = drawn(plate_and(masked));
  EXPECT_NEAR(brightness(image, 32, 32), brightness(image, 50, 50), 6);
}

TEST_F(ShadowsGl, IsDrawnAnewWhenTheSceneMoves) {
  GpuScene scene = uploaded(pack(plate_and(lit_white())), Look{});
  ShadowMap map(Look{.shadows = Shadows::crisp});
  const int in_shadow = brightness(drawn(scene, Shadows::crisp, map), 32, 32);
  Mat4 aside = Mat4::Identity();
  aside(0, 3) = 0.7;
  scene.pose(aside, 0);
  const Image moved = drawn(scene, Shadows::crisp, map);
  EXPECT_GT(brightness(moved, 32, 32), in_shadow + 40);
  EXPECT_NEAR(brightness(moved, 32 + 22, 32), in_shadow, 6);
}

TEST_F(ShadowsGl, StandsStillWhenTheViewerWalks) {
  const GpuScene scene = uploaded(pack(plate_and(lit_white())), Look{});
  ShadowMap map(Look{.shadows = Shadows::crisp});
  drawn(scene, Shadows::crisp, map);
  const Mat4 before = map.fit().map_from_world;
  // The stage's plane holds the plate: its points stay where they are in the picture.
  const Image from_right = drawn(scene, Shadows::crisp, map, {0.8, -0.3, 1.5});
  EXPECT_EQ(map.fit().map_from_world, before);
  EXPECT_GT(brightness(from_right, 52, 52), brightness(from_right, 32, 32) + 40);
}

}  // namespace
}  // namespace vindu
