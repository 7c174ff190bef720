// Skinned meshes as the GPU draws them, beside the same meshes that a CPU has posed: places,
// normals, tangents, shadows, sides, and what is culled.
#include "core/site.h"
#include "renderer/chunks.h"
#include "renderer/wall_renderer.h"
#include "tests/renderer/gl_test.h"
#include "tests/renderer/skinned_scenes.h"

namespace vindu {
namespace {

using namespace testing;

class SkinningGl : public GlTest {
 protected:
  static Image drawn(const Scene& scene, Style style, double time_s, int clip = 0) {
    GpuScene gpu_scene = uploaded(pack(scene), Look{style});
    gpu_scene.pose(Mat4::Identity(), time_s, clip);
    const Look look{.style = style, .samples = 1, .shadows = Shadows::crisp};
    const SceneRenderer renderer(look);
    ShadowMap map(look);
    Canvas canvas(kStage_px, look);
    Picture picture(kStage_px, style);
    const GpuScene* scenes[] = {&gpu_scene};
    map.update(scenes, Box3f(Eigen::Vector3f(-3, -3, -3), Eigen::Vector3f(3, 3, 3)));
    canvas.begin();
    renderer.draw(*tile_view(stage(), {0.3, 0.2, 2}), scenes, {},
                  style == Style::lit ? &map : nullptr);
    canvas.resolve(picture);
    return picture.read();
  }

  /// Pixels that differ by more than `levels`; an edge may fall into the next pixel.
  static int different(const Image& a, const Image& b, int levels = 2) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      for (int part = 0; part < 3; ++part)
        if (std::abs(int{a.pixels[i][part]} - int{b.pixels[i][part]}) > levels) {
          ++count;
          break;
        }
    return count;
  }

  /// As the CPU has it, in all but a few pixels at edges; and not what it looks like at rest.
  static void expect_as_by_hand(const Scene& scene, Style style) {
    const Image at_rest = drawn(scene, style, 0, -1);
    for (const double t_s : {0.0, 0.3, 1.0, 1.6}) {
      const Image image = drawn(scene, style, t_s);
      EXPECT_LE(different(image, drawn(posed_by_hand(scene, t_s), style, 0)), 8) << t_s;
      EXPECT_GT(different(image, at_rest), 100) << t_s;
    }
  }

  static Material lit() {
    Material material;
    material.roughness = 0.5f;
    return material;
  }
};

TEST_F(SkinningGl, PutsVerticesWhereTheCpuDoes) {
  expect_as_by_hand(stalk_scene(plain(1, 1, 1)), Style::unlit);
}

TEST_F(SkinningGl, LightsThemByTheirTrueNormals) {
  expect_as_by_hand(stalk_scene(lit()), Style::lit);
}

TEST_F(SkinningGl, TurnsTheirNormalMaps) {
  Scene scene = stalk_scene(lit());
  scene.textures = {Image::filled(2, 2, {220, 160, 220, 255})};
  scene.materials[0].texture(TextureRole::normal).image = 0;
  expect_as_by_hand(scene, Style::lit);
  for (Joint& joint : scene.joints) joint.joint_from_mesh.row(0) *= -1;
  expect_as_by_hand(scene, Style::lit);
}

TEST_F(SkinningGl, ThrowsItsShadowWhereItIsPosed) {
  Scene scene = stalk_scene(lit());
  add_square(scene, lit(), moved_by(0, 0, -0.4f) * scaled_by(2, 2, 1), 0);
  scene.influences.resize(scene.vertices.size(), {{}, {kFullWeight}});
  const Image rest = drawn(scene, Style::lit, 0, -1);
  for (const double t_s : {0.3, 1.0}) {
    Scene by_hand = posed_by_hand(stalk_scene(lit()), t_s);
    add_square(by_hand, lit(), moved_by(0, 0, -0.4f) * scaled_by(2, 2, 1), 0);
    const Image image = drawn(scene, Style::lit, t_s);
    EXPECT_LE(different(image, drawn(by_hand, Style::lit, 0), 8), 16) << t_s;
    EXPECT_GT(different(image, rest, 8), 150) << t_s;
  }
}

TEST_F(SkinningGl, ShowsTheOutsideOfWhatJointsMirror) {
  Scene scene = stalk_scene(plain(1, 1, 1));
  for (Joint& joint : scene.joints) joint.joint_from_mesh.row(2) *= -1;
  expect_as_by_hand(scene, Style::unlit);
  GpuScene gpu_scene = uploaded(pack(scene), Look{Style::unlit});
  EXPECT_EQ(gpu_scene.facing(gpu_scene.draws().front()), GpuScene::Facing::mirrored);
  gpu_scene.pose(Mat4(Vec4(-1, 1, 1, 1).asDiagonal()), 0);
  EXPECT_EQ(gpu_scene.facing(gpu_scene.draws().front()), GpuScene::Facing::front);
  scene.joints[0].joint_from_mesh.row(2) *= -1;
  gpu_scene = uploaded(pack(scene), Look{Style::unlit});
  EXPECT_EQ(gpu_scene.facing(gpu_scene.draws().front()), GpuScene::Facing::mixed);
}

TEST_F(SkinningGl, DrawsSkinnedAndOtherMeshesOfOneNodeAndMaterialEachInItsWay) {
  Scene scene = stalk_scene(plain(1, 1, 1));
  Mesh still = scene.meshes[0];
  still.skinned = false;
  still.bounds_in_node = bounds_in_scene(scene);
  scene.meshes.push_back(still);
  scene.nodes[3].meshes = {1, 0};
  scene.nodes[3].parent_from_node = moved_by(0.5f, 0, 0);
  Scene by_hand = posed_by_hand(stalk_scene(plain(1, 1, 1)), 0.3);
  const Image both = drawn(scene, Style::unlit, 0.3);
  scene.nodes[3].meshes = {1};
  const Image alone = drawn(scene, Style::unlit, 0.3);
  const Image moved_one = drawn(by_hand, Style::unlit, 0);
  Image joined = alone;
  for (std::size_t i = 0; i < joined.pixels.size(); ++i)
    if (alone.pixels[i] == kBlack) joined.pixels[i] = moved_one.pixels[i];
  EXPECT_LE(different(both, joined), 8);
  EXPECT_GT(different(both, alone), 50);
}

TEST_F(SkinningGl, CullsByWhereTheJointsAre) {
  const Scene scene = stalk_scene(plain(1, 1, 1));
  GpuScene gpu_scene = uploaded(pack(scene), Look{Style::unlit});
  for (const double t_s : {0.0, 0.4, 1.1}) {
    gpu_scene.pose(Mat4::Identity(), t_s);
    Box3f bounds = gpu_scene.bounds_in_world(gpu_scene.draws().front());
    const Box3f posed = bounds_in_scene(posed_by_hand(scene, t_s));
    EXPECT_TRUE(Box3f(bounds.min().array() - 1e-5f, bounds.max().array() + 1e-5f).contains(posed));
    EXPECT_LT(bounds.diagonal().norm(), 2 * posed.diagonal().norm());
  }
}

TEST_F(SkinningGl, CostsNothingButItsOwnDrawsWhereNothingIsSkinned) {
  const GpuScene scene = uploaded(pack(square_scene(plain(1, 1, 1))), Look{Style::unlit});
  EXPECT_EQ(scene.draws().front().kind & kSkinned, 0u);
  EXPECT_TRUE(scene.draws().front().joints.empty());
}

/// Eight tiles, and the same pixels as one screen: the wall shows one instant, without seams.
TEST_F(SkinningGl, IsTheSameOnManyTilesAsOnOne) {
  const Scene stalk = stalk_scene(lit());
  FrameState state{.eye_in_wall = {0.3, 0.2, 1.5}, .animation_time_s = 0.7};
  state.navigation.scale = 1.2;
  const auto drawn_on = [&](const Wall& wall) {
    WallRenderer renderer(wall, 1, Look{.samples = 1});
    Scene scene = stalk;
    cut_into_chunks(scene, 20);
    renderer.show(pack(scene));
    renderer.draw(state);
    return renderer.picture().read();
  };
  const Wall eight = expand_wall({.columns = 4,
                                  .rows = 2,
                                  .width_m = 1.6,
                                  .height_m = 1.6,
                                  .tile_width_px = 40,
                                  .tile_height_px = 80,
                                  .mount = {}},
                                 {}, {});
  EXPECT_LE(different(drawn_on(eight), drawn_on(single_screen(1.6, 1.6, 160, 160)), 1), 20);
}

TEST_F(SkinningGl, PlaysTheClipThatTheStateNames) {
  const Wall screen = single_screen(2, 2, 64, 64);
  WallRenderer renderer(screen, 1, Look{Style::unlit});
  renderer.show(pack(stalk_scene(plain(1, 1, 1))));
  const auto drawn_with = [&](int clip, double time_s) {
    renderer.draw({.eye_in_wall = {0, 0, 2}, .animation_time_s = time_s, .clip = clip});
    return renderer.picture().read();
  };
  const Image first = drawn_with(0, 0.5), second = drawn_with(1, 0.5), rest = drawn_with(-1, 0.5);
  EXPECT_GT(different(first, second), 50);
  EXPECT_GT(different(second, rest), 50);
  EXPECT_EQ(drawn_with(-1, 0.9), rest);
  EXPECT_EQ(drawn_with(2, 0.5), rest) << "a clip that is not there";
  EXPECT_EQ(drawn_with(0, 0.5), first);
}

}  // namespace
}  // namespace vindu
