// Where nodes' geometry comes out, which of its sides are seen, and what lies before what.
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Each;

class TransformsGl : public GlTest {};

int count_of(const Image& image, const Rgba8& colour) {
  return static_cast<int>(std::ranges::count(image.pixels, colour));
}

TEST_F(TransformsGl, DrawsANodeWhereItsParentsPutIt) {
  Scene scene;
  scene.nodes.push_back(empty_node(moved_by(0.5f, 0, 0)));
  add_square(scene, plain(1, 0, 0), moved_by(0, 0.5f, 0) * scaled_by(.25f, .25f, 1), 0);
  const Image image = draw_on_stage(scene, Style::unlit);
  EXPECT_EQ(image.at(48, 16), kRed);  // (0.5, 0.5), at the right above
  EXPECT_EQ(count_of(image, kRed), 16 * 16);
  EXPECT_EQ(image.at(40, 8), kRed);  // upper left corner
  EXPECT_EQ(image.at(39, 8), kBlack);
  EXPECT_EQ(image.at(55, 23), kRed);  // lower right corner
  EXPECT_EQ(image.at(55, 24), kBlack);
}

TEST_F(TransformsGl, DrawsOneMeshAtEveryNodeThatNamesIt) {
  Scene scene = square_scene(plain(0, 1, 0), moved_by(-.5f, 0, 0) * scaled_by(.25f, .25f, 1));
  scene.nodes.push_back({.name = "again",
                         .parent_from_node = moved_by(.5f, 0, 0) * scaled_by(.25f, .25f, 1),
                         .meshes = {0}});
  const Image image = draw_on_stage(scene, Style::unlit);
  EXPECT_EQ(image.at(16, 32), kGreen);
  EXPECT_EQ(image.at(48, 32), kGreen);
  EXPECT_EQ(image.at(32, 32), kBlack);
}

TEST_F(TransformsGl, AppliesTheScenesPlaceWithItsScale) {
  Mat4 world_from_scene = Mat4::Identity();
  world_from_scene.topLeftCorner<3, 3>() *= 0.5;
  world_from_scene(0, 3) = -0.5;
  const Image image =
      draw_on_stage(square_scene(plain(0, 0, 1)), Style::unlit, {0, 0, 2}, world_from_scene);
  EXPECT_EQ(count_of(image, kBlue), 32 * 32);
  EXPECT_EQ(image.at(0, 32), kBlue);
  EXPECT_EQ(image.at(32, 32), kBlack);
}

// The eye sees through the screen: what is twice as far as the screen appears half as large.
TEST_F(TransformsGl, ShrinksWithDistanceFromTheEye) {
  const Image image = draw_on_stage(square_scene(plain(1, 1, 1), moved_by(0, 0, -2)), Style::unlit);
  EXPECT_EQ(count_of(image, kWhite), 32 * 32);
}

TEST_F(TransformsGl, MovesWhatIsBehindTheScreenWithTheEye) {
  const Scene scene = square_scene(plain(1, 1, 1), moved_by(0, 0, -2) * scaled_by(.5, .5, 1));
  const Image from_right = draw_on_stage(scene, Style::unlit, {1, 0, 2});
  EXPECT_EQ(from_right.at(48, 32), kWhite);  // halfway between eye and thing: x = 0.5
  EXPECT_EQ(from_right.at(32, 32), kBlack);
}

TEST_F(TransformsGl, HidesTheBackOfASingleSidedSurface) {
  const Scene turned = square_scene(plain(1, 1, 1), scaled_by(-1, 1, -1));  // half a turn about y
  EXPECT_THAT(draw_on_stage(turned, Style::unlit).pixels, Each(kBlack));
}

TEST_F(TransformsGl, ShowsTheBackOfADoubleSidedSurface) {
  Material both = plain(1, 1, 1);
  both.double_sided = true;
  const Scene turned = square_scene(both, scaled_by(-1, 1, -1));
  EXPECT_THAT(draw_on_stage(turned, Style::unlit).pixels, Each(kWhite));
}

// A mirrored node turns its triangles round; its front stays its front.
TEST_F(TransformsGl, KeepsTheFrontOfAMirroredNode) {
  const Scene mirrored = square_scene(plain(1, 1, 1), scaled_by(-1, 1, 1));
  EXPECT_THAT(draw_on_stage(mirrored, Style::unlit).pixels, Each(kWhite));
  const Scene mirrored_away = square_scene(plain(1, 1, 1), scaled_by(1, 1, -1));
  EXPECT_THAT(draw_on_stage(mirrored_away, Style::unlit).pixels, Each(kBlack));
}

TEST_F(TransformsGl, KeepsTheFrontOfAnInstanceOfAMirroredParent) {
  Scene scene;
  scene.nodes.push_back(empty_node(scaled_by(-1, 1, 1)));
  add_square(scene, plain(1, 0, 0), moved_by(-.5f, 0, 0) * scaled_by(.25f, .25f, 1), 0);
  add_square(scene, plain(0, 1, 0), moved_by(-.5f, 0, 0) * scaled_by(.25f, .25f, 1), -1);
  const Image image = draw_on_stage(scene, Style::unlit);
  EXPECT_EQ(image.at(48, 32), kRed);
  EXPECT_EQ(image.at(16, 32), kGreen);
}

TEST_F(TransformsGl, ShowsTheNearerOfTwoSurfacesInAnyOrder) {
  for (const bool near_first : {true, false}) {
    Scene scene;
    const auto near_one = [&] { add_square(scene, plain(1, 0, 0), moved_by(0, 0, 0.001f)); };
    const auto far_one = [&] { add_square(scene, plain(0, 1, 0), moved_by(0, 0, 0)); };
    near_first ? near_one() : far_one();
    near_first ? far_one() : near_one();
    EXPECT_THAT(draw_on_stage(scene, Style::unlit).pixels, Each(kRed));
  }
}

// Reversed float depth with 32 bits: 2 cm at 102 m, with a near plane of 1 cm.
TEST_F(TransformsGl, TellsSurfacesFarAwayApart) {
  Scene scene;
  add_square(scene, plain(0, 1, 0), moved_by(0, 0, -100.02f) * scaled_by(60, 60, 1));
  add_square(scene, plain(1, 0, 0), moved_by(0, 0, -100) * scaled_by(60, 60, 1));
  add_square(scene, plain(0, 0, 1), moved_by(0, 0, -100.04f) * scaled_by(60, 60, 1));
  EXPECT_THAT(draw_on_stage(scene, Style::unlit).pixels, Each(kRed));
}

TEST_F(TransformsGl, PlaysAnAnimation) {
  Scene scene = square_scene(plain(1, 1, 1), scaled_by(.25f, .25f, 1));
  const Eigen::Vector3f left(-.5f, 0, 0), right(.5f, 0, 0);
  AnimationChannel channel;
  channel.translations = {{0, left}, {2, right}};
  scene.animations.push_back({.name = "to and fro", .duration_s = 2, .channels = {channel}});
  GpuScene gpu_scene = uploaded(pack(scene), Look{Style::unlit});
  gpu_scene.pose(Mat4::Identity(), 0);
  EXPECT_NEAR(gpu_scene.bounds_in_world(gpu_scene.draws().front()).center().x(), -.5, 1e-6);
  gpu_scene.pose(Mat4::Identity(), 1.5);
  EXPECT_NEAR(gpu_scene.bounds_in_world(gpu_scene.draws().front()).center().x(), .25, 1e-6);
}

// Normals turn with the inverse transpose: a flattened square at 45 degrees is lit as what it is.
TEST_F(TransformsGl, LightsAScaledNodeByItsTrueNormal) {
  Material grey;
  grey.base_colour = {.5f, .5f, .5f, 1};
  grey.roughness = 1;
  const auto turned_by = [](float angle_rad) {
    Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
    matrix.topLeftCorner<3, 3>() =
        Eigen::AngleAxisf(angle_rad, Eigen::Vector3f::UnitX()).toRotationMatrix();
    return matrix;
  };
  const float angle_rad = -0.8f, flatter = 0.3f;
  const float true_angle_rad = std::atan2(flatter * std::sin(angle_rad), std::cos(angle_rad));
  const Scene scaled = square_scene(grey, scaled_by(1, 1, flatter) * turned_by(angle_rad));
  const Scene same = square_scene(grey, turned_by(true_angle_rad));
  const Scene unscaled = square_scene(grey, turned_by(angle_rad));
  const Rgba8 lit = draw_on_stage(scaled, Style::lit).at(32, 32);
  EXPECT_THAT(lit, IsNearColour(draw_on_stage(same, Style::lit).at(32, 32), 1));
  EXPECT_THAT(lit, ::testing::Not(IsNearColour(draw_on_stage(unscaled, Style::lit).at(32, 32), 5)));
}

}  // namespace
}  // namespace vindu
